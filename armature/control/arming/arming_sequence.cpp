// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/arming_sequence.hpp"

#include <algorithm>
#include <cmath>

#include "armature/base/seconds.hpp"
#include "armature/control/internal/mistakes.hpp"

namespace armature::control {

using Next = ArmingSequence::Next;

namespace {

/// An effort of before has gone after so many.
constexpr int kFewestSteps = 5;

}  // namespace

base::Result<ArmingSequence> ArmingSequence::make(const Config& config) {
  internal::Mistakes mistakes("ArmingSequence");
  mistakes.expect_positive("max_motion", config.max_motion);
  mistakes.expect_positive("effort_tolerance", config.effort_tolerance);
  mistakes.expect_positive("settling_time [s]", base::to_seconds(config.settling_time));
  mistakes.expect(config.patience > config.settling_time, "patience [s]",
                  base::to_seconds(config.patience), "more than settling_time");
  mistakes.expect_positive("watch_time [s]", base::to_seconds(config.watch_time));
  if (const auto checked = mistakes.result(); !checked) return base::Error{checked.error()};
  return ArmingSequence(config);
}

void ArmingSequence::begin(double position, base::Time now) {
  state_ = {.since = now, .settled = now, .place = position};
}

Next ArmingSequence::step(const Measured& measured, base::Time now) {
  const double moved = std::abs(measured.position - state_.place);
  state_.moved = std::max(state_.moved, moved);
  if (!(moved <= config_.max_motion)) return state_.let_go ? Next::kNotHeld : Next::kMovedBefore;
  if (!state_.let_go) return wait_for_effort(measured, now);
  if (!measured.driven) {
    state_.driven = now;
    return now - state_.since >= config_.patience ? Next::kNotDriven : Next::kWait;
  }
  return now - state_.driven >= config_.watch_time ? Next::kDone : Next::kWait;
}

Next ArmingSequence::wait_for_effort(const Measured& measured, base::Time now) {
  const bool within = std::abs(measured.effort - state_.effort) <= config_.effort_tolerance;
  if (!measured.caught_up || !measured.driven || !within) {
    state_.effort = measured.effort;
    state_.settled = now;
    state_.steps = 0;
  }
  ++state_.steps;
  if (state_.steps > kFewestSteps && now - state_.settled >= config_.settling_time) {
    state_ = {.let_go = true, .since = now, .driven = now, .place = measured.position};
    return Next::kLetGo;
  }
  return now - state_.since >= config_.patience ? Next::kNeverSettled : Next::kWait;
}

}  // namespace armature::control
