// SPDX-License-Identifier: Apache-2.0
#include "armature/library/computed_torque/controller_computed_torque.hpp"

#include <utility>

#include "armature/control/per_joint.hpp"

namespace armature::library {

base::Result<void> ControllerComputedTorque::make_law(control::InverseDynamics links) {
  const auto kp = control::per_joint(kp_.name(), kp_.get(), joints());
  if (!kp) return base::Error{kp.error()};
  const auto kd = control::per_joint(kd_.name(), kd_.get(), joints());
  if (!kd) return base::Error{kd.error()};
  const auto inertia = control::per_joint(rotor_inertia_.name(), rotor_inertia_.get(), joints());
  if (!inertia) return base::Error{inertia.error()};
  std::vector<double> turns = turns_;
  if (turns.size() == 1) turns.assign(joints(), turns.front());
  auto rotors = control::Transmission::make({.turns = turns, .rotor_inertia = inertia.value()});
  if (!rotors) return base::Error{"motor_turns, motor_rotor_inertia: " + rotors.error()};
  auto made = control::ComputedTorque::make(std::move(links), std::move(rotors).value(),
                                            {.kp = kp.value(), .kd = kd.value()});
  if (!made) return base::Error{made.error()};
  law_ = std::move(made).value();
  return {};
}

void ControllerComputedTorque::compute(std::span<const double> reference,
                                       std::span<const double> motion, std::span<double> torques) {
  law_->step(reference, motion, torques);
}

}  // namespace armature::library
