// SPDX-License-Identifier: Apache-2.0
#include "armature/control/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "armature/control/internal/mistakes.hpp"

namespace armature::control {
namespace {

/// Of the shortest time: who says it with a few digits means it.
constexpr double kAsFast = 1.0 - 1e-6;
/// So often along a motion its other limits are looked at.
constexpr int kLooks = 64;

}  // namespace

std::string_view to_text(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "accepted";
    case Refusal::kWrongNumber:
      return "expected one number for each axis";
    case Refusal::kNotFinite:
      return "a number is not finite";
    case Refusal::kOutsideLimits:
      return "a target is outside the limits of its axis";
    case Refusal::kNegativeTime:
      return "the time is negative";
    case Refusal::kTooFast:
      return "the motion is faster than the limits allow";
    case Refusal::kTooLong:
      return "the motion would take more than 1e9 s";
    case Refusal::kUnderWay:
      return "a motion is under way";
    case Refusal::kNoPosition:
      return "the positions of the axes are not known yet: try again in the next cycle";
    case Refusal::kZeroVelocity:
      return "the velocity is 0";
    case Refusal::kAtLimit:
      return "the axis is at its limit";
  }
  return "unknown";
}

base::Result<void> Trajectory::check(const Config& config) {
  internal::Mistakes mistakes("Trajectory");
  mistakes.expect(!config.axes.empty(), "the number of axes", 0.0, "at least 1");
  for (std::size_t i = 0; i < config.axes.size(); ++i) {
    const Axis& axis = config.axes[i];
    const std::string name = "axes[" + std::to_string(i) + "].";
    mistakes.expect_positive(name + "max_velocity", axis.max_velocity);
    mistakes.expect_positive(name + "max_acceleration", axis.max_acceleration);
    mistakes.expect_ends(name, axis.lower, axis.upper);
  }
  return mistakes.result();
}

base::Result<Trajectory> Trajectory::make(const Config& config) {
  if (const auto checked = check(config); !checked) return base::Error{checked.error()};
  return Trajectory(config);
}

Trajectory::Trajectory(const Config& config)
    : axes_(config.axes),
      motions_(axes_.size()),
      next_(axes_.size()),
      next_positions_(axes_.size()),
      next_velocities_(axes_.size()),
      positions_(axes_.size()),
      velocities_(axes_.size()),
      accelerations_(axes_.size()) {}

Trajectory::Answer Trajectory::hold(std::span<const double> positions) {
  if (const Answer answer = check_finite(positions); !answer.accepted()) return answer;
  for (std::size_t i = 0; i < axes_.size(); ++i) motions_[i] = Trapezoid::resting(positions[i]);
  begin(0.0);
  return {};
}

Trajectory::Answer Trajectory::check_request(std::span<const double> positions,
                                             double time_s) const {
  if (const Answer answer = check_target(positions); !answer.accepted()) return answer;
  if (!std::isfinite(time_s)) return {Refusal::kNotFinite};
  if (time_s < 0.0) return {Refusal::kNegativeTime};
  return {};
}

Trajectory::Answer Trajectory::move_to(std::span<const double> positions, double time_s,
                                       MotionLimit* limit) {
  if (const Answer answer = check_request(positions, time_s); !answer.accepted()) return answer;
  if (!position_known_) return {Refusal::kNoPosition};
  if (under_way()) return {Refusal::kUnderWay};
  double shortest = 0.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    shortest = std::max(shortest, shortest_s(i, positions[i] - positions_[i]));
  }
  if (limit != nullptr && shortest > 0.0) {
    shape(positions, shortest);
    shortest *= std::max(1.0, most_used(*limit, shortest));
  }
  if (time_s > 0.0 && time_s < kAsFast * shortest) return {Refusal::kTooFast, kNoAxis, shortest};
  const double duration_s = std::max(time_s, shortest);
  if (!(duration_s <= kLongest_s)) return {Refusal::kTooLong};
  shape(positions, duration_s);
  std::swap(motions_, next_);
  begin(duration_s);
  return {};
}

Trajectory::Answer Trajectory::jog(std::size_t axis, double velocity, MotionLimit* limit) {
  if (!std::isfinite(velocity)) return {Refusal::kNotFinite, axis};
  if (velocity == 0.0) return {Refusal::kZeroVelocity, axis};
  const auto& limits = axes_[axis];
  if (std::abs(velocity) > limits.max_velocity) {
    return {Refusal::kTooFast, axis, 0.0, limits.max_velocity};
  }
  if (!position_known_) return {Refusal::kNoPosition};
  if (under_way()) return {Refusal::kUnderWay};
  const double room = room_to_limit(axis, positions_[axis], velocity);
  if (!(room > 0.0)) return {Refusal::kAtLimit, axis};
  // Over a short way it does not get as fast.
  const double speed = std::min(std::abs(velocity), std::sqrt(room * limits.max_acceleration));
  const double ramp_s = speed / limits.max_acceleration;
  const double duration_s = room / speed + ramp_s;
  if (!(duration_s <= kLongest_s)) return {Refusal::kTooLong, axis};
  for (std::size_t i = 0; i < axes_.size(); ++i) next_[i] = Trapezoid::resting(positions_[i]);
  const double target = velocity > 0.0 ? limits.upper : limits.lower;
  next_[axis] = Trapezoid::rest_to_rest(positions_[axis], target, duration_s, ramp_s / duration_s);
  const double used = limit == nullptr ? 0.0 : most_used(*limit, duration_s);
  if (used > 1.0) return {Refusal::kTooFast, axis, 0.0, speed / used};
  std::swap(motions_, next_);
  begin(duration_s);
  return {};
}

