// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/furthest_reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace armature::control {
namespace {

/// Rounding moves the edges of ranges of durations by so much of them.
double rounding(double time_s) { return 1e-12 * std::abs(time_s); }

}  // namespace

/// Backward in time and mirrored, a motion has the same distance, the same duration and the same
/// jerks in the opposite order.
FurthestReach::FurthestReach(const JerkLimits& limits, const MotionEnds& ends) : limits_(limits) {
  const auto [v, a, j] = limits_;
  a0_ = ends.start_acceleration;
  af_ = ends.end_acceleration;
  w0_ = ends.start_velocity - a0_ * a0_ / (2.0 * j);
  wf_ = ends.end_velocity - af_ * af_ / (2.0 * j);
  reversed_ = wf_ < w0_;
  if (reversed_) {
    std::swap(w0_, wf_);
    a0_ = -std::exchange(af_, -a0_);
  }
  k_ = j * (wf_ - w0_);
  if (k_ <= rounded()) k_ = 0.0;
  cubes_ = (af_ * af_ * af_ - a0_ * a0_ * a0_) / (6.0 * j * j);
  held_s_ = (a - a0_ + af_) / j + (k_ - a * a) / (j * a);

  // The peak and the trough of a motion that just reaches the velocity limit.
  const double peak = root(j * (v - w0_));
  const double trough = -root(j * (v - wf_));
  double lowest_trough = af_;
  if (k_ < a * a) {
    const double held = root(a * a - k_);  // the trough, where the peak is A and is not held
    if (af_ > held) add({Kind::kPeakHeld, peak_held_s(af_), peak_held_s(held)});
    const double first = af_ > 0.0 ? k_ / (af_ + root(af_ * af_ + k_)) : root(af_ * af_ + k_) - af_;
    const double lowest = af_ > held ? k_ / (a + held) : first;
    if (k_ == 0.0 && a0_ <= af_) add_free(0.0, 0.0);  // a single phase
    list_free_spans(lowest, std::min(a + held, peak - trough));
    lowest_trough = std::min(-held, af_);
  }
  if (peak <= a) {
    cruising_ = {peak, 0.0, 0.0, trough, 0.0};
    add({Kind::kCruising, free_s(peak - trough), std::numeric_limits<double>::infinity()});
    return;
  }
  add({Kind::kPeakHeld, peak_held_s(lowest_trough), peak_held_s(std::max(-a, trough))});
  const double peak_s = (v - w0_ - a * a / j) / a;
  if (trough >= -a) {
    cruising_ = {a, peak_s, 0.0, trough, 0.0};
    add({Kind::kCruising, peak_held_s(trough), std::numeric_limits<double>::infinity()});
    return;
  }
  add({Kind::kBothHeld, both_held_s(wf_ + a * a / j), both_held_s(v)});
  cruising_ = {a, peak_s, 0.0, -a, (v - wf_ - a * a / j) / a};
  add({Kind::kCruising, both_held_s(v), std::numeric_limits<double>::infinity()});
}

/// Without those whose peak would be below the acceleration at the start.
void FurthestReach::list_free_spans(double lowest, double highest) {
  if (a0_ <= 0.0 || a0_ * a0_ <= k_) return add_free(lowest, highest);
  const double half = root(a0_ * a0_ - k_);
  const double gap_begin = k_ / (a0_ + half);
  const double gap_end = std::min(a0_ + half, highest);
  // A single phase of -J is a range without length.
  const bool below = k_ > 0.0 && lowest <= gap_begin + 1e-13 * limits_.acceleration;
  if (below) add_free(std::min(lowest, gap_begin), gap_begin);
  add_free(std::max(lowest, gap_end), highest);
}

/// What is 0 but for rounding. A root would make 1e-8 of a difference of 1e-16, and of that another
/// motion: for a state on the way of a motion, which is as exact as rounding is, a much longer one.
double FurthestReach::rounded() const { return 1e-14 * limits_.jerk * limits_.velocity; }

double FurthestReach::root(double difference) const {
  return difference > rounded() ? std::sqrt(difference) : 0.0;
}

void FurthestReach::add(const Span& span) {
  if (span.end_s >= span.begin_s) spans_[size_++] = span;
}

void FurthestReach::add_free(double first_step, double last_step) {
  add({Kind::kFree, free_s(first_step), free_s(last_step), first_step, last_step});
}

double FurthestReach::free_s(double step) const { return (2.0 * step + af_ - a0_) / limits_.jerk; }

