// SPDX-License-Identifier: Apache-2.0
#include "armature/control/homing/homing_motion.hpp"

#include <algorithm>
#include <cmath>

#include "armature/control/internal/mistakes.hpp"

namespace armature::control {
namespace {

/// What a joint did is compared with what it was told at least as often.
constexpr double kWindow = 0.05;  // s
constexpr int kStepsOfWindow = 5;
/// Of what it was told: one that moves less does not move.
constexpr double kLeastShare = 0.2;
/// Of the tolerance: what moves less in a window rests.
constexpr double kRestShare = 0.2;
/// Of the tolerance: a switch that is still open so far away is left.
constexpr double kLeftShare = 0.1;

double window(double period_s) { return std::max(kWindow, kStepsOfWindow * period_s); }

}  // namespace

base::Result<HomingMotion> HomingMotion::make(const Config& config) {
  internal::Mistakes mistakes("HomingMotion");
  mistakes.expect(std::isfinite(config.velocity) && config.velocity != 0.0, "velocity",
                  config.velocity, "a finite number other than 0");
  mistakes.expect_positive("acceleration", config.acceleration);
  mistakes.expect_positive("tolerance", config.tolerance);
  mistakes.expect(std::isfinite(config.travel) && config.travel > 4.0 * config.tolerance, "travel",
                  config.travel, "a finite number above four times the tolerance");
  mistakes.expect(config.back_off > 2.0 * config.tolerance && config.back_off < config.travel,
                  "back_off", config.back_off,
                  "a number above twice the tolerance and below the travel");
  mistakes.expect_positive("lead", config.lead);
  mistakes.expect_not_negative("patience_s", config.patience_s);
  mistakes.expect_positive("period_s", config.period_s);
  if (const auto checked = mistakes.result(); !checked) return base::Error{checked.error()};
  return HomingMotion(config);
}

void HomingMotion::begin(bool switch_closed) {
  const Config config = config_;
  *this = HomingMotion(config);
  still_ = StillWatch({.most = config_.tolerance});
  was_closed_ = switch_closed;
  const bool by_switch =
      config_.sign == HomeSign::kSwitch || config_.sign == HomeSign::kSwitchThenIndex;
  if (by_switch && switch_closed) return enter(Stage::kToEdge, slowly_back());
  enter(Stage::kSearching, config_.velocity);
}

HomingMotion::Status HomingMotion::step(const Measured& measured) {
  if (!(std::abs(measured.way) <= config_.travel)) return Status::kBeyond;
  if (const Status status = judge(measured); status != Status::kGoesOn) return status;
  if (!gives_up_) look(measured);
  go_on(measured.way);
  return Status::kGoesOn;
}

// --- whether it obeys ------------------------------------------------------------------------

HomingMotion::Status HomingMotion::judge(const Measured& measured) {
  moved_ = measured.way - window_begin_;
  if (is_astray()) return Status::kAstray;
  if (stage_ == Stage::kFindingAgain && outwards(measured.way - touched_) > config_.tolerance) {
    return Status::kStopGaveWay;
  }
  if (takes_up_) {
    to_wait_ = std::max(0, to_wait_ - 1);
    takes_up_ = !has_taken_up(measured.way);
    still_.reset();
    if (!takes_up_) begin_window(measured.way);
    return Status::kGoesOn;
  }
  if (looks_for_stop()) {
    still_.reset();
  } else if (!still_.step(measured.way, velocity_ * config_.period_s, config_.period_s)) {
    return Status::kBlocked;
  }
  ++steps_;
  const bool long_enough = steps_ * config_.period_s >= window(config_.period_s);
  const bool far_enough = !full_speed_ || std::abs(told_) >= 0.5 * config_.tolerance;
  return long_enough && far_enough ? end_window(measured.way) : Status::kGoesOn;
}

bool HomingMotion::is_astray() const {
  const double most = config_.tolerance + std::abs(config_.velocity) * window(config_.period_s);
  const double least_way = takes_up_ ? std::min(0.0, told_) : told_;
  const double most_way = takes_up_ ? std::max(0.0, told_) : told_;
  return moved_ < least_way - most || moved_ > most_way + most;
}

/// Either it has all that it may have and should move by now, or it has what moves it.
bool HomingMotion::has_taken_up(double way) const {
  if (to_wait_ > 0) return false;
  const double ahead = side_ * (desired_ - way);
  return ahead >= 0.999 * config_.lead || std::abs(told_) > 2.0 * config_.lead;
}

HomingMotion::Status HomingMotion::end_window(double way) {
  const double onward = told_ > 0.0 ? moved_ : -moved_;
  if (full_speed_ && onward < -kLeastShare * std::abs(told_)) return Status::kAstray;
  if (full_speed_ && onward < kLeastShare * std::abs(told_)) {
    return looks_for_stop() ? touch(way) : Status::kBlocked;
  }
  const bool rests = told_ == 0.0 && std::abs(moved_) < kRestShare * config_.tolerance;
  if (rests && gives_up_) return Status::kNothingFound;
  if (rests && stage_ == Stage::kEnding) return Status::kHome;
  begin_window(way);
  return Status::kGoesOn;
}

void HomingMotion::begin_window(double way) {
  window_begin_ = way;
  told_ = moved_ = 0.0;
  steps_ = 0;
  full_speed_ = true;
}

bool HomingMotion::looks_for_stop() const {
  if (gives_up_ || config_.sign != HomeSign::kHardStop) return false;
  return stage_ == Stage::kSearching || stage_ == Stage::kFindingAgain;
}

/// It pushes no more.
HomingMotion::Status HomingMotion::touch(double way) {
  found_again_ = stage_ == Stage::kFindingAgain;
  if (found_again_ && std::abs(way - touched_) > config_.tolerance) return Status::kStopGaveWay;
  touched_ = found_at_ = way;
  velocity_ = 0.0;
  desired_ = way;
  enter(Stage::kBackingOff, -config_.velocity);
  return Status::kGoesOn;
}

// --- what it looks for -----------------------------------------------------------------------

void HomingMotion::look(const Measured& measured) {
  switch (stage_) {
    case Stage::kSearching:
    case Stage::kToIndex:
      return look_for_sign(measured);
    case Stage::kToEdge:
      return look_for_edge(measured);
    case Stage::kBackingOff:
      if (std::abs(measured.way - touched_) < config_.back_off) return;
      return found_again_ ? enter(Stage::kEnding, 0.0)
                          : enter(Stage::kFindingAgain, -slowly_back());
    case Stage::kFindingAgain:
    case Stage::kEnding:
      return;
  }
}

void HomingMotion::look_for_sign(const Measured& measured) {
  const bool by_index = config_.sign == HomeSign::kIndex || stage_ == Stage::kToIndex;
  if (by_index) {
    if (!measured.index_passed) return;
    found_at_ = measured.way - measured.since_index;
    return enter(Stage::kEnding, 0.0);
  }
  if (config_.sign != HomeSign::kHardStop && measured.switch_closed) {
    enter(Stage::kToEdge, slowly_back());
  }
}

/// Not before it has turned round: a short cam may have been passed. It may pass it also then, by
/// what it lags behind, and comes back over it: the edge is the one behind which it stays open.
void HomingMotion::look_for_edge(const Measured& measured) {
  const bool goes_on = outwards(velocity_) > 0.0;
  if (opened_at_ && measured.index_passed && !mark_) mark_ = measured.way - measured.since_index;
  if (!goes_on && was_closed_ && !measured.switch_closed) {
    opened_at_ = measured.way;
    mark_.reset();
  }
  was_closed_ = !goes_on && measured.switch_closed;
  if (measured.switch_closed) opened_at_.reset();
  if (!opened_at_) return;
  if (outwards(*opened_at_ - measured.way) < kLeftShare * config_.tolerance) return;
  found_at_ = *opened_at_;
  if (config_.sign != HomeSign::kSwitchThenIndex) return enter(Stage::kEnding, 0.0);
  if (!mark_) return enter(Stage::kToIndex, slowly_back());
  found_at_ = *mark_;
  enter(Stage::kEnding, 0.0);
}

void HomingMotion::enter(Stage stage, double target) {
  stage_ = stage;
  target_ = target;
}

// --- how it moves ----------------------------------------------------------------------------

void HomingMotion::go_on(double way) {
  if (stage_ != Stage::kEnding && would_leave(way)) {
    gives_up_ = true;
    target_ = 0.0;
  }
  const double change = config_.acceleration * config_.period_s;
  velocity_ = std::clamp(target_, velocity_ - change, velocity_ + change);
  note_direction(way);
  full_speed_ = full_speed_ && velocity_ == target_ && target_ != 0.0;
  told_ += velocity_ * config_.period_s;
  desired_ =
      std::clamp(desired_ + velocity_ * config_.period_s, way - config_.lead, way + config_.lead);
}

/// At the first start nothing has pushed it the other way.
void HomingMotion::note_direction(double way) {
  const double side = velocity_ == 0.0 ? 0.0 : std::copysign(1.0, velocity_);
  if (side == side_) return;
  side_ = side;
  takes_up_ = side != 0.0;
  begin_window(way);
  const bool turns_round = side * last_side_ < 0.0;
  to_wait_ = turns_round ? static_cast<int>(config_.patience_s / config_.period_s) : 0;
  if (side != 0.0) last_side_ = side;
}

/// Unless it brakes now.
bool HomingMotion::would_leave(double way) const {
  const double velocity = velocity_ != 0.0 ? velocity_ : target_;
  const double side = velocity > 0.0 ? 1.0 : -1.0;
  const double out = std::max(side * way, side * desired_);
  const double braking = 0.5 * velocity_ * velocity_ / config_.acceleration +
                         2.0 * std::abs(velocity_) * config_.period_s;
  return out + braking >= config_.travel - config_.tolerance;
}

}  // namespace armature::control
