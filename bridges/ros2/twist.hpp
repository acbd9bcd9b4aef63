// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "bridges/ros2/endpoint.hpp"

namespace armature::ros2 {

/// Speeds that geometry_msgs/Twist asks for, such as `cmd_vel`. What is faster than its limits, or
/// no finite number, is refused as a whole. The age of its outputs is the reader's: a chassis that
/// hears nothing new stops.
class Twist final : public Subscriber {
 public:
  using Subscriber::Subscriber;

 private:
  bool moves_robots() const override { return true; }
  std::string open(const component::Surroundings& surroundings) override;
  void close() override { reader_.reset(); }
  void work() override;
  std::string obey(const void* sample);

  component::Property<std::string> topic_{this, "topic", "cmd_vel", "that it reads"};
  component::Property<double> max_linear_{
      this, "max_linear", 1.0, "of each direction", "m/s", component::range(0.0, 1000.0)};
  component::Property<double> max_angular_{
      this, "max_angular", 3.0, "about each axis", "rad/s", component::range(0.0, 1000.0)};
  component::Property<double> track_{
      this, "track", 0.3, "between left and right wheels", "m", component::range(0.001, 100.0)};
  component::OutputPort<double> x_{this, "LinearX", "forward", "m/s"};
  component::OutputPort<double> y_{this, "LinearY", "to the left", "m/s"};
  component::OutputPort<double> z_{this, "LinearZ", "upwards", "m/s"};
  component::OutputPort<double> roll_{this, "AngularX", "about the forward axis", "rad/s"};
  component::OutputPort<double> pitch_{this, "AngularY", "about the left axis", "rad/s"};
  component::OutputPort<double> yaw_{this, "AngularZ", "to the left", "rad/s"};
  component::OutputPort<double> left_{
      this, "Left", "of a chassis' left side: LinearX - AngularZ track / 2", "m/s"};
  component::OutputPort<double> right_{this, "Right", "of its right side", "m/s"};

  std::unique_ptr<Reader> reader_;
};

}  // namespace armature::ros2
