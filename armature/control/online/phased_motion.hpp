// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "armature/control/trapezoid.hpp"

namespace armature::control {

/// What an axis may do, in its unit (rad or m) and seconds; all finite and above 0.
struct JerkLimits {
  double velocity = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;
};

/// The motion of one axis as phases of constant jerk, exact at any time.
class PhasedMotion {
 public:
  /// Seven of the fastest motion, 13 of a blend of two, and those that bring an axis back within
  /// its limits first.
  static constexpr std::size_t kMost = 24;

  /// Begins anew, with no phase.
  void begin(const MotionSample& start) {
    size_ = 0;
    duration_s_ = 0.0;
    end_ = start;
  }

  /// Goes on from the end; a phase without length changes nothing.
  /// @param duration_s  at most `kMost` phases are above 0
  /// @rt nonblocking, no allocation
  void append(double duration_s, double jerk);

  /// After the last phase the axis is exactly there: what rounding left is less than `end` shows.
  void end_in(const MotionSample& end) { end_ = end; }

  /// @param time_s  since the begin; in `end()` from `duration_s()` on
  /// @rt nonblocking, no allocation, O(phases)
  MotionSample at(double time_s) const;

  double duration_s() const { return duration_s_; }
  const MotionSample& end() const { return end_; }
  std::size_t phases() const { return size_; }
  double start_of(std::size_t phase) const { return phases_[phase].start_s; }
  double jerk_of(std::size_t phase) const { return phases_[phase].jerk; }

  /// The largest and smallest position on the way.
  struct Extent {
    double lowest = 0.0;
    double highest = 0.0;
  };
  /// @rt nonblocking, no allocation, O(phases)
  Extent extent() const;

 private:
  struct Phase {
    double start_s = 0.0;
    double jerk = 0.0;
    MotionSample start;
  };
  std::array<Phase, kMost> phases_{};
  std::size_t size_ = 0;
  double duration_s_ = 0.0;
  MotionSample end_;
};

/// `start` after `time_s` with a constant jerk.
inline MotionSample after(const MotionSample& start, double time_s, double jerk) {
  const double a = start.acceleration;
  return {
      start.position + time_s * (start.velocity + time_s * (0.5 * a + time_s * jerk * (1.0 / 6.0))),
      start.velocity + time_s * (a + 0.5 * time_s * jerk), a + time_s * jerk};
}

}  // namespace armature::control
