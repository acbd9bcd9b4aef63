// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/holding_watch.hpp"

#include <algorithm>
#include <cmath>

#include "armature/base/seconds.hpp"
#include "armature/control/internal/mistakes.hpp"

namespace armature::control {

using Finding = HoldingWatch::Finding;
using Verdict = HoldingWatch::Verdict;

base::Result<HoldingWatch> HoldingWatch::make(const Config& config) {
  internal::Mistakes mistakes("HoldingWatch");
  mistakes.expect_positive("period [s]", base::to_seconds(config.period));
  mistakes.expect_positive("max_motion", config.max_motion);
  mistakes.expect_positive("max_velocity", config.max_velocity);
  mistakes.expect_not_negative("sinking_velocity", config.sinking_velocity);
  mistakes.expect(config.sinking_velocity <= config.max_velocity, "sinking_velocity",
                  config.sinking_velocity, "at most max_velocity");
  mistakes.expect_not_negative("least_effort", config.least_effort);
  mistakes.expect_positive("max_alternation", config.max_alternation);
  if (config.max_alternation <= 1.0) {
    mistakes.expect_positive("alternation_time [s]", base::to_seconds(config.alternation_time));
  }
  mistakes.expect_positive("rest_velocity", config.rest_velocity);
  mistakes.expect_not_negative("settling_time [s]", base::to_seconds(config.settling_time));
  if (const auto checked = mistakes.result(); !checked) return base::Error{checked.error()};
  return HoldingWatch(config);
}

HoldingWatch::HoldingWatch(const Config& config)
    : config_(config),
      alternation_weight_(std::min(
          1.0, base::to_seconds(config.period) / base::to_seconds(config.alternation_time))) {}

void HoldingWatch::stand() {
  if (is_to_stand()) return;
  state_ = {};
  state_.phase = Phase::kSettling;
}

void HoldingWatch::move() { state_.phase = Phase::kMayMove; }

Finding HoldingWatch::judge(const Measured& measured) {
  const Finding shaking = judge_effort(measured.driven ? measured.effort : 0.0);
  if (shaking.is_alarm()) return shaking;
  if (settles(measured)) return {.verdict = Verdict::kSettles};
  return judge_motion(measured);
}

Finding HoldingWatch::judge_effort(double effort) {
  count_alternation(effort);
  if (state_.alternation <= config_.max_alternation) return {};
  return {Verdict::kAlternates, state_.alternation, config_.max_alternation};
}

/// Its place is where it rests first, or where it is when its time is over.
bool HoldingWatch::settles(const Measured& measured) {
  if (state_.phase != Phase::kSettling) return false;
  const bool rests = std::abs(measured.velocity) <= config_.rest_velocity;
  state_.settling_for += config_.period;
  if (!rests && state_.settling_for < config_.settling_time) return true;
  state_.phase = Phase::kStanding;
  state_.place = measured.position;
  return false;
}

Finding HoldingWatch::judge_motion(const Measured& measured) {
  const double speed = std::abs(measured.velocity);
  const double may = measured.driven ? config_.max_velocity
                                     : std::max(config_.sinking_velocity, config_.rest_velocity);
  state_.fast_steps = speed <= may ? 0 : state_.fast_steps + 1;  // also what is no number
  if (state_.fast_steps >= kFastSteps) return {Verdict::kFast, speed, may};
  const bool sinks = !measured.driven && speed > 0.0 && speed <= config_.sinking_velocity;
  if (sinks) state_.place = measured.position;
  const double motion = std::abs(measured.position - state_.place);
  if (!(motion <= config_.max_motion)) return {Verdict::kMoved, motion, config_.max_motion};
  return {.verdict = sinks ? Verdict::kSinks : Verdict::kStands};
}

void HoldingWatch::count_alternation(double effort) {
  if (config_.max_alternation > 1.0) return;
  const double sign = std::abs(effort) > config_.least_effort ? std::copysign(1.0, effort) : 0.0;
  const bool alternates = sign * state_.last_sign < 0.0;
  state_.last_sign = sign;
  state_.alternation += alternation_weight_ * ((alternates ? 1.0 : 0.0) - state_.alternation);
}

}  // namespace armature::control
