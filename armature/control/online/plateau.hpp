// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "armature/control/online/furthest_reach.hpp"
#include "armature/control/online/phased_motion.hpp"

namespace armature::control {

/// The fastest change from a velocity and an acceleration to another velocity without acceleration:
/// up to a peak of the acceleration, held if it is the limit, and down to 0.
struct VelocityRamp {
  double jerk = 0.0;  ///< with its sign
  double up_s = 0.0;
  double hold_s = 0.0;
  double down_s = 0.0;
  double lag = 0.0;  ///< by what the position stays behind one with the new velocity throughout
  double lag_slope = 0.0;  ///< of `lag`, by the new velocity

  static VelocityRamp make(const JerkLimits& limits, double velocity, double acceleration,
                           double next);
  double duration_s() const { return up_s + hold_s + down_s; }

  void append_to(PhasedMotion& motion) const;
  /// In time and in a mirror, which is a change to a velocity and an acceleration.
  void append_backward_to(PhasedMotion& motion) const;
};

/// A motion that ramps to a velocity, keeps it, and ramps to the target's.
struct Plateau {
  VelocityRamp first;
  double keep_s = 0.0;
  VelocityRamp last;
};

/// The one that covers `distance` in `duration_s`, if there is one.
///
/// The distance is u T - lag_1(u) - lag_2(u) and grows with the plateau's velocity u. Where both
/// ramps lead up it is concave in u, where both lead down convex: there Newton's method approaches
/// the root from one side. Between, a bracket keeps it.
/// @rt nonblocking, no allocation
std::optional<Plateau> find_plateau(const JerkLimits& limits, const MotionEnds& ends,
                                    double distance, double duration_s);

}  // namespace armature::control
