// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/control/online/furthest_reach.hpp"
#include "armature/control/online/phased_motion.hpp"

namespace armature::control {

/// The motions of one axis from one state to another, within its limits: the fastest, and those of
/// longer durations as far as they are possible.
///
/// A duration is possible exactly if the distance lies between the shortest and the longest one
/// that it allows (`FurthestReach`); what lies between possible durations is blocked (Berscheid
/// and Kroeger 2021, section III-C). The fastest motion covers one of these two distances. A longer
/// one goes to a velocity between, keeps it, and goes on to the target's; where it has not the time
/// for that, it is a weighted mean of the longest and the shortest motion, which keeps all limits
/// as both do.
class AxisProblem {
 public:
  /// @param start, target  within the limits, and able to stay there (`within`)
  /// @rt nonblocking, no allocation
  AxisProblem(const JerkLimits& limits, const MotionSample& start, const MotionSample& target);

  /// The shortest possible duration, `from_s` at least.
  /// @rt nonblocking, no allocation
  double first_duration(double from_s) const;

  /// Appends the phases of a possible duration to `motion`.
  /// @rt nonblocking, no allocation
  void append_to(PhasedMotion& motion, double duration_s) const;

 private:
  double tolerance(double duration_s) const;
  bool append_with_plateau(PhasedMotion& motion, double duration_s) const;
  void append_blend(PhasedMotion& motion, double duration_s, double share) const;

  JerkLimits limits_;
  MotionSample start_;
  MotionEnds ends_;
  double distance_;
  double scale_;
  FurthestReach forward_;
  FurthestReach backward_;  ///< in a mirror
};

}  // namespace armature::control
