// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/control/online/phased_motion.hpp"

namespace armature::control {

/// The fastest motion to rest from a state, also beyond the limits.
/// @rt nonblocking, no allocation
PhasedMotion stop_from(const JerkLimits& limits, const MotionSample& state);

/// The positions that an axis may come to which stops at any moment of `motion`, exactly.
///
/// Where g = v + a |a| / 2J > 0, a stop begins with the jerk -J (or holds -A), and its end S grows
/// with a. It stays where it is along the stop itself, so dS/dt = (j + J) dS/da >= 0 along a motion
/// with any jerk j within the limits; where g < 0, S falls. So the highest stop is that of the
/// begin, of the end, or of a moment at which g passes 0 downward; the lowest likewise. A stop that
/// begins with v against g first goes on in the direction of v: by the same argument, no further
/// than one that begins where g passed 0. g is a quadratic function of time in each phase, before
/// and after the acceleration passes 0.
/// @param motion  within the limits, at least from where it is within them for the first time
/// @rt nonblocking, no allocation, O(phases)
PhasedMotion::Extent extent_of_stops(const JerkLimits& limits, const PhasedMotion& motion);

}  // namespace armature::control
