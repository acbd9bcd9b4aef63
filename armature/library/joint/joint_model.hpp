// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "armature/component/author.hpp"
#include "armature/control/joint_limits.hpp"
#include "armature/library/base/driven_joint.hpp"

namespace armature::library {

/// What a Joint is in its robot: checks its limits and its gear against what a Robot of the
/// deployment says of links and drives, and tells whoever controls the joint what it drives.
class JointModel final : public component::Checked, public component::PropertyFollower {
 public:
  /// The properties of the joint's limiter.
  struct Limits {
    component::Property<double>& lower;
    component::Property<double>& upper;
    component::Property<double>& max_velocity;
    component::Property<double>& max_acceleration;
    component::Property<double>& max_effort;
    component::Property<double>& gear_ratio;
  };
  JointModel(component::Component* owner, const Limits& limits);

  void check(component::Check& check) const override;

  /// Nothing if no Robot says what it is.
  /// @thread configuration only
  std::optional<DrivenJoint> driven(const component::Check& check) const;

  // For the properties.
  void follow() override {}
  std::string objection() const override { return {}; }
  /// What the check would have said, had the property had this value.
  std::string objection_to(const component::PropertyBase& property,
                           const types::Value& value) const override;

 private:
  struct Numbers {
    double lower, upper, max_velocity, max_acceleration, max_effort, gear_ratio;
  };
  /// As the check found them.
  struct Known {
    DrivenJoint joint;
    control::JointLimits described;
  };

  const DescribesRobot* robot(const component::Check& check) const;
  base::Result<Known> find(const DescribesRobot& robot) const;
  Numbers numbers() const;
  static std::string objection(const Known& known, const Numbers& limits);
  static std::string objection_to_gear(const Known& known, double gear_ratio);

  component::Component& owner_;
  Limits limits_;
  component::Property<int> number_;
  mutable std::optional<Known> known_;
};

}  // namespace armature::library
