// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic.hpp"

#include <cmath>
#include <numbers>

namespace armature::janus {

using component::CallStatus;
using component::Outcome;

Outcome AicOfAJoint::on_configure() {
  if (Outcome outcome = expect_wiring(); !outcome) return outcome;
  const Wiring wired = wiring();
  motor_inverted_ = wired.motor_inverted;
  rad_per_count_ =
      2.0 * std::numbers::pi / counts_per_turn_ * wired.displacement_sign * wired.motion;
  return component::accepted();
}

Outcome AicOfAJoint::on_start() {
  on_ = false;
  return component::accepted();
}

bool AicOfAJoint::sensor_read() {
  const auto answer = read_card_(number_);
  if (answer.status != CallStatus::kDone || !usable(answer.value)) return false;
  index_.write(answer.value.index);
  sensor_.write(static_cast<double>(answer.value.counts) * rad_per_count_);
  return true;
}

bool AicOfAJoint::usable(const AicSample& sample) {
  if (sample.no_bus) {
    fault("the bus of the card is gone");
  } else if (sample.restarted) {
    lose_position();
    fault("the card restarted: what moved meanwhile is not known");
  } else if (sample.fresh && on_ && !sample.actuator_on) {
    fault("the card switched its actuator off by itself");
  }
  if (sample.counts_lost) note_lost_counts();
  return sample.fresh && state() == component::State::kRunning;
}

void AicOfAJoint::note_lost_counts() {
  lose_position();
  log_error("a report of card {} was lost, and its counts: the position is not exact", number_());
}

/// What the card has against it, such as its watchdog, is acknowledged first.
bool AicOfAJoint::actuator_on() {
  on_ = command(AicCommand::kActuatorOff) && energize(AicCommand::kActuatorOn);
  return on_;
}

bool AicOfAJoint::actuator_off() {
  on_ = false;
  return command(AicCommand::kActuatorOff);
}

bool AicOfAJoint::actuator_set(control::LimitedEffort effort) {
  const auto answer = set_motor_(number_, motor_inverted_ ? -effort : effort);
  return answer.status == CallStatus::kDone && answer.value;
}

bool AicOfAJoint::command(AicCommand command) {
  const auto answer = command_card_(number_, static_cast<int>(command));
  return answer.status == CallStatus::kDone && answer.value;
}

bool AicOfAJoint::energize(AicCommand command) {
  const auto answer = energize_card_(number_, static_cast<int>(command), permit());
  return answer.status == CallStatus::kDone && answer.value;
}

// --- how it is wired -------------------------------------------------------------------------

Outcome Aic::expect_wiring() const {
  if (std::abs(motor_sign_) == 1.0 && std::abs(encoder_sign_) == 1.0) return component::accepted();
  return component::refused("MotorSign and EncoderSign must be 1 or -1");
}

AicOfAJoint::Wiring Aic::wiring() const {
  return {.motor_inverted = motor_sign_ < 0.0,
          .displacement_sign = encoder_sign_,
          .motion = gear_ratio_};
}

AicOfAJoint::Wiring AicWithGear::wiring() const {
  return {.motor_inverted = motor_sign_,
          .displacement_sign = encoder_sign_ ? -1.0 : 1.0,
          .motion = 1.0 / gear_ratio_};
}

}  // namespace armature::janus
