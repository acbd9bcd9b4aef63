// SPDX-License-Identifier: Apache-2.0
// How a joint finds its position: its hardware moves by itself, or the joint does, or the operator
// says where it is.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "armature/base/seconds.hpp"
#include "armature/component/face.hpp"
#include "armature/controllers/base/reason_text.hpp"
#include "armature/controllers/joint/joint.hpp"

namespace armature::controllers {

using component::Outcome;
using component::Reason;
using control::ArmingSequence;

namespace {

/// What moves by itself may be unseen for as long, or for two periods.
constexpr base::Duration kLongestUnseen = std::chrono::milliseconds(50);
// What `homingStage` says.
constexpr int kAtHome = 2;
constexpr int kHomingFailed = 3;

double four_digits(double number) { return std::round(number * 1e4) / 1e4; }

}  // namespace

Outcome Joint::begin_homing() {
  if (homes_by_hardware() && !hardware_.homes()) {
    return component::refused(
        "its hardware does not home by itself: give the joint a HomingMethod");
  }
  if (Outcome outcome = may_home(); !outcome) return outcome;
  if (homing_.method() != HomingMethod::kHere) {
    if (Outcome outcome = may_move_to_home(); !outcome) return outcome;
  }
  homing_since_ = time();
  homing_way_ = 0.0;
  homing_jumped_ = false;
  if (homes_by_hardware()) return begin_by_hardware();
  if (homing_.moves()) return begin_by_itself();
  phase_ = Phase::kHoming;  // until the next sample, which ends it
  return component::accepted();
}

Outcome Joint::may_home() const {
  if (phase_ == Phase::kHoming) return component::refused("it homes already");
  if (phase_ != Phase::kDisarmed || off_at_rest_) {
    return component::refused("it is armed: disarm first, then home, then arm");
  }
  if (arming_ == nullptr || arming_->state() != component::State::kRunning) {
    return component::refused("no Arming runs that could disarm it");
  }
  if (!measured_lately() || std::abs(measured_.velocity) > rest_) {
    return component::refused("it does not rest, or was not measured in this sampling period");
  }
  if (!std::isfinite(measured_.position)) {
    return component::refused("its position is not a finite number");
  }
  return component::accepted();
}

/// Samples are what watches it: whoever stops to make them has to stop it, too.
Outcome Joint::may_move_to_home() const {
  if (!sampler_) {
    return component::refused(
        "Sampler is false: nobody would brake it if whoever calls sensorRead no longer did");
  }
  const component::InputPortBase& input = face(command_);
  const bool stops = input.stale_reaction() == component::Reaction::kStop ||
                     input.stale_reaction() == component::Reaction::kFault;
  const base::Duration longest = std::max(kMaxAge, 4 * period_.duration());
  if (stops && input.max_age() <= longest) return component::accepted();
  Reason why("its input ");
  append_number(why.append(names_.command).append(" takes commands that are older than "),
                base::to_seconds(longest));
  why.append(
      " s: nobody would brake it if samples no longer came. Leave out max_age and on_old of its "
      "connection");
  return component::refused(why.view());
}

void Joint::cancel_homing() {
  if (phase_ == Phase::kHoming) disarm();
}

/// Once a sample, also where none comes.
bool Joint::is_homing_watched() {
  if (phase_ != Phase::kHoming) return true;
  if (time() - homing_since_ > base::from_seconds(settings_->homing_time)) {
    Reason why("it has not found home within ");
    append_number(why, settings_->homing_time).append(" s (HomingTime): braked");
    fail_homing(why, false);
    return false;
  }
  if (time() - measured_at_ > std::max(kLongestUnseen, 2 * period_.duration())) {
    fail_homing("it homes and was not measured: braked", true);
    return false;
  }
  return true;
}

void Joint::fail_homing(const Reason& why, bool is_fault) {
  if (home_.active()) home_.fail(why.view());
  if (is_fault) {
    switch_off();
    return fault(why);
  }
  disarm();
  log_error("not homed: {}", why.view());
}

// --- by its hardware -------------------------------------------------------------------------

Outcome Joint::begin_by_hardware() {
  if (!limiter_->arm(measured_)) {
    return component::refused("its position is not a finite number");
  }
  phase_ = Phase::kHoming;
  if (hardware_.home(limiter_->permit()) && begin_search(limiter_->permit())) {
    return component::accepted();
  }
  switch_off();
  return component::refused(
      "its hardware does not begin: give it a homing_method, and look at its state");
}

void Joint::follow_homing(double displacement) {
  homing_way_ += displacement;
  if (std::abs(measured_.velocity) > settings_->max_velocity) {
    Reason why("its hardware homes at ");
    append_number(why, measured_.velocity).append(" ").append(units_.velocity().get());
    append_number(why.append(" (MaxVelocity: "), settings_->max_velocity);
    return fail_homing(why.append("): braked. Set a slower homing speed"), true);
  }
  const double range = settings_->highest() - settings_->lowest();
  if (std::abs(homing_way_) > range) {
    Reason why("its hardware has moved it by ");
    append_number(why, homing_way_).append(" ").append(units_.position().get());
    append_number(why.append(" without finding home, and its range is "), range);
    return fail_homing(why.append(": braked. Look at the switch"), true);
  }
  const std::optional<int> stage = hardware_.homing_stage();
  if (stage == kAtHome) return be_homed();
  if (stage != kHomingFailed) return;
  fail_homing("its hardware says that homing failed: braked. Look at its switch and its load",
              false);
}

/// Once, at its new zero: nothing is known of its velocity in this sample.
void Joint::homing_jumped(double position) {
  homing_jumped_ = true;
  measured_ = {.position = position, .velocity = 0.0};
  measured_at_ = time();
  displacement_read_ = 0.0;
  displacement_.write(0.0);
  position_.write(position);
}

void Joint::be_homed() {
  if (!hardware_.find_position(limiter_->permit())) {
    return fail_homing("a sample of it was lost while it homed: home it again", false);
  }
  unknown_ = Unknown::kNothing;
  kept_.be_sure();
  homed_now_ = true;
  switch_off();
  tell_homed();
}

// --- by itself -------------------------------------------------------------------------------

Outcome Joint::begin_by_itself() {
  off_at_rest_ = false;
  looks_for_home_ = false;
  const bool ready = own_.hold() && begin_search(own_.permit());
  phase_ = Phase::kHoming;
  if (ready && (!brake_ || hardware_.actuator_on(own_.permit()))) {
    sequence_->begin(measured_.position, time());
    return component::accepted();
  }
  switch_off();
  return component::refused("its hardware does not switch on, or does not bound its effort");
}

/// From now on nobody knows where it is.
bool Joint::begin_search(control::DrivePermit permit) {
  homed_.assign(false);
  unknown_ = Unknown::kBegunToHome;
  // An effort of the joint is that of its motor by the gear.
  const double most = own_.most_effort() * std::abs(sensor_ratio_);
  return hardware_.begin_search(permit, most);
}

/// Once a sample.
void Joint::follow_own_homing(double displacement) {
  if (!homing_.moves()) return be_here();
  homing_way_ += displacement;
  if (looks_for_home_) {
    look_for_home();
  } else {
    let_go_to_home();
  }
  if (phase_ == Phase::kHoming) write_homing();
}

/// As when it is armed: it is held, let go, and watched.
void Joint::let_go_to_home() {
  const bool waits_for_motor = !brake_ && !sequence_->let_go();
  const auto next = sequence_->step({.position = measured_.position,
                                     .effort = 0.0,
                                     .caught_up = true,
                                     .driven = waits_for_motor || hardware_.is_as_told()},
                                    time());
  switch (next) {
    case ArmingSequence::Next::kWait:
      return;
    case ArmingSequence::Next::kLetGo:
      if (switch_on_to_home()) return;
      return fail_homing("its hardware does not switch on, or does not release its brake", false);
    case ArmingSequence::Next::kDone:
      looks_for_home_ = true;
      return own_.search(index_closed_);
    case ArmingSequence::Next::kMovedBefore:
      return fail_homing(moved_before(), false);
    case ArmingSequence::Next::kNotHeld: {
      Reason why("it moved by ");
      append_number(why, four_digits(sequence_->moved())).append(" ");
      append_number(
          why.append(units_.position().get()).append(" when it was let go (ArmingMotion: "),
          settings_->arming_motion);
      return fail_homing(why.append("): braked. Its HomingStiffness has to hold its weight"),
                         false);
    }
    default:
      return fail_homing("its drive does not switch on, or its brake does not open", false);
  }
}

bool Joint::switch_on_to_home() {
  return brake_ ? hardware_.release_brake(own_.permit()) : hardware_.actuator_on(own_.permit());
}

void Joint::look_for_home() {
  const std::optional<double> since = hardware_.since_index();
  const OwnHoming::Status status = own_.step({.way = homing_way_,
                                              .switch_closed = index_closed_,
                                              .index_passed = since.has_value(),
                                              .since_index = sensor_ratio_ * since.value_or(0.0)});
  if (status == OwnHoming::Status::kGoesOn) return;
  if (status == OwnHoming::Status::kHome) return be_homed_by_itself();
  fail_homing(own_.why(status, homing_way_).append(". Braked"), false);
}

/// Nothing but the motion to home commands the hardware meanwhile.
void Joint::write_homing() {
  const OwnHoming::Measured measured{.position = homing_way_, .velocity = measured_.velocity};
  if (is_effort(way_)) return command_output_.write(own_.effort(measured).scaled(effort_ratio_));
  if (way_ == JointCommand::kVelocity) {
    return command_output_.write(own_.velocity(measured).scaled(1.0 / sensor_ratio_));
  }
  const double here = measured_.position - homing_way_;
  command_output_.write(own_.position(measured).counted(1.0 / sensor_ratio_, absolute_->at(here)));
}

void Joint::be_homed_by_itself() {
  if (!hardware_.find_position(own_.permit())) {
    return fail_homing("a sample of it was lost while it homed: home it again", false);
  }
  const double position = homing_->position + homing_way_ - own_.motion().found_at();
  homed_now_ = true;
  switch_off();
  be_at(position);
}

/// Its command ends with the sample that says so.
void Joint::be_at(double position) {
  const double by = position - measured_.position;
  measured_.position = position;
  absolute_->shift(by);
  unknown_ = Unknown::kNothing;
  is_found_ = true;
  kept_.be_sure();
  homed_.assign(true);
}

/// Nothing moves, and nothing is switched on: the permit goes no farther than to say so.
void Joint::be_here() {
  const bool found =
      own_.hold() && begin_search(own_.permit()) && hardware_.find_position(own_.permit());
  if (!found) return fail_homing("its hardware does not run", false);
  homed_now_ = true;
  switch_off();
  be_at(homing_->position);
}

void Joint::tell_homed() {
  homed_now_ = false;
  home_.complete();
  const char* const unit = units_.position().get() == "m" ? "m" : "rad";
  log_info("homed: it is at {} {}, disarmed", four_digits(measured_.position), unit);
  if (homes_by_hardware() || !homing_.is_of_absolute_sensor()) return;
  Reason line("to keep that, write into the deployment:  ");
  append_number(line.append(name()).append(": {override: true, properties: {InitialPos: "),
                absolute_->offset());
  log_info("{}", line.append(" ").append(unit).append("}}").view());
}

}  // namespace armature::controllers
