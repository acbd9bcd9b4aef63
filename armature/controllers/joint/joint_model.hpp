// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/joint_limits.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/joint_hardware.hpp"
#include "armature/controllers/joint/joint_settings.hpp"

namespace armature::controllers {

/// Whose sensor tells a Joint how it moves; nullptr: none that says what it is.
/// @thread configuration only
const JointHardware* hardware_of(const component::Component& joint, const component::Check& check);

/// What a Joint is in its robot: checks its limits and its gear against what a Robot of the
/// deployment says of links and drives, and tells whoever controls the joint what it drives.
class JointModel final : public component::Checked, public component::PropertyFollower {
 public:
  JointModel(component::Component* owner, JointProperties& settings, JointCommand command);

  void check(component::Check& check) const override;

  /// Nothing if no Robot says what it is, and of a joint that its drive controls.
  /// @thread configuration only
  std::optional<DrivenJoint> driven(const component::Check& check) const;

  // For the properties.
  void follow() override {}
  std::string objection() const override { return {}; }
  /// What the check would have said, had the property had this value.
  std::string objection_to(const component::PropertyBase& property,
                           const types::Value& value) const override;

 private:
  /// As the check found them.
  struct Known {
    DrivenJoint joint;
    control::JointLimits described;
    double sensor_turns = 1.0;  ///< that DisplacementSensor tells for one of the motor's axis
    bool of_shaft = false;      ///< its hardware knows its gear, and tells of the shaft behind
  };

  void check_ends(component::Check& check) const;
  void check_sensor(component::Check& check) const;
  std::vector<const component::Component*> robots(const component::Check& check) const;
  const DescribesRobot* robot(const component::Check& check) const;
  void refuse_robots(component::Check& check) const;
  base::Result<Known> find(const DescribesRobot& robot) const;
  std::string objection(const Known& known, const JointSettings& limits) const;
  static std::string objection_to_motion(const control::JointLimits& described,
                                         const JointSettings& limits, const std::string& unit);
  std::string objection_to_effort(const Known& known, const JointSettings& limits) const;
  static std::string objection_to_gear(const Known& known, double gear_ratio);

  component::Component& owner_;
  JointProperties& settings_;
  JointCommand command_;
  component::Property<int> number_;
  mutable std::optional<Known> known_;
};

}  // namespace armature::controllers