/// Kept within its range beyond what rounding leaves of the duration, as K is divided by it.
double FurthestReach::step_in(const Span& span, double duration_s) const {
  const double step = 0.5 * (duration_s * limits_.jerk + a0_ - af_);
  return std::min(std::max(step, span.first_step), span.last_step);
}

double FurthestReach::peak_held_s(double trough) const {
  const double below = limits_.acceleration - trough;
  return held_s_ + below * below / (limits_.jerk * limits_.acceleration);
}

double FurthestReach::trough_at(double duration_s) const {
  const double square = limits_.jerk * limits_.acceleration * (duration_s - held_s_);
  return limits_.acceleration - std::sqrt(std::max(0.0, square));
}

double FurthestReach::both_held_s(double top_velocity) const {
  return (2.0 * limits_.acceleration - a0_ + af_) / limits_.jerk +
         (2.0 * top_velocity - w0_ - wf_) / limits_.acceleration;
}

double FurthestReach::top_velocity_at(double duration_s) const {
  const auto [v, a, j] = limits_;
  return 0.5 * (w0_ + wf_ + a * (duration_s - (2.0 * a - a0_ + af_) / j));
}

const FurthestReach::Span& FurthestReach::span_at(double duration_s) const {
  std::size_t i = size_ - 1;
  while (i > 0 && spans_[i].begin_s > duration_s) --i;
  // In a gap the nearest edge counts, which is that of the next span where rounding says so.
  const bool in_gap = i + 1 < size_ && duration_s > spans_[i].end_s;
  const bool next_is_nearer =
      in_gap && spans_[i + 1].begin_s - duration_s < duration_s - spans_[i].end_s;
  return spans_[next_is_nearer ? i + 1 : i];
}

FurthestReach::Shape FurthestReach::free_shape(double step) const {
  if (!(step > 0.0)) return {a0_, 0.0, 0.0, a0_, 0.0};
  const double sum = k_ / step;
  return {std::max(0.5 * (sum + step), a0_), 0.0, 0.0, std::min(0.5 * (sum - step), af_), 0.0};
}

FurthestReach::Shape FurthestReach::shape_in(const Span& span, double duration_s) const {
  const auto [v, a, j] = limits_;
  const double time_s = std::clamp(duration_s, span.begin_s, span.end_s);
  switch (span.kind) {
    case Kind::kFree:
      return free_shape(step_in(span, time_s));
    case Kind::kPeakHeld: {
      const double trough = std::min(trough_at(time_s), af_);
      const double peak_s = (k_ + trough * trough - a * a) / (j * a);
      return {a, std::max(0.0, peak_s), 0.0, trough, 0.0};
    }
    case Kind::kBothHeld: {
      const double top = top_velocity_at(time_s) - a * a / j;
      return {a, std::max(0.0, (top - w0_) / a), 0.0, -a, std::max(0.0, (top - wf_) / a)};
    }
    case Kind::kCruising:
      break;
  }
  Shape shape = cruising_;
  shape.cruise_s = time_s - span.begin_s;
  return shape;
}

double FurthestReach::distance_of(const Shape& shape) const {
  const auto [v, a, j] = limits_;
  const double top = w0_ + shape.peak * shape.peak / j + a * shape.peak_s;
  const double ramps =
      w0_ * (shape.peak - a0_) + top * (shape.peak - shape.trough) + wf_ * (af_ - shape.trough);
  const double at_peak = w0_ + shape.peak * shape.peak / (2.0 * j) + 0.5 * a * shape.peak_s;
  const double at_trough = top - shape.trough * shape.trough / (2.0 * j) - 0.5 * a * shape.trough_s;
  return ramps / j + cubes_ + shape.peak_s * at_peak + shape.trough_s * at_trough +
         shape.cruise_s * v;
}

double FurthestReach::slope_in(const Span& span, double duration_s) const {
  const auto [v, a, j] = limits_;
  switch (span.kind) {
    case Kind::kFree: {
      const double step = step_in(span, duration_s);
      const double sum = step > 0.0 ? k_ / step : 0.0;
      return (0.75 * step * step + 0.25 * sum * sum) / (2.0 * j) + 0.5 * (w0_ + wf_);
    }
    case Kind::kPeakHeld: {
      const double trough = trough_at(duration_s);
      return wf_ + trough * (trough - 0.5 * a) / j;
    }
    case Kind::kBothHeld:
      return top_velocity_at(duration_s) + a * a / (2.0 * j);
    case Kind::kCruising:
      break;
  }
  return v;
}

