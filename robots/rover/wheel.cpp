// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/wheel.hpp"

#include <numbers>

namespace armature::rover {

using component::CallStatus;

component::Outcome Wheel::on_start() {
  on_ = false;
  return component::accepted();
}

bool Wheel::actuator_on() {
  const auto answer = switch_on_(number_, permit());
  on_ = answer.status == CallStatus::kDone && answer.value;
  return on_;
}

bool Wheel::actuator_off() {
  on_ = false;
  const auto answer = switch_off_(number_);
  return answer.status == CallStatus::kDone && answer.value;
}

bool Wheel::actuator_set(control::LimitedEffort effort) {
  const auto answer = set_(number_, effort);
  return answer.status == CallStatus::kDone && answer.value;
}

/// Out of service it measures nothing, so that its joint is missed.
bool Wheel::sensor_read() {
  if (state() != component::State::kRunning) return false;
  const auto answer = read_(number_);
  if (answer.status != CallStatus::kDone || !answer.value.fresh) return false;
  if (on_ && !answer.value.on) {
    fault("the drive stopped by itself: no effort came for 100 ms");
    return false;
  }
  constexpr double kTurn = 2.0 * std::numbers::pi;
  index_.write(false);
  sensor_.write(static_cast<double>(answer.value.counts) * kTurn / counts_per_turn_);
  return true;
}

}  // namespace armature::rover
