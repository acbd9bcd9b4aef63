// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/online_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "armature/control/internal/mistakes.hpp"
#include "armature/control/online/bring_within.hpp"
#include "armature/control/online/stops.hpp"

namespace armature::control {
namespace {

/// Of the shortest time: who says it with a few digits means it.
constexpr double kAsFastOnline = 1.0 - 1e-6;
/// By which rounding may leave the position limits.
constexpr double kPositionRounding = 1e-9;
/// So often along a motion its other limits are looked at.
constexpr int kOnlineLooks = 128;
/// So often it is made longer until it keeps them, and then shorter by halves of what that was.
constexpr int kMostLonger = 6;
constexpr int kBisections = 6;

bool all_finite(std::span<const double> numbers, std::size_t& axis) {
  for (axis = 0; axis < numbers.size(); ++axis) {
    if (!std::isfinite(numbers[axis])) return false;
  }
  return true;
}

bool at_rest(const MotionSample& state) {
  return state.velocity == 0.0 && state.acceleration == 0.0;
}

}  // namespace

base::Result<void> OnlineTrajectory::check(const Config& config) {
  internal::Mistakes mistakes("OnlineTrajectory");
  mistakes.expect(!config.axes.empty(), "the number of axes", 0.0, "at least 1");
  for (std::size_t i = 0; i < config.axes.size(); ++i) {
    const Axis& axis = config.axes[i];
    const std::string name = "axes[" + std::to_string(i) + "].";
    mistakes.expect_positive(name + "max_velocity", axis.max_velocity);
    mistakes.expect_positive(name + "max_acceleration", axis.max_acceleration);
    mistakes.expect_positive(name + "max_jerk", axis.max_jerk);
    mistakes.expect_ends(name, axis.lower, axis.upper);
  }
  return mistakes.result();
}

base::Result<OnlineTrajectory> OnlineTrajectory::make(const Config& config) {
  if (const auto checked = check(config); !checked) return base::Error{checked.error()};
  return OnlineTrajectory(config);
}

OnlineTrajectory::OnlineTrajectory(const Config& config)
    : axes_(config.axes),
      motions_(axes_.size()),
      next_(axes_.size()),
      problems_(axes_.size()),
      within_s_(axes_.size()),
      targets_(axes_.size()),
      looked_at_(axes_.size()),
      velocities_there_(axes_.size()),
      positions_(axes_.size()),
      velocities_(axes_.size()),
      accelerations_(axes_.size()) {}

JerkLimits OnlineTrajectory::limits_of(std::size_t axis) const {
  return {axes_[axis].max_velocity, axes_[axis].max_acceleration, axes_[axis].max_jerk};
}

MotionSample OnlineTrajectory::state_of(const State& state, std::size_t axis) {
  return {state.positions[axis], state.velocities.empty() ? 0.0 : state.velocities[axis],
          state.accelerations.empty() ? 0.0 : state.accelerations[axis]};
}

OnlineTrajectory::Answer OnlineTrajectory::check_state(const State& state) const {
  const std::size_t axes = axes_.size();
  const auto fits = [axes](std::span<const double> numbers) {
    return numbers.empty() || numbers.size() == axes;
  };
  if (state.positions.size() != axes || !fits(state.velocities) || !fits(state.accelerations)) {
    return {TargetRefusal::kWrongNumber};
  }
  for (const auto& numbers : {state.positions, state.velocities, state.accelerations}) {
    std::size_t axis = 0;
    if (!all_finite(numbers, axis)) return {TargetRefusal::kNotFinite, axis};
  }
  return {};
}

OnlineTrajectory::Answer OnlineTrajectory::hold(std::span<const double> positions) {
  if (const Answer answer = check_state({positions}); !answer.accepted()) return answer;
  for (std::size_t i = 0; i < axes_.size(); ++i) next_[i].begin({positions[i], 0.0, 0.0});
  has_target_ = false;
  begin(0.0);
  return {};
}

OnlineTrajectory::Answer OnlineTrajectory::begin_at(const State& state) {
  if (const Answer answer = check_state(state); !answer.accepted()) return answer;
  for (std::size_t i = 0; i < axes_.size(); ++i) motions_[i].begin(state_of(state, i));
  duration_s_ = 0.0;
  elapsed_ = {};
  brake_all();
  return {};
}

OnlineTrajectory::Answer OnlineTrajectory::check_target(const State& target, double time_s) const {
  if (const Answer answer = check_state(target); !answer.accepted()) return answer;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto [position, velocity, acceleration] = state_of(target, i);
    const JerkLimits limits = limits_of(i);
    if (position < axes_[i].lower || position > axes_[i].upper) {
      return {TargetRefusal::kOutsideLimits, i};
    }
    if (!within(limits, velocity, 0.0, 1.0)) return {TargetRefusal::kVelocityTooHigh, i};
    if (!within(limits, velocity, acceleration, 1.0) ||
        !within(limits, velocity, acceleration, -1.0)) {
      return {TargetRefusal::kAccelerationTooHigh, i};
    }
  }
  if (!std::isfinite(time_s)) return {TargetRefusal::kNotFinite};
  if (time_s < 0.0) return {TargetRefusal::kNegativeTime};
  return {};
}

