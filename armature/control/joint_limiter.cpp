// SPDX-License-Identifier: Apache-2.0
#include "armature/control/joint_limiter.hpp"

#include <algorithm>
#include <cmath>

#include "armature/base/seconds.hpp"
#include "armature/control/internal/mistakes.hpp"

namespace armature::control {
namespace {

using Status = JointLimiter::Status;

/// Of a step of velocity: a command at a limit must not count as beyond it by a rounding error.
constexpr double kTolerance = 1e-6;
/// Far beyond any velocity; keeps the difference of two infinite ones a number.
constexpr double kHuge = 1e100;
/// Below this, whole numbers and their squares are exact enough to count steps by.
constexpr double kExact = 1e12;

bool finite(const JointLimiter::Measured& measured) {
  return std::isfinite(measured.position) && std::isfinite(measured.velocity);
}

}  // namespace

base::Result<void> JointLimiter::check(const Config& config) {
  internal::Mistakes mistakes("JointLimiter");
  mistakes.expect_ends("", config.lower, config.upper);
  mistakes.expect_positive("max_velocity", config.max_velocity);
  mistakes.expect_positive("max_acceleration", config.max_acceleration);
  mistakes.expect_positive("max_effort", config.max_effort);
  mistakes.expect_positive("period [s]", base::to_seconds(config.period));
  mistakes.expect_not_negative("arming_time [s]", base::to_seconds(config.arming_time));
  if (config.arming_time > base::Duration{}) {
    mistakes.expect_positive("effort_rate", config.effort_rate);
  }
  return mistakes.result();
}

base::Result<JointLimiter> JointLimiter::make(const Config& config) {
  if (const auto checked = check(config); !checked) return base::Error{checked.error()};
  return JointLimiter(config);
}

JointLimiter::JointLimiter(const Config& config)
    : config_(config),
      period_s_(base::to_seconds(config.period)),
      velocity_step_(config.max_acceleration * period_s_) {}

bool JointLimiter::arm(const Measured& measured, double effort) {
  if (!finite(measured) || !std::isfinite(effort)) return false;
  armed_ = true;
  rate_limited_ = config_.arming_time > base::Duration{};
  armed_for_ = {};
  position_ = last_command_ = measured.position;
  velocity_ = 0.0;
  effort_ = std::clamp(effort, -config_.max_effort, config_.max_effort);
  return true;
}

JointLimiter::Step<LimitedPosition> JointLimiter::step_position(const Measured& measured,
                                                                double command) {
  const Step<double> step = position_within(measured, command);
  return {LimitedPosition(step.value), step.status};
}

JointLimiter::Step<LimitedVelocity> JointLimiter::step_velocity(const Measured& measured,
                                                                double command) {
  const Step<double> step = velocity_within(measured, command);
  return {LimitedVelocity(step.value), step.status};
}

JointLimiter::Step<double> JointLimiter::position_within(const Measured& measured, double command) {
  if (!armed_) {
    if (std::isfinite(measured.position)) position_ = measured.position;
    return {position_, Status::kDisarmed};
  }
  // A joint that is outside may stay there.
  const Range limits{std::min(config_.lower, position_), std::max(config_.upper, position_)};
  if (!finite(measured) || !std::isfinite(command)) {
    const Step<double> braked = brake();
    move_to(std::clamp(position_ + braked.value * period_s_, limits.low, limits.high));
    last_command_ = position_;
    return {position_, braked.status};
  }
  const Range room{position_ - limits.low, limits.high - position_};
  const double target = std::clamp(command, limits.low, limits.high);
  const double velocity = within_motion(room, velocity_towards(target));
  const double rounding = kTolerance * velocity_step_ * period_s_;
  double next = std::clamp(position_ + velocity * period_s_, limits.low, limits.high);
  if (std::abs(next - target) <= rounding) next = target;
  const bool passed = std::abs(next - command) <= rounding;
  if (!passed) count_reasons(room, (command - position_) / period_s_);
  move_to(next);
  last_command_ = target;
  return {position_, passed ? Status::kPassed : Status::kClipped};
}

JointLimiter::Step<double> JointLimiter::velocity_within(const Measured& measured, double command) {
  if (!armed_) return {0.0, Status::kDisarmed};
  if (!finite(measured) || !std::isfinite(command)) return brake();
  position_ = last_command_ = measured.position;
  const Range room{position_ - config_.lower, config_.upper - position_};
  const double velocity = within_motion(room, command);
  const bool passed = std::abs(velocity - command) <= kTolerance * velocity_step_;
  if (!passed) count_reasons(room, command);
  velocity_ = velocity;
  return {velocity_, passed ? Status::kPassed : Status::kClipped};
}

JointLimiter::LimitedStep JointLimiter::step_effort(const Measured& measured, double command) {
  if (!armed_) return {LimitedEffort(), Status::kDisarmed};
  if (!finite(measured) || !std::isfinite(command)) {
    ++counts_.not_finite;
    effort_ = 0.0;
    return {LimitedEffort(), Status::kNotFinite};
  }
  const double affordable = std::clamp(command, -config_.max_effort, config_.max_effort);
  if (affordable != command) ++counts_.effort;
  effort_ = effort_within_motion(measured, effort_within_rate(affordable));
  return {LimitedEffort(effort_), effort_ == command ? Status::kPassed : Status::kClipped};
}

/// Follows a command that moves, and closes the gap that earlier clipping left: in the frame of the
/// command this is a motion to a place at rest.
double JointLimiter::velocity_towards(double target) const {
  const double command_velocity = (target - last_command_) / period_s_;
  const double gap = last_command_ - position_;
  const double closing = std::copysign(fastest_within(std::abs(gap)), gap);
  return std::clamp(command_velocity, -kHuge, kHuge) + std::clamp(closing, -kHuge, kHuge);
}

/// The largest velocity during the next period after which steps of `velocity_step_` bring the
/// joint to rest within `room`. In units of one step s and its way s T: from n + f (0 <= f < 1) the
/// ways (n + f) + (n - 1 + f) + ... + f are n (n + 1) / 2 + (n + 1) f, solved here for n and f.
double JointLimiter::fastest_within(double room) const {
  const double ways = std::max(room, 0.0) / (velocity_step_ * period_s_);
  if (!(ways < kExact)) return velocity_step_ * (std::sqrt(2.0 * ways) - 1.0);  // n is enough
  const double n = std::floor(0.5 * (std::sqrt(1.0 + 8.0 * ways) - 1.0));
  const double f = (ways - 0.5 * n * (n + 1.0)) / (n + 1.0);
  return velocity_step_ * (n + f);
}

/// Acceleration has the last word: who is too fast already brakes as hard as is allowed.
double JointLimiter::within_motion(const Range& room, double velocity) const {
  const double lowest = -std::min(config_.max_velocity, fastest_within(room.low));
  const double highest = std::min(config_.max_velocity, fastest_within(room.high));
  return within_acceleration(std::clamp(velocity, lowest, highest));
}

double JointLimiter::within_acceleration(double velocity) const {
  return std::clamp(velocity, velocity_ - velocity_step_, velocity_ + velocity_step_);
}

/// @param velocity  that would have been needed to do what was commanded
void JointLimiter::count_reasons(const Range& room, double velocity) {
  const double rounding = kTolerance * velocity_step_;
  const bool position = velocity > fastest_within(room.high) + rounding ||
                        velocity < -fastest_within(room.low) - rounding;
  const bool too_fast = std::abs(velocity) > config_.max_velocity + rounding;
  const bool too_sudden = std::abs(velocity - velocity_) > velocity_step_ + rounding;
  // Whoever is still catching up does so by what acceleration allows.
  const bool catching_up = !position && !too_fast;
  counts_.position += position ? 1 : 0;
  counts_.velocity += too_fast ? 1 : 0;
  counts_.acceleration += too_sudden || catching_up ? 1 : 0;
}

JointLimiter::Step<double> JointLimiter::brake() {
  ++counts_.not_finite;
  velocity_ = within_acceleration(0.0);
  return {velocity_, Status::kNotFinite};
}

void JointLimiter::move_to(double position) {
  velocity_ = (position - position_) / period_s_;
  position_ = position;
}

/// To take effort away is never too sudden.
double JointLimiter::effort_within_rate(double effort) {
  if (!rate_limited_) return effort;
  armed_for_ += config_.period;
  const double growth = config_.effort_rate * period_s_;
  const double limited =
      std::clamp(effort, std::min(effort_, 0.0) - growth, std::max(effort_, 0.0) + growth);
  if (limited != effort) {
    ++counts_.effort_rate;
  } else if (armed_for_ >= config_.arming_time) {
    rate_limited_ = false;
  }
  return limited;
}

double JointLimiter::effort_within_motion(const Measured& measured, double effort) {
  if (effort == 0.0) return effort;
  // Seen in the direction of the effort, so that there is one case.
  const double direction = std::copysign(1.0, effort);
  const double velocity = direction * measured.velocity;
  const double room =
      effort > 0.0 ? config_.upper - measured.position : measured.position - config_.lower;
  const double onward = std::max(velocity, 0.0);
  const bool too_far = onward * onward > 2.0 * config_.max_acceleration * room;
  const bool too_fast = velocity > config_.max_velocity;
  if (!too_far && !too_fast) return effort;
  counts_.position += too_far ? 1 : 0;
  counts_.velocity += too_fast ? 1 : 0;
  return 0.0;
}

}  // namespace armature::control
