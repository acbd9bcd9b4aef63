// SPDX-License-Identifier: Apache-2.0
// What lets a joint move, what watches it while it is to stand, and what stops it.
#include <chrono>
#include <cmath>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/controllers/base/reason_text.hpp"
#include "armature/controllers/joint/joint.hpp"

namespace armature::controllers {

using component::Reason;
using control::ArmingSequence;
using control::HoldingWatch;

namespace {

/// How long a motor that is to be switched off may brake itself first.
constexpr base::Duration kLongestBraking = std::chrono::seconds(1);

/// A measured number as it is told: with four digits behind the point.
double told(double number) { return std::round(number * 1e4) / 1e4; }

}  // namespace

// --- arming ----------------------------------------------------------------------------------

void Joint::on_arm() {
  if (phase_ == Phase::kHoming) return fail_to_arm("it was homing: home it, then arm");
  if (phase_ != Phase::kDisarmed) return;
  if (!is_homed_enough()) {
    return fail_to_arm("it is not homed, and HomingRequired is set: call its command home");
  }
  if (!hardware_.knows_position()) {
    if (kept_.is_doubtful()) return fail_to_arm(kept_.question(told(measured_.position)));
    return fail_to_arm(why_unknown());
  }
  kept_.be_sure();
  unknown_ = Unknown::kNothing;
  if (!measured_lately()) {
    return fail_to_arm("it was not measured in this sampling period");
  }
  if (brake_ && !limiter_->arm(measured_)) {
    return fail_to_arm("its position is not a finite number");
  }
  off_at_rest_ = false;
  sent_ = 0.0;
  passed_ = false;
  phase_ = Phase::kTakingLoad;
  sequence_->begin(measured_.position, time());
  if (brake_ && !hardware_.actuator_on(limiter_->permit())) {
    fail_to_arm("its hardware does not switch on");
  }
}

/// Once a sample.
void Joint::go_on_arming() {
  const bool waits_for_motor = !brake_ && !sequence_->let_go();
  const double effort = effort_of(waits_for_motor ? commanded_ : sent_);
  const bool affordable = std::abs(effort) < max_effort();
  const auto next = sequence_->step({.position = measured_.position,
                                     .effort = effort,
                                     .caught_up = affordable && (passed_ || waits_for_motor),
                                     .driven = waits_for_motor || hardware_.is_as_told()},
                                    time());
  arming_moved_.assign(sequence_->moved());
  switch (next) {
    case ArmingSequence::Next::kWait:
      return;
    case ArmingSequence::Next::kLetGo:
      return let_go();
    case ArmingSequence::Next::kDone:
      return be_armed();
    case ArmingSequence::Next::kMovedBefore:
      return fail_to_arm(moved_before());
    case ArmingSequence::Next::kNeverSettled:
      return fail_to_arm(never_settled());
    case ArmingSequence::Next::kNotHeld:
      return fail_to_arm(not_held());
    case ArmingSequence::Next::kNotDriven:
      return fail_to_arm("its drive does not switch on, or its brake does not open");
  }
}

/// The effort that holds the joint is there: the brake opens, or the motor is switched on with it.
void Joint::let_go() {
  phase_ = Phase::kLetGo;
  bool done = false;
  if (brake_) {
    limiter_->end_rate_limit();
    done = hardware_.release_brake(limiter_->permit());
  } else if (limiter_->arm(measured_, effort_of(commanded_))) {
    apply(commanded_);
    done = phase_ == Phase::kLetGo && hardware_.actuator_on(limiter_->permit());
  }
  if (!done) fail_to_arm("its hardware does not switch on");
}

void Joint::be_armed() {
  phase_ = Phase::kArmed;
  watch_->move();
  following_.reset();
  still_.reset();
  way_told_ = 0.0;
  armed_.write(true);
  log_info("armed");
}

void Joint::fail_to_arm(const Reason& why) {
  if (phase_ != Phase::kDisarmed) disarm();
  log_error("not armed: {}", why.view());
  armed_.write(false);
  if (not_armed_.bound()) static_cast<void>(not_armed_.send(ComponentName(name()), why));
}

Reason Joint::why_unknown() const {
  Reason why;
  switch (unknown_) {
    case Unknown::kBegunToHome:
      why.append("it has begun to home, and has not found home: call its command home, or look");
      break;
    case Unknown::kOtherZero:
      why.append(
          "its InitialPos, SensorSign, GearRatio or SensorRange was changed since it was homed: "
          "call its command home, or look");
      break;
    case Unknown::kNothing:
      why.append("a sample of it was lost for good: look");
  }
  return why.append(
      " whether it is where its Position says, then set position_confirmed of its hardware");
}

Reason Joint::not_held() const {
  Reason why("it moved by ");
  append_number(why, told(sequence_->moved()))
      .append(" ")
      .append(units_.position().get())
      .append(" when ");
  why.append(brake_ ? "its brake opened at " : "its motor was switched on at ");
  append_number(why, told(sent_))
      .append(" ")
      .append(units_.command().get())
      .append(" (ArmingMotion: ");
  append_number(why, settings_->arming_motion);
  why.append(brake_ ? "), so it is braked again" : "), so it is off again");
  return why.append(
      "; have a model of its weight compute what holds it, support it, or mend its ActuatorSign");
}

Reason Joint::moved_before() const {
  Reason why("it moved by ");
  append_number(why, told(sequence_->moved()))
      .append(" ")
      .append(units_.position().get())
      .append(" ");
  why.append(brake_ ? "against its closed brake" : "before its motor was on");
  append_number(why.append(" (ArmingMotion: "), settings_->arming_motion);
  return why.append("), expected that it rests");
}

Reason Joint::never_settled() const {
  Reason why("what is to hold it did not settle: ");
  append_number(why, told(brake_ ? sent_ : commanded_)).append(" ").append(units_.command().get());
  if (is_effort(way_)) {
    append_number(why.append(" of "), max_effort()).append(" ").append(units_.command().get());
  }
  why.append(" at the position ");
  append_number(why, told(measured_.position));
  return why.append("; check that its reference is there, and within its limits");
}

// --- standing --------------------------------------------------------------------------------

void Joint::on_rest() {
  if (phase_ == Phase::kArmed) watch_->stand();
}

void Joint::watch() {
  const auto finding = watch_->step({.position = measured_.position,
                                     .velocity = measured_.velocity,
                                     .effort = effort_of(sent_),
                                     .driven = true});
  if (finding.is_alarm()) return brake_because(finding);
  if (!is_effort(way_)) watch_drive();
}

/// Whether the drive does what it was told last.
void Joint::watch_drive() {
  const bool by_velocity = way_ == JointCommand::kVelocity;
  const double is = by_velocity ? measured_.velocity : measured_.position;
  const bool moves =
      still_.step(measured_.position, std::exchange(way_told_, 0.0), period_.seconds());
  if (!moves) return fault_still();
  if (following_.step(is - sent_, time())) return;
  Reason why(by_velocity ? "its drive moves it at " : "its drive has it at ");
  append_number(why, told(is)).append(" ").append(units_.command().get()).append(" and was told ");
  append_number(why, told(sent_)).append(" (").append(names_.limit).append(": ");
  append_number(why, settings_->max_error).append("): braked. Look for what blocks it");
  switch_off();
  fault(why);
}

void Joint::fault_still() {
  Reason why("its position has stayed ");
  append_number(why, told(measured_.position)).append(" ").append(units_.position().get());
  why.append(
      " to the bit while its drive was told to move it: braked. Look at its sensor, and for "
      "what blocks it");
  switch_off();
  fault(why);
}

void Joint::brake_because(const HoldingWatch::Finding& finding) {
  Reason why("should stand still but ");
  switch (finding.verdict) {
    case HoldingWatch::Verdict::kMoved:
      append_number(why.append("moved by "), told(finding.measured))
          .append(" ")
          .append(units_.position().get())
          .append(" (HoldingMotion: ");
      break;
    case HoldingWatch::Verdict::kFast:
      append_number(why.append("moves at "), told(finding.measured))
          .append(" ")
          .append(units_.velocity().get())
          .append(" (HoldingVelocity: ");
      break;
    default:
      append_number(why.append("its effort changes its sign in a share of "),
                    told(finding.measured))
          .append(" of all samples (HoldingAlternation: ");
      break;
  }
  append_number(why, finding.bound).append("): braked. Check that its gains are stable");
  switch_off();
  fault(why);
}

/// A joint that nothing drives moves by its weight, or by a hand: there is nothing to brake it with
/// but the brake that it has.
void Joint::note_sinking(double displacement) {
  if (!brake_) return;
  sunk_.assign(sunk_ + displacement);
  if (told_of_sinking_ || std::abs(sunk_) <= settings_->holding_motion) return;
  told_of_sinking_ = true;
  log_warning("sinks: it moved by {} {} since it was disarmed, although its brake is applied",
              told(sunk_), units_.position().get() == "m" ? "m" : "rad");
}

// --- disarming -------------------------------------------------------------------------------

/// Hardware that moves by itself does not brake because its effort is 0.
/// @return the brake is applied
bool Joint::disarm() {
  if (phase_ == Phase::kHoming && homes_by_hardware()) return switch_off();
  const bool turns = std::abs(measured_.velocity) > rest_;
  if ((limiter_->armed() || own_.armed()) && measured_lately() && turns) {
    off_at_rest_ = true;
    disarmed_at_ = time();
  }
  const bool braked = brake_at_once();
  if (!off_at_rest_) cut_power();
  return braked;
}

/// Effort 0 and brake.
bool Joint::brake_at_once() {
  const bool was_homing = phase_ == Phase::kHoming;
  const bool was_armed = phase_ == Phase::kArmed;
  const bool was_driven = limiter_->armed() || own_.armed();
  if (phase_ != Phase::kDisarmed) {
    sunk_.assign(0.0);
    told_of_sinking_ = false;
  }
  phase_ = Phase::kDisarmed;
  limiter_->disarm();
  own_.disarm();
  if (was_homing && !homed_now_ && home_.active()) home_.fail("disarmed, so it does not home");
  stand_still();
  const bool braked = !brake_ || hardware_.apply_brake();
  armed_.write(false);
  if (was_armed) log_info("disarmed");
  if (was_driven && !braked) log_error("the hardware did not confirm that it brakes");
  return braked;
}

/// The brake first, so that nothing falls between the two.
bool Joint::switch_off() {
  brake_at_once();
  return cut_power();
}

bool Joint::cut_power() {
  off_at_rest_ = false;
  return hardware_.actuator_off();
}

void Joint::cut_power_at_rest() {
  const bool waited = time() - disarmed_at_ > kLongestBraking;
  if (waited || std::abs(measured_.velocity) <= rest_) cut_power();
}

bool Joint::brake_release(control::DrivePermit permit) {
  const bool held = phase_ == Phase::kLetGo || phase_ == Phase::kArmed;
  return held && hardware_.release_brake(permit);
}

}  // namespace armature::controllers
