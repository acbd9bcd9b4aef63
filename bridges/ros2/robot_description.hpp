// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bridges/ros2/endpoint.hpp"

namespace armature::ros2 {

/// The robot's description (URDF), as std_msgs/String: written once, and kept for whoever comes
/// later. One that is larger than a message may be is refused.
class RobotDescription final : public Publisher {
 public:
  using Publisher::Publisher;

 private:
  std::vector<Objection> objections(const Components& components) const override;
  std::string open(const component::Surroundings& surroundings) override;
  void close() override { writer_.reset(); }
  void begin() override;
  void work() override {}

  component::Property<std::string> file_{
      this, "robot_description",
      "",   "the robot's description (URDF), a file; a path counts from the working directory",
      "",   component::mandatory};
  component::Property<std::string> topic_{this, "topic", "robot_description", "that it writes"};

  std::string text_;
  std::unique_ptr<Writer> writer_;
};

}  // namespace armature::ros2