/// Lets `next_` begin where the axes rest.
void Trajectory::shape(std::span<const double> positions, double duration_s) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double share = ramp_share(i, positions[i] - positions_[i]);
    next_[i] = Trapezoid::rest_to_rest(positions_[i], positions[i], duration_s, share);
  }
}

double Trajectory::most_used(MotionLimit& limit, double duration_s) {
  double most = 0.0;
  for (int k = 1; k < kLooks; ++k) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const MotionSample there = next_[i].at(duration_s * k / kLooks);
      next_positions_[i] = there.position;
      next_velocities_[i] = there.velocity;
    }
    most = std::max(most, limit.used(next_positions_, next_velocities_));
  }
  return most;
}

void Trajectory::stop() {
  if (stopping_ || !under_way()) return;
  double together_s = 0.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    together_s = std::max(together_s, shortest_brake_s(i, velocities_[i]));
  }
  // No axis passes its target by this: what is left of the motion takes at least `together_s`, as
  // it brings all axes to rest, and no velocity in it falls below a straight line down to its end.
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    motions_[i] = Trapezoid::braking(positions_[i], velocities_[i], together_s);
  }
  begin(together_s);
  stopping_ = true;
}

Trajectory::Answer Trajectory::stop_from(std::span<const double> positions,
                                         std::span<const double> velocities) {
  if (const Answer answer = check_finite(positions); !answer.accepted()) return answer;
  if (const Answer answer = check_finite(velocities); !answer.accepted()) return answer;
  double together_s = 0.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    together_s = std::max(together_s, shortest_brake_s(i, velocities[i]));
  }
  if (together_s > kLongest_s) return {Refusal::kTooLong};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double room = room_to_limit(i, positions[i], velocities[i]);
    const double own_s = brake_s(i, velocities[i], room, together_s);
    motions_[i] = Trapezoid::braking(positions[i], velocities[i], own_s);
  }
  begin(together_s);
  stopping_ = true;
  return {};
}

void Trajectory::step(base::Duration period) {
  if (under_way()) elapsed_ += period;
  sample_all();
}

Trajectory::Answer Trajectory::check_finite(std::span<const double> numbers) const {
  if (numbers.size() != axes_.size()) return {Refusal::kWrongNumber};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!std::isfinite(numbers[i])) return {Refusal::kNotFinite, i};
  }
  return {};
}

Trajectory::Answer Trajectory::check_target(std::span<const double> positions) const {
  if (const Answer answer = check_finite(positions); !answer.accepted()) return answer;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const bool inside = positions[i] >= axes_[i].lower && positions[i] <= axes_[i].upper;
    if (!inside) return {Refusal::kOutsideLimits, i};
  }
  return {};
}

double Trajectory::shortest_s(std::size_t axis, double distance) const {
  const auto& limits = axes_[axis];
  const double length = std::abs(distance);
  const double ramp_s = limits.max_velocity / limits.max_acceleration;
  const bool cruises = length > limits.max_velocity * ramp_s;
  return cruises ? length / limits.max_velocity + ramp_s
                 : 2.0 * std::sqrt(length / limits.max_acceleration);
}

/// Of the shortest motion, and so of any that is that one scaled in time.
double Trajectory::ramp_share(std::size_t axis, double distance) const {
  const auto& limits = axes_[axis];
  const double ramp_s = limits.max_velocity / limits.max_acceleration;
  const bool cruises = std::abs(distance) > limits.max_velocity * ramp_s;
  return cruises ? ramp_s / shortest_s(axis, distance) : 0.5;
}

double Trajectory::shortest_brake_s(std::size_t axis, double velocity) const {
  return std::abs(velocity) / axes_[axis].max_acceleration;
}

/// Together with the others if there is room for it.
double Trajectory::brake_s(std::size_t axis, double velocity, double room,
                           double together_s) const {
  if (velocity == 0.0) return 0.0;
  const double filling_the_room_s = 2.0 * room / std::abs(velocity);
  return std::clamp(filling_the_room_s, shortest_brake_s(axis, velocity), together_s);
}

double Trajectory::room_to_limit(std::size_t axis, double position, double velocity) const {
  return velocity > 0.0 ? axes_[axis].upper - position : position - axes_[axis].lower;
}

void Trajectory::begin(double duration_s) {
  elapsed_ = {};
  duration_s_ = duration_s;
  position_known_ = true;
  stopping_ = false;
  sample_all();
}

void Trajectory::sample_all() {
  const double time_s = elapsed_s();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const MotionSample now = motions_[i].at(time_s);
    positions_[i] = now.position;
    velocities_[i] = now.velocity;
    accelerations_[i] = now.acceleration;
  }
}

}  // namespace armature::control
