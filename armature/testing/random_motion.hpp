// SPDX-License-Identifier: Apache-2.0
#pragma once

// Random problems for tests and measurements, among them the special ones that a random number
// never is: at rest, at a limit, on the way of another motion, no distance.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "armature/control/online/axis_problem.hpp"
#include "armature/control/online/bring_within.hpp"

namespace armature::testing {

using control::JerkLimits;
using control::MotionSample;

/// Draws the limits and states of axes; the same seed draws the same.
class RandomMotion {
 public:
  explicit RandomMotion(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int one_of(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

  JerkLimits limits() {
    return {std::exp(between(-2.3, 2.3)), std::exp(between(-2.3, 3.4)),
            std::exp(between(-2.3, 5.7))};
  }

  /// A state from which, and to which, an axis can move within its limits.
  MotionSample state(const JerkLimits& limits) {
    MotionSample state;
    do {
      state = {between(-5.0, 5.0), between(-1.0, 1.0) * limits.velocity,
               between(-1.0, 1.0) * limits.acceleration};
      const int special = one_of(8);
      if (special == 0) state.velocity = state.acceleration = 0.0;
      if (special == 1) state.acceleration = 0.0;
      if (special == 2) state.velocity = 0.0;
      if (special == 3) state = {state.position, std::copysign(limits.velocity, state.velocity)};
    } while (!control::within(limits, state.velocity, state.acceleration, 1.0) ||
             !control::within(limits, state.velocity, state.acceleration, -1.0));
    return state;
  }

  /// Also such that no distance, or nothing at all, is left to do, or on the way of a motion to
  /// `target`.
  MotionSample start(const JerkLimits& limits, const MotionSample& target) {
    MotionSample start = state(limits);
    const int special = one_of(20);
    if (special < 2) start.position = target.position;
    if (special == 2) start = target;
    if (special == 3) start = {between(-5.0, 5.0), target.velocity, target.acceleration};
    if (special != 4) return start;
    const control::AxisProblem problem(limits, start, target);
    control::PhasedMotion motion;
    motion.begin(start);
    problem.append_to(motion, problem.first_duration(0.0));
    return motion.at(between(0.0, motion.duration_s()));
  }

  /// Beyond the limits, as a measured state may be, but not so far that it takes an hour to return.
  MotionSample beyond(const JerkLimits& limits) {
    const double usual = std::sqrt(limits.jerk * limits.velocity);
    return {between(-5.0, 5.0), between(-2.0, 2.0) * limits.velocity,
            between(-2.0, 2.0) * std::min(limits.acceleration, usual)};
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace armature::testing