/// Where the distance turns between growing and shrinking, in order, and the end of the span.
FurthestReach::Turns FurthestReach::turns_in(const Span& span, double from_s) const {
  const auto [v, a, j] = limits_;
  Turns turns;
  const auto add_turn = [&](double time_s) {
    if (time_s > from_s && time_s < span.end_s) turns.times[turns.size++] = time_s;
  };
  if (span.kind == Kind::kFree && w0_ + wf_ < 0.0) {
    const double s = j * (w0_ + wf_);
    const double inside = 4.0 * s * s - 3.0 * k_ * k_;
    if (inside > 0.0) {
      const double larger = (-2.0 * s + std::sqrt(inside)) / 3.0;
      add_turn(free_s(k_ / std::sqrt(3.0 * larger)));
      add_turn(free_s(std::sqrt(larger)));
    }
  } else if (span.kind == Kind::kPeakHeld && a * a > 16.0 * j * wf_) {
    const double half = std::sqrt(a * a / 16.0 - j * wf_);
    if (0.25 * a + half < a) add_turn(peak_held_s(0.25 * a + half));
    add_turn(peak_held_s(0.25 * a - half));
  } else if (span.kind == Kind::kBothHeld) {
    add_turn(both_held_s(-a * a / (2.0 * j)));
  }
  turns.times[turns.size++] = span.end_s;
  return turns;
}

/// Newton's method within a bracket, which halves it where Newton does not.
double FurthestReach::root_in(const Span& span, double low_s, double high_s, double distance,
                              bool rising) const {
  double time_s = 0.5 * (low_s + high_s);
  for (int round = 0; round < 100; ++round) {
    const double error = distance_of(shape_in(span, time_s)) - distance;
    if (error == 0.0) return time_s;
    ((error > 0.0) == rising ? high_s : low_s) = time_s;
    const double slope = slope_in(span, time_s);
    double next_s = slope != 0.0 ? time_s - error / slope : low_s;
    if (!(next_s > low_s && next_s < high_s)) next_s = 0.5 * (low_s + high_s);
    if (std::abs(next_s - time_s) <= 2e-16 * time_s || next_s == low_s || next_s == high_s) break;
    time_s = next_s;
  }
  return time_s;
}

/// Infinite if there is none in this span.
double FurthestReach::first_in(const Span& span, double from_s, double distance,
                               double tolerance) const {
  double low_s = std::max(from_s, span.begin_s);
  const double at_begin = distance_of(shape_in(span, low_s));
  tolerance += 1e-13 * limits_.velocity * low_s;
  if (at_begin >= distance - tolerance) return low_s;
  if (span.kind == Kind::kCruising) return low_s + (distance - at_begin) / limits_.velocity;
  const Turns turns = turns_in(span, low_s);
  for (std::size_t i = 0; i < turns.size; ++i) {
    const double high_s = turns.times[i];
    const double at_high = distance_of(shape_in(span, high_s));
    if (at_high >= distance) return root_in(span, low_s, high_s, distance, true);
    if (at_high >= distance - tolerance) return high_s;
    low_s = high_s;
  }
  return std::numeric_limits<double>::infinity();
}

double FurthestReach::first_duration(double from_s, double distance, double tolerance) const {
  for (std::size_t i = 0; i < size_; ++i) {
    const Span& span = spans_[i];
    if (span.end_s < from_s - rounding(from_s)) continue;
    const double begin_s = std::min(std::max(from_s, span.begin_s), span.end_s);
    const double found_s = first_in(span, begin_s, distance, tolerance);
    if (found_s == std::numeric_limits<double>::infinity()) continue;
    // An edge that rounding moved is no reason for a longer motion.
    return found_s <= from_s + rounding(from_s) ? from_s : found_s;
  }
  return std::numeric_limits<double>::infinity();
}

void FurthestReach::append_to(PhasedMotion& motion, double duration_s, double sign) const {
  const double jerk = limits_.jerk;
  const Shape shape = shape_at(duration_s);
  struct Step {
    double duration_s;
    double jerk;
  };
  // Where it does not cruise the two ramps down are one.
  const bool cruises = shape.cruise_s > 0.0;
  const double down_s = (cruises ? shape.peak : shape.peak - shape.trough) / jerk;
  std::array<Step, 7> steps{{{(shape.peak - a0_) / jerk, jerk},
                             {shape.peak_s, 0.0},
                             {down_s, -jerk},
                             {shape.cruise_s, 0.0},
                             {cruises ? -shape.trough / jerk : 0.0, -jerk},
                             {shape.trough_s, 0.0},
                             {(af_ - shape.trough) / jerk, jerk}}};
  if (reversed_) std::ranges::reverse(steps);
  for (const Step& step : steps) motion.append(step.duration_s, sign * step.jerk);
}

}  // namespace armature::control
