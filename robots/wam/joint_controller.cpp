// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/joint_controller.hpp"

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
  return made;
}

void JointController::step(std::span<const double> reference, std::span<const double> measured,
                           std::span<double> torques) {
  for (std::size_t i = 0; i < pids_.size(); ++i) {
    torques[i] = pids_[i].step(reference[i] - measured[i]);
  }
}

void JointController::reset_to(std::span<const double> reference,
                               std::span<const double> measured) {
  for (std::size_t i = 0; i < pids_.size(); ++i) pids_[i].reset_to(reference[i] - measured[i]);
}

void JointController::reset() {
  for (control::PositionalPid& pid : pids_) pid.reset();
}

}  // namespace armature::wam
