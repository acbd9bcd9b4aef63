// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/arm_motors.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace armature::wam {
namespace {

double in_seconds(base::Duration time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

ArmMotors::ArmMotors(ArmSimulation arm, base::Time begin)
    : arm_(std::move(arm)),
      now_(begin),
      from_(arm_.motors()),
      to_(arm_.motors()),
      positions_(arm_.motors()),
      velocities_(arm_.motors()) {}

void ArmMotors::advance_to(base::Time now) {
  const base::Duration passed = now - now_;
  now_ = now;
  if (carried_) {
    carry();
  } else {
    arm_.advance(passed);
  }
}

void ArmMotors::drive(std::size_t motor, double torque) {
  carried_ = arrived_ = false;
  arm_.set_torque(motor, torque);
}

void ArmMotors::carry_to(const std::vector<double>& joints) {
  double furthest = 0.0;
  for (std::size_t i = 0; i < to_.size(); ++i) {
    from_[i] = arm_.joint_position(i);
    to_[i] = joints[i];
    furthest = std::max(furthest, std::abs(to_[i] - from_[i]));
  }
  carried_ = true;
  arrived_ = false;
  carried_since_ = now_;
  carried_for_ = std::chrono::duration_cast<base::Duration>(
      std::chrono::duration<double>(furthest / kCarryingRate));
}

void ArmMotors::push(std::span<const double> velocities) {
  for (std::size_t i = 0; i < positions_.size(); ++i) positions_[i] = arm_.joint_position(i);
  arm_.set_state(positions_, velocities);
}

/// Whoever carries it holds it: at the end it is at rest.
void ArmMotors::carry() {
  const base::Duration left = carried_for_ - (now_ - carried_since_);
  arrived_ = left <= base::Duration{};
  for (std::size_t i = 0; i < to_.size(); ++i) {
    const double rate = arrived_ ? 0.0 : (to_[i] - from_[i]) / in_seconds(carried_for_);
    velocities_[i] = rate;
    positions_[i] = to_[i] - (arrived_ ? 0.0 : rate * in_seconds(left));
  }
  arm_.set_state(positions_, velocities_);
}

}  // namespace armature::wam