/// A motion that is under way is not solved again: its state is only as exact as rounding is.
bool OnlineTrajectory::goes_there(const State& target, double time_s) const {
  if (!has_target_ || time_s != asked_s_) return false;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto [position, velocity, acceleration] = state_of(target, i);
    if (position != targets_[i].position || velocity != targets_[i].velocity ||
        acceleration != targets_[i].acceleration) {
      return false;
    }
  }
  return true;
}

MotionSample OnlineTrajectory::now(std::size_t axis) const {
  return motions_[axis].at(elapsed_s());
}

/// The problem that remains where the axis is within its limits.
void OnlineTrajectory::pose(std::size_t axis, const MotionSample& target,
                            const JerkLimits& limits) {
  PhasedMotion& motion = next_[axis];
  motion.begin(now(axis));
  bring_within(limits, motion);
  within_s_[axis] = motion.duration_s();
  problems_[axis].emplace(limits, motion.end(), target);
}

/// The first duration from `from_s` on that is possible for all axes.
double OnlineTrajectory::least_duration_s(double from_s) const {
  constexpr int kMostRounds = 64;  // at most four blocked ranges of each axis are passed
  double duration_s = from_s;
  for (int round = 0; round < kMostRounds; ++round) {
    const double before_s = duration_s;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const double left_s = std::max(0.0, duration_s - within_s_[i]);
      const double first_s = problems_[i]->first_duration(left_s);
      if (first_s > left_s)
        duration_s = within_s_[i] + first_s;
      else
        duration_s = std::max(duration_s, within_s_[i]);
    }
    if (duration_s == before_s) break;
  }
  return duration_s;
}

OnlineTrajectory::Answer OnlineTrajectory::move_to(const State& target, double time_s,
                                                   MotionLimit* limit) {
  if (const Answer answer = check_target(target, time_s); !answer.accepted()) return answer;
  if (!position_known_) return {TargetRefusal::kNoPosition};
  if (goes_there(target, time_s)) return {};
  const Answer answer =
      limit == nullptr ? plan(target, time_s) : plan_within(target, time_s, *limit);
  if (!answer.accepted()) return answer;
  for (std::size_t i = 0; i < axes_.size(); ++i) targets_[i] = state_of(target, i);
  has_target_ = true;
  asked_s_ = time_s;
  begin(planned_s_);
  return {};
}

/// Lets `next_` be the motion to `target`.
OnlineTrajectory::Answer OnlineTrajectory::plan(const State& target, double time_s) {
  for (std::size_t i = 0; i < axes_.size(); ++i) pose(i, state_of(target, i), limits_of(i));
  const double shortest_s = least_duration_s(0.0);
  if (time_s > 0.0 && time_s < kAsFastOnline * shortest_s) {
    return {TargetRefusal::kTooFast, kNoAxis, shortest_s};
  }
  planned_s_ = time_s > shortest_s ? least_duration_s(time_s) : shortest_s;
  if (!(planned_s_ <= kLongest_s)) return {TargetRefusal::kTooLong};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!solve(i, state_of(target, i), planned_s_, limits_of(i)))
      return {TargetRefusal::kLeavesLimits, i};
  }
  return {};
}

/// The fastest first, so that a refusal says how long it takes.
OnlineTrajectory::Answer OnlineTrajectory::plan_within(const State& target, double time_s,
                                                       MotionLimit& limit) {
  const Answer answer = lengthen(target, 0.0, limit);
  if (!answer.accepted() || time_s == 0.0) return answer;
  if (time_s < kAsFastOnline * planned_s_) return {TargetRefusal::kTooFast, kNoAxis, planned_s_};
  return time_s > planned_s_ ? lengthen(target, time_s, limit) : answer;
}

/// What it uses of the limit falls with the duration; the least one that is found is taken. A
/// motion between rest and rest keeps it if it takes longer by the share that was used: scaled in
/// time it would just keep it, and its plateaus are no faster than then.
OnlineTrajectory::Answer OnlineTrajectory::lengthen(const State& target, double time_s,
                                                    MotionLimit& limit) {
  Answer answer = plan(target, time_s);
  if (!answer.accepted()) return answer;
  double too_short_s = planned_s_;
  double used = most_used(limit);
  if (used <= 1.0) return answer;
  for (int round = 0; round < kMostLonger && used > 1.0; ++round) {
    if (!std::isfinite(used)) break;
    too_short_s = planned_s_;
    answer = plan(target, planned_s_ * used * (1.0 + 1e-6));
    if (!answer.accepted()) return answer;
    used = most_used(limit);
  }
  if (used > 1.0) return {TargetRefusal::kMotionLimit};
  double kept_s = planned_s_;
  for (int round = 0; round < kBisections; ++round) {
    const double middle_s = 0.5 * (too_short_s + kept_s);
    const bool keeps = plan(target, middle_s).accepted() && most_used(limit) <= 1.0;
    (keeps ? kept_s : too_short_s) = middle_s;
  }
  return plan(target, kept_s);
}

