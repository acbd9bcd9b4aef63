// SPDX-License-Identifier: Apache-2.0
// Hardware that homes: it moves by itself, and its position is new then.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "armature/base/seconds.hpp"
#include "armature/controllers/base/reason_text.hpp"
#include "armature/controllers/joint/joint.hpp"

namespace armature::controllers {

using component::Outcome;
using component::Reason;

namespace {

/// Hardware that moves by itself may be unseen for as long, or for two periods.
constexpr base::Duration kLongestUnseen = std::chrono::milliseconds(50);
// What `homingStage` says.
constexpr int kAtHome = 2;
constexpr int kHomingFailed = 3;

}  // namespace

Outcome Joint::begin_homing() {
  if (!home_by_itself_.bound() || !homing_stage_.bound()) {
    return component::refused("its hardware does not home by itself");
  }
  if (phase_ == Phase::kHoming) return component::refused("it homes already");
  if (phase_ != Phase::kDisarmed || off_at_rest_) {
    return component::refused("it is armed: disarm first, then home, then arm");
  }
  if (arming_ == nullptr || arming_->state() != component::State::kRunning) {
    return component::refused("no Arming runs that could disarm it");
  }
  if (!measured_lately() || std::abs(measured_.velocity) > kRest) {
    return component::refused("it does not rest, or was not measured in this sampling period");
  }
  if (!limiter_->arm(measured_)) {
    return component::refused("its position is not a finite number");
  }
  phase_ = Phase::kHoming;
  homing_since_ = time();
  homing_way_ = 0.0;
  homing_jumped_ = false;
  if (succeeds(home_by_itself_, limiter_->permit())) return component::accepted();
  switch_off();
  return component::refused(
      "its hardware does not begin: give it a homing_method, and look at its state");
}

void Joint::cancel_homing() {
  if (phase_ == Phase::kHoming) switch_off();
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
    fail_homing("its hardware moves it and was not measured: braked", true);
    return false;
  }
  return true;
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
  const auto stage = homing_stage_();
  if (stage.status != component::CallStatus::kDone) return;
  if (stage.value == kAtHome) return be_homed();
  if (stage.value != kHomingFailed) return;
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
  home_.complete();
  switch_off();
  log_info("homed: it is at {} {}, disarmed", std::round(measured_.position * 1e4) / 1e4,
           units_.position().get() == "m" ? "m" : "rad");
}

void Joint::fail_homing(const Reason& why, bool is_fault) {
  if (home_.active()) home_.fail(why.view());
  switch_off();
  if (is_fault) return fault(why);
  log_error("not homed: {}", why.view());
}

}  // namespace armature::controllers
