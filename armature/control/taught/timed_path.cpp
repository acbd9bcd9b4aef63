// SPDX-License-Identifier: Apache-2.0
#include "armature/control/taught/timed_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace armature::control {
namespace {

/// Of an acceleration, that the path itself may need; the rest changes the speed along it.
constexpr double kShareOfPath = 0.8;
/// Kept of a limit of the whole robot, which is asked at places of the path only.
constexpr double kMarginOfRobot = 0.98;
/// Below it nothing moves in any time that counts.
constexpr double kSlowest = 1e-4;

double squared(double number) { return number * number; }

}  // namespace

TimedPath::TimedPath(std::vector<PathLimits> limits, std::size_t capacity)
    : limits_(std::move(limits)), capacity_(std::max<std::size_t>(capacity, 4)) {
  const std::size_t axes = limits_.size();
  const std::size_t places = (capacity_ - 3) * kPlacesPerKnot + 1;
  points_.assign(capacity_ * axes, 0.0);
  for (auto* const each : {&most_, &square_, &hardest_}) each->assign(places, 0.0);
  for (auto* const each :
       {&positions_, &velocities_, &accelerations_, &before_slope_, &before_curvature_}) {
    each->assign(axes, 0.0);
  }
}

void TimedPath::load(std::span<const double> points, double speed) {
  std::copy(points.begin(), points.end(), points_.begin());
  places_ = (points.size() / axes() - 3) * kPlacesPerKnot + 1;
  speed_ = speed;
  phase_ = Phase::kCurves;
  next_ = 0;
  slowed_ = false;
  possible_ = true;
  sum_s_ = 0.0;
  rests_ = true;
  duration_s_ = static_cast<double>(places_ - 1) * kStep_s / speed;
  remaining_s_ = duration_s_;
}

bool TimedPath::plan(MotionLimit* limit) {
  for (std::size_t cost = 0; cost < kPiece && !planned();) {
    cost += phase_ == Phase::kCurves ? kCostOfCurve : 1;
    switch (phase_) {
      case Phase::kCurves:
        measure(next_, limit);
        break;
      case Phase::kForth:
        square_[next_] =
            next_ == 0
                ? 0.0
                : std::min(most_[next_], square_[next_ - 1] + 2.0 * kStep_s * hardest_[next_ - 1]);
        break;
      case Phase::kBack:
        come_to_rest(places_ - 1 - next_);
        break;
      case Phase::kPlanned:
        break;
    }
    if (++next_ < places_) continue;
    next_ = 0;
    phase_ = static_cast<Phase>(static_cast<int>(phase_) + 1);
    if (planned()) remaining_s_ = duration_s_ = sum_s_;
  }
  return planned();
}

/// What the limits allow at a place, and from the one before it to there. The slope is quadratic
/// between two places, so that it exceeds those at both by at most an eighth of what the curvature
/// changes by; the curvature is linear.
void TimedPath::measure(std::size_t place, MotionLimit* limit) {
  const std::size_t knot = std::min(place / kPlacesPerKnot, (places_ - 1) / kPlacesPerKnot - 1);
  evaluate(knot, static_cast<double>(place - knot * kPlacesPerKnot) / kPlacesPerKnot);
  double most = squared(speed_);
  if (limit != nullptr) {
    const double used = limit->used(positions_, velocities_);
    if (used > 0.0) most = std::min(most, squared(kMarginOfRobot / used));
    if (!(most > squared(kSlowest))) possible_ = false;
  }
  most_[place] = std::max(most, squared(kSlowest));
  if (place > 0) measure_segment(place - 1);
  if (most_[place] < squared(0.999 * speed_)) slowed_ = true;
  before_slope_.swap(velocities_);
  before_curvature_.swap(accelerations_);
}

