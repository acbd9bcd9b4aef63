// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/wam_parameters.hpp"

#include "armature/base/seconds.hpp"
#include "armature/control/per_joint.hpp"

namespace armature::wam {

using component::mandatory;
using component::range;

WamParameters::WamParameters(component::Component* owner)
    : period_(owner, "Period", kPeriod, "between two samples", "s", range(1e-4, 0.1)),
      controller_has_gravity_(owner, "ControllerHasGravity", false,
                              "torRefPort holds the arm's weight; else this component adds it"),
      arming_time_(owner, "ArmingTime", 1.0, "for which torques may only grow slowly after arming",
                   "s", range(0.0, 60.0)),
      hand_over_(owner, "SwitchTime", 0.5,
                 "in which what drove the arm before dies away when it is armed or held", "s",
                 range(0.0, 60.0)),
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
                      "of the arm's own controller; the vendor's, if none", "Nm") {}

base::Result<TorquePath::Config> WamParameters::torque_path(const ArmNumbers& numbers) const {
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
    auto each = control::per_joint(property.name(), property.get(), joints);
    if (!each) return base::Error{each.error()};
    to = std::move(each).value();
  }
  auto own = gains(numbers);
  if (!own) return base::Error{own.error()};
  config.hold = std::move(own).value();
  for (std::size_t i = 0; i < joints; ++i) {
    config.limits.push_back({.lower = lower[i],
                             .upper = upper[i],
                             .max_velocity = velocity[i],
                             .max_acceleration = config.max_acceleration[i],
                             .max_effort = control[i],
                             .period = base::from_seconds(period_),
                             .arming_time = base::from_seconds(arming_time_),
                             .effort_rate = arming_time_ > 0.0 ? control[i] / arming_time_ : 0.0});
  }
  config.command_has_weight = controller_has_gravity_;
  config.hand_over = base::from_seconds(hand_over_);
  config.period_s = period_;
  return config;
}

base::Result<std::vector<JointGains>> WamParameters::gains(const ArmNumbers& numbers) const {
  std::vector<JointGains> gains = numbers.gains;
  struct Parameter {
    const Numbers& numbers;
    double JointGains::*field;
  };
  for (const auto& [property, field] :
       {Parameter{kp_, &JointGains::kp}, Parameter{ki_, &JointGains::ki},
        Parameter{kd_, &JointGains::kd}, Parameter{max_own_torque_, &JointGains::max_torque}}) {
    if (property.get().empty()) continue;
    const auto each = control::per_joint(property.name(), property.get(), gains.size());
    if (!each) return base::Error{each.error()};
    for (std::size_t i = 0; i < gains.size(); ++i) gains[i].*field = each.value()[i];
  }
  return gains;
}

}  // namespace armature::wam
