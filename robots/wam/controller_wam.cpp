// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/controller_wam.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace armature::wam {

using component::Outcome;

Outcome ControllerWam::on_configure() {
  positions_.assign(static_cast<std::size_t>(joints_.get()), 0.0);
  motion_.assign(2 * positions_.size(), 0.0);
  return Controller::on_configure();
}

Outcome ControllerWam::on_start() {
  positions_.resize(static_cast<std::size_t>(joints_.get()));
  motion_.resize(2 * positions_.size());
  asked_ = false;
  return Controller::on_start();
}

void ControllerWam::controller_now(const std::vector<double>& measured) {
  const std::vector<double>* const reference = reference_now(measured);
  if (reference == nullptr) return;
  std::copy_n(reference->begin(), positions_.size(), positions_.begin());
  std::copy_n(reference->begin(), motion_.size(), motion_.begin());
  asked_ = true;
  position_reference_.write(positions_);
  motion_reference_.write(motion_);
}

void ControllerWam::on_torques(const std::vector<double>& torques) {
  if (!std::exchange(asked_, false)) return;
  const auto is_finite = [](double torque) { return std::isfinite(torque); };
  if (std::ranges::all_of(torques, is_finite)) return drive(torques);
  fault("a torque is not finite, expected finite numbers in reference and sensor");
}

}  // namespace armature::wam
