// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "armature/controllers/base/axis_units.hpp"
#include "bridges/ros2/endpoint.hpp"
#include "bridges/ros2/internal/feed.hpp"

namespace armature::ros2 {

/// Where the joints are, as sensor_msgs/JointState: one message for each sample of `Position`, with
/// the velocities and efforts of the same cycle. What is not connected is left out, as in ROS 2.
class JointStates final : public Publisher {
 public:
  using Publisher::Publisher;

 private:
  using Vector = std::vector<double>;

  std::vector<Objection> objections(const Components& components) const override;
  std::string open(const component::Surroundings& surroundings) override;
  void close() override;
  void begin() override;
  void work() override;
  void publish_state(base::Time at, Vector& positions);

  controllers::AxisUnits units_{this, controllers::AxisUnit::Of::kAxes};
  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 1000)};
  component::Property<std::vector<std::string>> names_{
      this, "joint_names", {}, "as the robot's description has them", "", component::mandatory};
  component::Property<std::string> frame_{this, "frame_id", "", "of the header"};
  component::Property<std::string> topic_{this, "topic", "joint_states", "that it writes"};
  component::Property<int> every_{
      this, "every", 1, "writes the first of so many samples", "", component::range(1, 100000)};
  component::Property<int> buffer_{this, "buffer",
                                   256,  "samples that wait at most, between two updates",
                                   "",   component::range(1, 100000)};
  component::InputPort<Vector> position_{this,
                                         "Position",
                                         "of each joint, as measured",
                                         "",
                                         component::size_of(joints_),
                                         component::on_lost(component::Reaction::kHold),
                                         component::unit_of(units_.position())};
  component::InputPort<Vector> velocity_{this,
                                         "Velocity",
                                         "of each joint, as measured: not the desired one",
                                         "",
                                         component::size_of(joints_),
                                         component::may_stay_open,
                                         component::on_lost(component::Reaction::kHold),
                                         component::unit_of(units_.velocity())};
  component::InputPort<Vector> effort_{this,
                                       "Effort",
                                       "of each joint, as measured",
                                       "Nm",
                                       component::size_of(joints_),
                                       component::may_stay_open,
                                       component::on_lost(component::Reaction::kHold)};

  internal::Feed positions_;
  internal::Feed velocities_;
  internal::Feed efforts_;
  Vector present_velocity_;
  Vector present_effort_;
  std::uint64_t seen_ = 0;
  base::Time updated_at_{};
  std::unique_ptr<Writer> writer_;
};

}  // namespace armature::ros2
