// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/wam_parameters.hpp"

#include <initializer_list>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/control/per_joint.hpp"

namespace armature::wam {

using component::mandatory;
using component::range;

/// [m/s] At 1 m/s the board idles the arm, which then sinks: it is held before.
constexpr double kMostTip = 0.985;

WamParameters::WamParameters(component::Component* owner)
    : period_(owner),
      controller_has_gravity_(owner, "ControllerHasGravity", false,
                              "torRefPort holds the arm's weight; else this component adds it"),
      arming_time_(owner, "ArmingTime", 1.0, "for which torques may only grow slowly after arming",
                   "s", range(0.0, 60.0)),
      hand_over_(owner, "SwitchTime", 0.5,
                 "in which what drove the arm before dies away when it is armed or held", "s",
                 range(0.0, 0.5)),
      lower_(owner, "PositionMin", {}, "no command drives a joint beyond", "rad", mandatory),
      upper_(owner, "PositionMax", {}, "no command drives a joint beyond", "rad", mandatory),
      max_velocity_(owner, "MaxVelocity", {}, "no command drives a joint on at more", "rad/s",
                    mandatory),
      max_acceleration_(owner, "MaxAcceleration", {},
                        "with which a joint can brake, before its limits, too", "rad/s^2",
                        mandatory),
      max_control_torque_(owner, "MaxControlTorque", {}, "of commands, without the weight", "Nm",
                          mandatory),
      max_torque_(owner, "MaxTorque", {}, "with the weight", "Nm", mandatory),
      max_growth_(owner, "MaxTorqueGrowth", {},
                  "of a torque in one period; there is no limit towards 0", "Nm", mandatory),
      kp_(owner, "Kp", {}, "of the arm's own controller; the vendor's, if none", "Nm/rad"),
      ki_(owner, "Ki", {}, "of the arm's own controller; the vendor's, if none", "Nm/(rad s)"),
      kd_(owner, "Kd", {}, "of the arm's own controller; the vendor's, if none", "Nm s/rad"),
      max_own_torque_(owner, "MaxOwnTorque", {},
                      "of the arm's own controller; the vendor's, if none", "Nm"),
      stand_motion_(owner, "StandMaxMotion", {0.01},
                    "held unarmed, it is braked if a joint is farther from where it came to rest",
                    "rad", range(1e-4, 3.0)),
      stand_velocity_(owner, "StandMaxVelocity", {0.1},
                      "held unarmed, it is braked if a joint is faster for three cycles", "rad/s",
                      range(1e-3, 10.0)),
      stand_alternation_(owner, "StandMaxAlternation", 0.2,
                         "it is braked, or armed held, if what holds or drives a joint changes its "
                         "sign in a larger share of the cycles",
                         "", range(0.01, 1.0)),
      driven_motion_(owner, "StandMaxDriven", 0.1,
                     "armed, it is cut off its controller and held if that drives a joint farther "
                     "from where it is to stand",
                     "rad", range(1e-3, 3.0)),
      sinking_(
          owner, "WeightlessMaxSinking", 0.5,
          "armed, it is held if a joint that is to stand sinks so far without a break, which a "
          "hand makes that leads a weightless arm",
          "rad", range(1e-2, 3.0)),
      over_limit_(owner, "over_limit", OverLimit::kClip,
                  "of torques of which one is above its limit: clip cuts that one, refuse_all "
                  "sends none of them"),
      max_load_(owner, "WeightlessMaxLoad", {1.0},
                "after its activation it is weightless only if no joint is held by more beside the "
                "weight of its description",
                "Nm", range(0.01, 20.0)) {}

base::Result<TorquePath::Config> WamParameters::torque_path(
    const ArmNumbers& numbers, const controllers::CheckedGains::Wanted& wanted) const {
  const std::size_t joints = numbers.joints();
  TorquePath::Config config;
  std::vector<double> lower, upper, velocity, control;
  struct Each {
    const Numbers& numbers;
    std::vector<double>& to;
  };
  for (const auto& [property, to] :
       {Each{lower_, lower}, Each{upper_, upper}, Each{max_velocity_, velocity},
        Each{max_acceleration_, config.max_acceleration}, Each{max_control_torque_, control},
        Each{max_torque_, config.max_torque}, Each{max_growth_, config.max_growth}}) {
    auto each = control::per_joint(property.name(), wanted.value_of(property), joints);
    if (!each) return base::Error{each.error()};
    to = std::move(each).value();
  }
  auto own = gains(numbers, wanted);
  if (!own) return base::Error{own.error()};
  config.hold = std::move(own).value();
  for (std::size_t i = 0; i < joints; ++i) {
    config.limits.push_back({.lower = lower[i],
                             .upper = upper[i],
                             .max_velocity = velocity[i],
                             .max_acceleration = config.max_acceleration[i],
                             .max_effort = control[i],
                             .period = period_.duration(),
                             .arming_time = base::from_seconds(arming_time_),
                             .effort_rate = arming_time_ > 0.0 ? control[i] / arming_time_ : 0.0});
  }
  config.command_has_weight = wanted.value_of(controller_has_gravity_);
  config.over_limit = over_limit_;
  config.hand_over = base::from_seconds(hand_over_);
  config.period_s = period_.seconds();
  return config;
}

base::Result<StandingWatch::Config> WamParameters::standing_watch(const ArmNumbers& numbers) const {
  StandingWatch::Config config;
  config.max_alternation = stand_alternation_;
  config.period_s = period_;
  for (auto [property, to] : {std::pair{&stand_motion_, &config.max_motion},
                              std::pair{&stand_velocity_, &config.max_velocity},
                              std::pair{&max_acceleration_, &config.max_acceleration}}) {
    auto each = control::per_joint(property->name(), property->get(), numbers.joints());
    if (!each) return base::Error{each.error()};
    *to = std::move(each).value();
  }
  auto own = gains(numbers, {});
  if (!own) return base::Error{own.error()};
  for (const JointGains& joint : own.value()) config.max_torque.push_back(joint.max_torque);
  return config;
}

base::Result<DrivenWatch::Config> WamParameters::driven_watch(const ArmNumbers& numbers) const {
  DrivenWatch::Config config;
  config.max_tip = kMostTip;
  config.max_driven = driven_motion_;
  config.max_sinking = sinking_;
  config.max_alternation = stand_alternation_;
  config.period_s = period_;
  for (auto [property, to] : {std::pair{&max_velocity_, &config.max_velocity},
                              std::pair{&max_control_torque_, &config.max_torque}}) {
    auto each = control::per_joint(property->name(), property->get(), numbers.joints());
    if (!each) return base::Error{each.error()};
    *to = std::move(each).value();
  }
  return config;
}

base::Result<std::vector<double>> WamParameters::weightless_load(const ArmNumbers& numbers) const {
  return control::per_joint(max_load_.name(), max_load_.get(), numbers.joints());
}

void WamParameters::add_follower(component::PropertyFollower& follower) {
  for (component::PropertyBase* property : std::initializer_list<component::PropertyBase*>{
           &lower_, &upper_, &max_velocity_, &max_acceleration_, &max_control_torque_, &max_torque_,
           &max_growth_, &kp_, &ki_, &kd_, &max_own_torque_, &controller_has_gravity_}) {
    property->add_follower(follower);
  }
}

base::Result<std::vector<JointGains>> WamParameters::gains(
    const ArmNumbers& numbers, const controllers::CheckedGains::Wanted& wanted) const {
  std::vector<JointGains> gains = numbers.gains;
  struct Parameter {
    const Numbers& numbers;
    double JointGains::*field;
  };
  for (const auto& [property, field] :
       {Parameter{kp_, &JointGains::kp}, Parameter{ki_, &JointGains::ki},
        Parameter{kd_, &JointGains::kd}, Parameter{max_own_torque_, &JointGains::max_torque}}) {
    const std::vector<double>& given = wanted.value_of(property);
    const bool shown = &given == &property.get() && !property.was_set();
    if (given.empty() || shown) continue;
    const auto each = control::per_joint(property.name(), given, gains.size());
    if (!each) return base::Error{each.error()};
    for (std::size_t i = 0; i < gains.size(); ++i) gains[i].*field = each.value()[i];
  }
  return gains;
}

void WamParameters::show_gains(const std::vector<JointGains>& used) {
  for (auto [property, field] :
       {std::pair{&kp_, &JointGains::kp}, std::pair{&ki_, &JointGains::ki},
        std::pair{&kd_, &JointGains::kd}, std::pair{&max_own_torque_, &JointGains::max_torque}}) {
    if (property->was_set() && !property->get().empty()) continue;
    std::vector<double> all;
    for (const JointGains& joint : used) all.push_back(joint.*field);
    property->assign(all);
  }
}

}  // namespace armature::wam
