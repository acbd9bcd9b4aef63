// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace armature::control {

/// Where an axis is to be at one moment; units of the axis, rad or m.
struct MotionSample {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};

/// The motion of one axis with a trapezoidal velocity: up to `velocity` within `ramp_up_s`, on with
/// it, and down to rest within `ramp_down_s`. Exact at any time, so nothing adds up over a motion.
struct Trapezoid {
  double start = 0.0;
  double end = 0.0;
  double velocity = 0.0;  ///< between the ramps; its sign is the direction
  double ramp_up_s = 0.0;
  double ramp_down_s = 0.0;
  double duration_s = 0.0;

  static Trapezoid resting(double position) { return {.start = position, .end = position}; }

  /// From rest to rest.
  /// @param duration_s  >= 0; 0 only if `start` is `end`
  /// @param ramp_share  of the duration for each of the two ramps, 0 to 0.5
  static Trapezoid rest_to_rest(double start, double end, double duration_s, double ramp_share) {
    if (start == end) return {.start = start, .end = end, .duration_s = duration_s};
    const double ramp_s = ramp_share * duration_s;
    const double velocity = (end - start) / (duration_s - ramp_s);
    return {start, end, velocity, ramp_s, ramp_s, duration_s};
  }

  /// From `velocity` to rest, evenly.
  /// @param duration_s  >= 0; 0 only if `velocity` is 0
  static Trapezoid braking(double start, double velocity, double duration_s) {
    const double end = start + 0.5 * velocity * duration_s;
    return {start, end, velocity, 0.0, duration_s, duration_s};
  }

  /// @param time_s  since the start; at rest in `end` from `duration_s` on
  /// @rt nonblocking, no allocation
  MotionSample at(double time_s) const {
    const double passed = std::max(time_s, 0.0);
    const double left = duration_s - passed;
    if (left <= 0.0) return {end, 0.0, 0.0};
    if (passed < ramp_up_s) {
      const double acceleration = velocity / ramp_up_s;
      return {start + 0.5 * acceleration * passed * passed, acceleration * passed, acceleration};
    }
    if (left > ramp_down_s) return {start + velocity * (passed - 0.5 * ramp_up_s), velocity, 0.0};
    if (velocity == 0.0) return {end, 0.0, 0.0};
    const double deceleration = velocity / ramp_down_s;
    return {end - 0.5 * deceleration * left * left, deceleration * left, -deceleration};
  }
};

}  // namespace armature::control
