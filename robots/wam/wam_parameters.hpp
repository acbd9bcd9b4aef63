// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/author.hpp"
#include "armature/controllers/base/checked_gains.hpp"
#include "armature/controllers/base/sampling_period.hpp"
#include "robots/wam/arm_numbers.hpp"
#include "robots/wam/driver/driven_watch.hpp"
#include "robots/wam/driver/standing_watch.hpp"
#include "robots/wam/torque_path.hpp"

namespace armature::wam {

/// The properties of the hardware that say what torques may do. Vectors have one number for each
/// joint, or one for all.
class WamParameters {
 public:
  explicit WamParameters(component::Component* owner);

  /// An error names the property, what was expected and what was found.
  /// @thread configuration only
  /// @param wanted  another value of one of them
  base::Result<TorquePath::Config> torque_path(
      const ArmNumbers& numbers, const controllers::CheckedGains::Wanted& wanted = {}) const;
  /// Of what `torque_path` says, but for the period.
  void add_follower(component::PropertyFollower& follower);
  bool says_who_holds_the_weight(const component::PropertyBase& property) const {
    return &property == &controller_has_gravity_;
  }
  /// The same for the watch over the arm that is to stand.
  base::Result<StandingWatch::Config> standing_watch(const ArmNumbers& numbers) const;
  /// The same for the watch over the arm that is armed.
  base::Result<DrivenWatch::Config> driven_watch(const ArmNumbers& numbers) const;
  /// [N m] Of each joint: what may hold it beside its weight, and it is let float nevertheless.
  base::Result<std::vector<double>> weightless_load(const ArmNumbers& numbers) const;
  const controllers::SamplingPeriod& period() const { return period_; }
  /// Where no gains were given, those of the vendor are shown: they count.
  /// @thread configuration only
  void show_gains(const std::vector<JointGains>& used);

 private:
  using Numbers = component::Property<std::vector<double>>;

  base::Result<std::vector<JointGains>> gains(
      const ArmNumbers& numbers, const controllers::CheckedGains::Wanted& wanted) const;

  controllers::SamplingPeriod period_;
  component::Property<bool> controller_has_gravity_;
  component::Property<double> arming_time_;
  component::Property<double> hand_over_;
  Numbers lower_;
  Numbers upper_;
  Numbers max_velocity_;
  Numbers max_acceleration_;
  Numbers max_control_torque_;
  Numbers max_torque_;
  Numbers max_growth_;
  Numbers kp_;
  Numbers ki_;
  Numbers kd_;
  Numbers max_own_torque_;
  Numbers stand_motion_;
  Numbers stand_velocity_;
  component::Property<double> stand_alternation_;
  component::Property<double> driven_motion_;
  component::Property<double> sinking_;
  component::Property<OverLimit> over_limit_;
  Numbers max_load_;
};

}  // namespace armature::wam
