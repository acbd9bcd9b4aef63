// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/axis_problem.hpp"

#include <algorithm>
#include <cmath>

#include "armature/control/online/plateau.hpp"

namespace armature::control {

AxisProblem::AxisProblem(const JerkLimits& limits, const MotionSample& start,
                         const MotionSample& target)
    : limits_(limits),
      start_(start),
      ends_{start.velocity, start.acceleration, target.velocity, target.acceleration},
      distance_(target.position - start.position),
      scale_(std::abs(target.position) + std::abs(start.position)),
      forward_(limits, ends_),
      backward_(limits, ends_.mirrored()) {}

/// Of distances that rounding makes different.
double AxisProblem::tolerance(double duration_s) const {
  return 1e-15 * scale_ + 1e-13 * limits_.velocity * duration_s;
}

/// Each of the two bounds moves the duration on, until it suits both.
double AxisProblem::first_duration(double from_s) const {
  constexpr int kMostBlocked = 16;  // four at most are known
  double duration_s = from_s;
  for (int round = 0; round < kMostBlocked; ++round) {
    const double ahead_s = forward_.first_duration(duration_s, distance_, tolerance(duration_s));
    const double next_s = backward_.first_duration(ahead_s, -distance_, tolerance(ahead_s));
    if (next_s == duration_s) return duration_s;
    duration_s = next_s;
  }
  return duration_s;
}

void AxisProblem::append_to(PhasedMotion& motion, double duration_s) const {
  const double longest = forward_.distance(duration_s);
  const double shortest = -backward_.distance(duration_s);
  const double near = 4.0 * tolerance(duration_s);
  if (std::abs(longest - distance_) <= near) return forward_.append_to(motion, duration_s, 1.0);
  if (std::abs(shortest - distance_) <= near) return backward_.append_to(motion, duration_s, -1.0);
  if (append_with_plateau(motion, duration_s)) return;
  const double share = (distance_ - shortest) / (longest - shortest);
  append_blend(motion, duration_s, std::clamp(share, 0.0, 1.0));
}

bool AxisProblem::append_with_plateau(PhasedMotion& motion, double duration_s) const {
  const auto plateau = find_plateau(limits_, ends_, distance_, duration_s);
  if (!plateau) return false;
  plateau->first.append_to(motion);
  motion.append(plateau->keep_s, 0.0);
  plateau->last.append_backward_to(motion);
  return true;
}

void AxisProblem::append_blend(PhasedMotion& motion, double duration_s, double share) const {
  PhasedMotion longest;
  PhasedMotion shortest;
  longest.begin(start_);
  shortest.begin(start_);
  forward_.append_to(longest, duration_s, 1.0);
  backward_.append_to(shortest, duration_s, -1.0);
  std::size_t i = 0;
  std::size_t k = 0;
  double now_s = 0.0;
  const auto end_of = [](const PhasedMotion& one, std::size_t phase) {
    return phase + 1 < one.phases() ? one.start_of(phase + 1) : one.duration_s();
  };
  while (i < longest.phases() && k < shortest.phases()) {
    const double one_s = end_of(longest, i);
    const double other_s = end_of(shortest, k);
    const double next_s = std::min(one_s, other_s);
    motion.append(next_s - now_s, share * longest.jerk_of(i) + (1.0 - share) * shortest.jerk_of(k));
    now_s = next_s;
    if (one_s <= next_s) ++i;
    if (other_s <= next_s) ++k;
  }
}

}  // namespace armature::control
