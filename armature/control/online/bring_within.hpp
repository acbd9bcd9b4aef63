// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/control/online/phased_motion.hpp"

namespace armature::control {

/// Whether an axis with this velocity and acceleration is within its limits, and can stay there
/// before (`sign` -1) or after it (+1): taking the acceleration to 0 changes the velocity by
/// a^2 / 2J. Rounding is forgiven.
/// @rt nonblocking, no allocation
bool within(const JerkLimits& limits, double velocity, double acceleration, double sign);

/// Appends what brings an axis within its limits as fast as its jerk allows, and nothing if it is:
/// first the acceleration, then the velocity, with an acceleration that does not lead beyond the
/// opposite limit. Goes on from `motion.end()`.
/// @rt nonblocking, no allocation
void bring_within(const JerkLimits& limits, PhasedMotion& motion);

}  // namespace armature::control
