// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/controller_following/controller_velocity.hpp"

#include <cmath>
#include <cstddef>

#include "armature/control/per_joint.hpp"

namespace armature::controllers {

component::Outcome ControllerNVelocity::on_configure() {
  velocities_.assign(static_cast<std::size_t>(joints_.get()), 0.0);
  if (component::Outcome outcome = take_gains(); !outcome) return outcome;
  return Controller::on_configure();
}

component::Outcome ControllerNVelocity::on_start() {
  if (component::Outcome outcome = take_gains(); !outcome) return outcome;
  return Controller::on_start();
}

component::Outcome ControllerNVelocity::take_gains() {
  auto gains = control::per_joint(kp_.name(), kp_.get(), velocities_.size());
  if (!gains) return component::refused(gains.error());
  for (const double gain : gains.value()) {
    if (std::isfinite(gain) && gain >= 0.0) continue;
    return component::refused("Kp must be numbers of at least 0, found " + figure(gain));
  }
  gains_ = std::move(gains).value();
  return component::accepted();
}

void ControllerNVelocity::controller_now(const std::vector<double>& measured) {
  const std::vector<double>* const reference = reference_now(measured);
  if (reference == nullptr) return;
  const std::size_t joints = velocities_.size();
  for (std::size_t i = 0; i < joints; ++i) {
    velocities_[i] = (*reference)[joints + i] + gains_[i] * ((*reference)[i] - measured[i]);
  }
  drive(velocities_);
}

}  // namespace armature::controllers
