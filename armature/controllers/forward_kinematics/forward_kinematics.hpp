// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/dynamics/forward_kinematics.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "armature/controllers/forward_kinematics/pose.hpp"

namespace armature::controllers {

/// Where the robot's tool is (paper 3, section 4.2: the Cartesian position of the hand): `pose` has
/// position and orientation of `tip_link` in the axes of `base_link`, for any arm with a
/// description (URDF), by control::ForwardKinematics.
///
/// Refuses to be configured if the file cannot be read, is no URDF, or moves another number of
/// joints than `joints`. Positions that are not finite are a fault, and nothing is written. Where
/// no positions come nothing is written: `pose` shows its age.
/// @rt nonblocking, no allocation, O(joints)
class ForwardKinematics final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_configure() override;
  void compute(const std::vector<double>& positions);

  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  component::Property<std::string> file_{
      this, "robot_description",
      "",   "the robot's description (URDF), a file; a path counts from the working directory",
      "",   component::mandatory};
  component::Property<std::string> base_link_{
      this, "base_link", "", "the link in whose axes the pose is; empty: the root"};
  component::Property<std::string> tip_link_{
      this, "tip_link", "",
      "the link whose pose it is, such as the tool; empty: that of the last joint"};
  component::InputPort<std::vector<double>> positions_{
      this,
      "nAxesSensorPosition",
      "measured position of each joint",
      "rad",
      component::on_data<&ForwardKinematics::compute>,
      component::size_of(joints_),
      component::max_age(kMaxAge, component::Reaction::kHold),
      component::on_lost(component::Reaction::kHold)};
  component::OutputPort<Pose> pose_{this, "pose",
                                    "of the tip in the axes of the base: position [m], and a unit "
                                    "quaternion that never jumps to its negative"};

  std::optional<control::ForwardKinematics> kinematics_;
  Pose last_;
};

}  // namespace armature::controllers
