// SPDX-License-Identifier: Apache-2.0
#include "armature/library/computed_torque/controller_computed_torque.hpp"

#include <utility>

#include "armature/control/per_joint.hpp"

namespace armature::library {

base::Result<void> ControllerComputedTorque::make_law(control::InverseDynamics links) {
  std::vector<double> kp, kd, inertia, friction;
  struct Parameter {
    const Numbers& numbers;
    std::vector<double>& each;
  };
  for (const auto& [numbers, each] :
       {Parameter{kp_, kp}, Parameter{kd_, kd}, Parameter{rotor_inertia_, inertia},
        Parameter{friction_, friction}}) {
    auto found = control::per_joint(numbers.name(), numbers.get(), joints());
    if (!found) return base::Error{found.error()};
    each = std::move(found).value();
  }
  std::vector<double> turns = turns_;
  if (turns.size() == 1) turns.assign(joints(), turns.front());
  auto motors = control::Transmission::make(
      {.turns = turns, .rotor_inertia = inertia, .viscous_friction = friction});
  if (!motors) return base::Error{"of the motors: " + motors.error()};
  auto made = control::ComputedTorque::make(std::move(links), std::move(motors).value(),
                                            {.kp = kp, .kd = kd});
  if (!made) return base::Error{made.error()};
  law_ = std::move(made).value();
  return {};
}

void ControllerComputedTorque::compute(std::span<const double> reference,
                                       std::span<const double> motion, std::span<double> torques) {
  law_->step(reference, motion, torques);
}

}  // namespace armature::library
