// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/joint_controller.hpp"

#include <algorithm>
#include <string>

namespace armature::wam {

base::Result<JointController> JointController::make(const Config& config) {
  JointController made;
  for (const JointGains& gains : config.gains) {
    const auto pid = control::PositionalPid::make({.kp = gains.kp,
                                                   .ki = gains.ki,
                                                   .kd = gains.kd,
                                                   .max_output = gains.max_torque,
                                                   .period_s = config.period_s});
    if (!pid) {
      return base::Error{"joint " + std::to_string(made.joints() + 1) + ": " + pid.error()};
    }
    made.pids_.push_back(pid.value());
  }
  made.last_measured_.assign(made.joints(), 0.0);
  made.period_s_ = config.period_s;
  return made;
}

void JointController::step(std::span<const double> reference, std::span<const double> measured,
                           std::span<double> torques) {
  for (std::size_t i = 0; i < pids_.size(); ++i) {
    torques[i] = pids_[i].step(reference[i] - measured[i]);
  }
  keep(measured);
}

void JointController::step(std::span<const double> reference, std::span<const double> velocities,
                           std::span<const double> measured, std::span<double> torques) {
  for (std::size_t i = 0; i < pids_.size(); ++i) {
    const double moves = (measured[i] - last_measured_[i]) / period_s_;
    const double change = measured_before_ ? velocities[i] - moves : 0.0;
    torques[i] = pids_[i].step(reference[i] - measured[i], change);
  }
  keep(measured);
}

void JointController::keep(std::span<const double> measured) {
  std::ranges::copy(measured, last_measured_.begin());
  measured_before_ = true;
}

void JointController::reset_to(std::span<const double> reference,
                               std::span<const double> measured) {
  for (std::size_t i = 0; i < pids_.size(); ++i) pids_[i].reset_to(reference[i] - measured[i]);
  measured_before_ = false;
}

void JointController::reset() {
  for (control::PositionalPid& pid : pids_) pid.reset();
  measured_before_ = false;
}

}  // namespace armature::wam
