// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/axes_generator/axes_check.hpp"

#include "armature/component/face.hpp"
#include "armature/control/per_joint.hpp"

namespace armature::controllers {
namespace {

/// Of a number that two properties tell.
constexpr double kRounding = 1e-9;

}  // namespace

AxesCheck::AxesCheck(component::Component* owner, const component::Property<int>& axes,
                     const Limits& limits)
    : Checked(owner), axes_(axes), limits_(limits) {
  for (Numbers* const each :
       {&limits.lower, &limits.upper, &limits.max_velocity, &limits.max_acceleration}) {
    each->add_follower(*this);
  }
}

void AxesCheck::check(component::Check& check) const {
  joints_ = joints_behind(face(limits_.desired), check);
  const auto axes = static_cast<std::size_t>(axes_.get());
  if (joints_.size() % axes != 0) joints_.clear();
  if (const std::string wrong = objection({}); !wrong.empty()) check.error(wrong);
}

std::string AxesCheck::objection_to(const component::PropertyBase& property,
                                    const types::Value& value) const {
  return objection({.property = &property, .data = value.data()});
}

std::string AxesCheck::objection(const CheckedGains::Wanted& wanted) const {
  const auto axes = static_cast<std::size_t>(axes_.get());
  struct Bound {
    const Numbers& numbers;
    double sign;
    double DrivenJoint::*most;
    const char* of_the_joint;
  };
  for (const auto& [numbers, sign, most, of_the_joint] :
       {Bound{limits_.lower, -1.0, &DrivenJoint::lower, "PositionMin"},
        Bound{limits_.upper, 1.0, &DrivenJoint::upper, "PositionMax"},
        Bound{limits_.max_velocity, 1.0, &DrivenJoint::max_velocity, "MaxVelocity"},
        Bound{limits_.max_acceleration, 1.0, &DrivenJoint::max_acceleration, "MaxAcceleration"}}) {
    const auto each = control::per_joint(numbers.name(), wanted.value_of(numbers), axes);
    if (!each) return {};  // Its configuration says so.
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const double found = each.value()[i % axes];
      const double allowed = joints_[i].*most;
      if (sign * (found - allowed) <= kRounding) continue;
      return std::string(numbers.name()) + " of axis " + std::to_string(i % axes + 1) + " is " +
             figure(found) + ", beyond " + figure(allowed) + ", " + of_the_joint + " of " +
             joints_[i].name + ": motions would be cut there";
    }
  }
  return {};
}

}  // namespace armature::controllers