/// From `place` to the next one, at which the curves were evaluated.
void TimedPath::measure_segment(std::size_t place) {
  double most = squared(speed_);
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    const auto [slope, curvature] = steepest(axis);
    if (slope > 0.0) most = std::min(most, squared(limits_[axis].max_velocity / slope));
    if (curvature > 0.0) {
      most = std::min(most, kShareOfPath * limits_[axis].max_acceleration / curvature);
    }
  }
  double hardest = kHardest;
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    const auto [slope, curvature] = steepest(axis);
    const double left = limits_[axis].max_acceleration - curvature * most;
    if (slope * hardest > left) hardest = left / slope;
  }
  hardest_[place] = hardest;
  most_[place] = std::min(most_[place], most);
  most_[place + 1] = std::min(most_[place + 1], most);
}

std::pair<double, double> TimedPath::steepest(std::size_t axis) const {
  const double change = std::abs(accelerations_[axis] - before_curvature_[axis]);
  return {
      std::max(std::abs(velocities_[axis]), std::abs(before_slope_[axis])) + change * kStep_s / 8.0,
      std::max(std::abs(accelerations_[axis]), std::abs(before_curvature_[axis]))};
}

void TimedPath::come_to_rest(std::size_t place) {
  if (place + 1 == places_) {
    square_[place] = 0.0;
    return;
  }
  square_[place] = std::min(square_[place], square_[place + 1] + 2.0 * kStep_s * hardest_[place]);
  sum_s_ += 2.0 * kStep_s / (std::sqrt(square_[place]) + std::sqrt(square_[place + 1]));
}

void TimedPath::begin() {
  segment_ = 0;
  beyond_s_ = rate_ = change_ = 0.0;
  remaining_s_ = duration_s_;
  braking_ = rests_ = false;
  sample();
}

void TimedPath::step(double period_s) {
  remaining_s_ = std::max(0.0, remaining_s_ - period_s);
  for (double left_s = period_s; left_s > 0.0 && !rests_;) left_s = move_on(left_s);
  if (rests_) rate_ = change_ = 0.0;
  if (braking_ && !rests_) remaining_s_ = rate_ / hardest_[segment_];
  sample();
}

/// Within the present segment.
/// @return what is left of the time when the segment is
double TimedPath::move_on(double time_s) {
  const double begin = square_[segment_];
  const double end = square_[segment_ + 1];
  const double left_s = kStep_s - beyond_s_;
  change_ = braking_ ? -hardest_[segment_] : (end - begin) / (2.0 * kStep_s);
  const double end_square = squared(rate_) + 2.0 * change_ * left_s;
  const bool stops = braking_ && end_square <= 0.0;
  const double rate_there = stops ? 0.0 : braking_ ? std::sqrt(end_square) : std::sqrt(end);
  const double takes_s = stops ? rate_ / hardest_[segment_] : 2.0 * left_s / (rate_ + rate_there);
  if (time_s < takes_s) {
    beyond_s_ += rate_ * time_s + 0.5 * change_ * squared(time_s);
    rate_ += change_ * time_s;
    return 0.0;
  }
  rate_ = rate_there;
  if (stops) {
    beyond_s_ += 0.5 * squared(takes_s) * hardest_[segment_];
    rests_ = true;
  } else if (segment_ + 2 == places_) {
    beyond_s_ = kStep_s;
    rests_ = true;
  } else {
    ++segment_;
    beyond_s_ = 0.0;
  }
  return time_s - takes_s;
}

/// Positions, slopes and curvatures of all axes.
void TimedPath::evaluate(std::size_t knot, double share) {
  const SplineWeights weights = SplineWeights::at(share);
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    positions_[axis] = velocities_[axis] = accelerations_[axis] = 0.0;
    for (std::size_t k = 0; k < weights.position.size(); ++k) {
      const double point = points_[(knot + k) * axes() + axis];
      positions_[axis] += weights.position[k] * point;
      velocities_[axis] += weights.slope[k] * point;
      accelerations_[axis] += weights.curvature[k] * point;
    }
  }
}

void TimedPath::sample() {
  const std::size_t knot = segment_ / kPlacesPerKnot;
  const double within_s = static_cast<double>(segment_ % kPlacesPerKnot) * kStep_s + beyond_s_;
  evaluate(knot, within_s / kKnotSpacing_s);
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    const double slope = std::exchange(velocities_[axis], velocities_[axis] * rate_);
    accelerations_[axis] = slope * change_ + accelerations_[axis] * squared(rate_);
  }
}

}  // namespace armature::control
