// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/bring_within.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armature::control {
namespace {

constexpr double kForgiven = 1e-12;

/// When the velocity has fallen by `excess`, >= 0, with the acceleration `a` and the jerk -`jerk`.
double fallen_s(double excess, double acceleration, double jerk) {
  return (acceleration + std::sqrt(acceleration * acceleration + 2.0 * jerk * excess)) / jerk;
}

bool too_fast_upward(const JerkLimits& limits, double velocity, double acceleration) {
  const double rise = std::max(0.0, acceleration);
  return velocity + rise * rise / (2.0 * limits.jerk) > limits.velocity * (1.0 + kForgiven);
}

/// Of an axis that is or will be too fast upward; `sign` -1: downward, seen in a mirror.
void slow_down(const JerkLimits& limits, PhasedMotion& motion, double sign) {
  const auto [v, a, j] = limits;
  const double lowest = -std::min(a, std::sqrt(4.0 * j * v));
  const double excess = sign * motion.end().velocity - v;
  const double acceleration = sign * motion.end().acceleration;
  if (acceleration < lowest) return motion.append((lowest - acceleration) / j, sign * j);
  const double inside = acceleration * acceleration + 2.0 * j * excess;
  const double to_limit_s =
      inside >= 0.0 ? fallen_s(excess, acceleration, j) : std::numeric_limits<double>::infinity();
  const double to_lowest_s = (acceleration - lowest) / j;
  motion.append(std::min(to_limit_s, to_lowest_s), -sign * j);
  if (to_limit_s <= to_lowest_s) return;
  motion.append((v - sign * motion.end().velocity) / lowest, 0.0);
}

}  // namespace

bool within(const JerkLimits& limits, double velocity, double acceleration, double sign) {
  return std::abs(acceleration) <= limits.acceleration * (1.0 + kForgiven) &&
         !too_fast_upward(limits, velocity, sign * acceleration) &&
         !too_fast_upward(limits, -velocity, -sign * acceleration);
}

void bring_within(const JerkLimits& limits, PhasedMotion& motion) {
  const double excess = std::abs(motion.end().acceleration) - limits.acceleration;
  if (excess > limits.acceleration * kForgiven) {
    motion.append(excess / limits.jerk, -std::copysign(limits.jerk, motion.end().acceleration));
  }
  constexpr int kMostTurns = 4;  // one way, and back from what could not be avoided
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const auto [position, velocity, acceleration] = motion.end();
    if (too_fast_upward(limits, velocity, acceleration)) {
      slow_down(limits, motion, 1.0);
    } else if (too_fast_upward(limits, -velocity, -acceleration)) {
      slow_down(limits, motion, -1.0);
    } else {
      return;
    }
  }
}

}  // namespace armature::control
