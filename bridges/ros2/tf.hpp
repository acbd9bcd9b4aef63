// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "armature/controllers/forward_kinematics/pose.hpp"
#include "bridges/ros2/endpoint.hpp"

namespace armature::ros2 {

/// Where a frame is in another one, as tf2_msgs/TFMessage: from a Pose, such as that of a tool, or
/// from X, Y and Heading of one component, such as a chassis. One message in each of its cycles in
/// which there is something new; of X, Y and Heading, once they are all of one cycle. A number that
/// is not finite is not written, and counted as lost.
class Tf final : public Publisher {
 public:
  using Publisher::Publisher;

 private:
  void on_check(component::Check& check) const override;
  std::string open(const component::Surroundings& surroundings) override;
  void close() override { writer_.reset(); }
  void work() override;
  void check_writers(component::Check& check) const;
  void look_at_place();
  void publish_pose(const controllers::Pose& pose, base::Time at);

  component::Property<std::string> parent_{
      this, "frame_id", "", "of the parent, such as odom", "", component::mandatory};
  component::Property<std::string> child_{
      this, "child_frame_id", "", "of what moves, such as base_link", "", component::mandatory};
  component::Property<std::string> topic_{this, "topic", "/tf", "that it writes"};
  component::InputPort<controllers::Pose> pose_{this,
                                                "Pose",
                                                "of the child in the parent",
                                                "",
                                                component::may_stay_open,
                                                component::on_lost(component::Reaction::kHold)};
  component::InputPort<double> x_{this,
                                  "X",
                                  "of the child in the parent",
                                  "m",
                                  component::may_stay_open,
                                  component::on_lost(component::Reaction::kHold)};
  component::InputPort<double> y_{this,
                                  "Y",
                                  "likewise",
                                  "m",
                                  component::may_stay_open,
                                  component::on_lost(component::Reaction::kHold)};
  component::InputPort<double> heading_{this,
                                        "Heading",
                                        "about the z axis",
                                        "rad",
                                        component::may_stay_open,
                                        component::on_lost(component::Reaction::kHold)};

  std::unique_ptr<Writer> writer_;
  std::optional<base::Time> placed_at_;  ///< of what was sent last of X, Y and Heading
};

}  // namespace armature::ros2
