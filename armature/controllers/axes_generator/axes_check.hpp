// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/base/checked_gains.hpp"
#include "armature/controllers/base/driven_joint.hpp"

namespace armature::controllers {

/// Checks that a generator asks for no more than the joints behind it let through, where the
/// deployment says which these are: what a limiter cuts, it cuts to pieces.
class AxesCheck final : public component::Checked, public component::PropertyFollower {
 public:
  using Numbers = component::Property<std::vector<double>>;
  /// The properties that hold the limits of the axes, and the port that has their references.
  struct Limits {
    const component::OutputPort<std::vector<double>>& desired;
    Numbers& lower;
    Numbers& upper;
    Numbers& max_velocity;
    Numbers& max_acceleration;
  };
  AxesCheck(component::Component* owner, const component::Property<int>& axes,
            const Limits& limits);

  void check(component::Check& check) const override;

  void follow() override {}
  std::string objection() const override { return {}; }
  std::string objection_to(const component::PropertyBase& property,
                           const types::Value& value) const override;

 private:
  std::string objection(const CheckedGains::Wanted& wanted) const;

  const component::Property<int>& axes_;
  Limits limits_;
  mutable std::vector<DrivenJoint> joints_;  ///< as the check found them, in each mode
};

}  // namespace armature::controllers
