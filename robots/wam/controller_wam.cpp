// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/controller_wam.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "armature/control/per_joint.hpp"

namespace armature::wam {

using component::Outcome;

Outcome ControllerWam::on_configure() {
  if (Outcome outcome = Controller::on_configure(); !outcome) return outcome;
  return set_up();
}

Outcome ControllerWam::on_start() {
  if (changes_.take()) {
    if (Outcome outcome = set_up(); !outcome) return outcome;
  }
  begun_ = false;
  return Controller::on_start();
}

Outcome ControllerWam::set_up() {
  const auto numbers = gains();
  if (!numbers) return component::refused(numbers.error());
  auto made = JointController::make({.gains = numbers.value(), .period_s = period_});
  if (!made) return component::refused(made.error());
  law_ = std::move(made).value();
  torques_.assign(law_->joints(), 0.0);
  changes_.take();
  return component::accepted();
}

base::Result<std::vector<JointGains>> ControllerWam::gains() const {
  const auto joints = static_cast<std::size_t>(joints_.get());
  std::vector<JointGains> gains(joints);
  if (joints == wam7().joints()) gains = wam7().gains;
  if (joints == wam4().joints()) gains = wam4().gains;
  struct Parameter {
    const Numbers& numbers;
    double JointGains::*field;
  };
  for (const auto& [numbers, field] :
       {Parameter{kp_, &JointGains::kp}, Parameter{ki_, &JointGains::ki},
        Parameter{kd_, &JointGains::kd}, Parameter{max_torque_, &JointGains::max_torque}}) {
    if (numbers.get().empty()) continue;
    const auto each = control::per_joint(numbers.name(), numbers.get(), joints);
    if (!each) return base::Error{each.error()};
    for (std::size_t i = 0; i < joints; ++i) gains[i].*field = each.value()[i];
  }
  return gains;
}

void ControllerWam::controller_now(const std::vector<double>& measured) {
  const std::vector<double>* const reference = reference_now(measured);
  if (reference == nullptr) return;
  if (!std::exchange(begun_, true)) law_->reset_to(*reference, measured);
  law_->step(*reference, measured, torques_);
  const auto is_finite = [](double torque) { return std::isfinite(torque); };
  if (std::all_of(torques_.begin(), torques_.end(), is_finite)) {
    drive(torques_);
  } else {
    fault("a torque is not finite, expected finite numbers in reference and sensor");
  }
}

}  // namespace armature::wam