/// Along `next_`.
double OnlineTrajectory::most_used(MotionLimit& limit) {
  double most = 0.0;
  for (int k = 1; k < kOnlineLooks; ++k) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const MotionSample there = next_[i].at(planned_s_ * k / kOnlineLooks);
      looked_at_[i] = there.position;
      velocities_there_[i] = there.velocity;
    }
    most = std::max(most, limit.used(looked_at_, velocities_there_));
  }
  return most;
}

OnlineTrajectory::Answer OnlineTrajectory::jog(std::size_t axis, double velocity,
                                               MotionLimit* limit) {
  if (!std::isfinite(velocity)) return {TargetRefusal::kNotFinite, axis};
  if (velocity == 0.0) return {TargetRefusal::kZeroVelocity, axis};
  if (std::abs(velocity) > axes_[axis].max_velocity) {
    return {TargetRefusal::kTooFast, axis, 0.0, axes_[axis].max_velocity};
  }
  if (!position_known_) return {TargetRefusal::kNoPosition};
  for (std::size_t i = 0; i < axes_.size(); ++i) brake(i);
  const double limit_there = velocity > 0.0 ? axes_[axis].upper : axes_[axis].lower;
  if (!std::isfinite(limit_there)) return {TargetRefusal::kTooLong, axis};
  const double room = (limit_there - next_[axis].end().position) * std::copysign(1.0, velocity);
  if (room <= kPositionRounding) return {TargetRefusal::kAtLimit, axis};
  const MotionSample target{limit_there, 0.0, 0.0};
  JerkLimits limits = limits_of(axis);
  limits.velocity = std::abs(velocity);
  pose(axis, target, limits);
  const double own_s = within_s_[axis] + problems_[axis]->first_duration(0.0);
  if (!(own_s <= kLongest_s)) return {TargetRefusal::kTooLong, axis};
  if (!solve(axis, target, own_s, limits)) return {TargetRefusal::kLeavesLimits, axis};
  planned_s_ = 0.0;
  for (const PhasedMotion& each : next_) planned_s_ = std::max(planned_s_, each.duration_s());
  const double used = limit == nullptr ? 0.0 : most_used(*limit);
  if (used > 1.0) return {TargetRefusal::kTooFast, axis, 0.0, std::abs(velocity) / used};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    targets_[i] = {next_[i].end().position, 0.0, 0.0};
  }
  has_target_ = true;
  asked_s_ = -1.0;  // no motion is the same as this one
  begin(planned_s_);
  return {};
}

/// @return whether the axis stays within its position limits
bool OnlineTrajectory::solve(std::size_t axis, const MotionSample& target, double duration_s,
                             const JerkLimits& limits) {
  PhasedMotion& motion = next_[axis];
  const AxisProblem& problem = *problems_[axis];
  problem.append_to(motion, duration_s - within_s_[axis]);
  motion.end_in(target);
  if (stays_within(axis)) return true;
  if (!at_rest(target)) return false;
  motion.begin(now(axis));
  bring_within(limits, motion);
  problem.append_to(motion, problem.first_duration(0.0));
  motion.end_in(target);
  return stays_within(axis);
}

/// Where an axis is outside already, it goes no further. A stop at any moment counts, too.
bool OnlineTrajectory::stays_within(std::size_t axis) const {
  const double start = now(axis).position;
  const double lower = std::min(axes_[axis].lower, start) - kPositionRounding;
  const double upper = std::max(axes_[axis].upper, start) + kPositionRounding;
  const auto [lowest, highest] = extent_of_stops(limits_of(axis), next_[axis]);
  return lowest >= lower && highest <= upper;
}

void OnlineTrajectory::brake(std::size_t axis) {
  next_[axis] = stop_from(limits_of(axis), now(axis));
}

void OnlineTrajectory::stop() {
  if (has_target_) brake_all();
}

void OnlineTrajectory::brake_all() {
  double duration_s = 0.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    brake(i);
    duration_s = std::max(duration_s, next_[i].duration_s());
  }
  has_target_ = false;
  begin(duration_s);
}

void OnlineTrajectory::begin(double duration_s) {
  std::swap(motions_, next_);
  elapsed_ = {};
  duration_s_ = duration_s;
  position_known_ = true;
  sample_all();
}

void OnlineTrajectory::step(base::Duration period) {
  elapsed_ += period;
  if (!under_way() && has_target_ && !std::ranges::all_of(targets_, at_rest)) {
    const double beyond_s = elapsed_s() - duration_s_;
    elapsed_ = base::Duration(static_cast<base::Duration::rep>(std::ceil(duration_s_ * 1e9)));
    stop();
    elapsed_ = base::Duration(static_cast<base::Duration::rep>(beyond_s * 1e9));
  }
  sample_all();
}

void OnlineTrajectory::sample_all() {
  const double time_s = elapsed_s();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const MotionSample sample = motions_[i].at(time_s);
    positions_[i] = sample.position;
    velocities_[i] = sample.velocity;
    accelerations_[i] = sample.acceleration;
  }
}

}  // namespace armature::control
