// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace armature::control {

/// Why an `OnlineTrajectory` did not take a target.
enum class TargetRefusal {
  kNone,                 ///< it did
  kWrongNumber,          ///< not one number for each axis
  kNotFinite,            ///< a position, velocity, acceleration or time is not a finite number
  kOutsideLimits,        ///< a position is outside the position limits of its axis
  kVelocityTooHigh,      ///< a velocity is above the limit of its axis
  kAccelerationTooHigh,  ///< an acceleration is, or leads the velocity beyond its limit
  kLeavesLimits,         ///< the motion, or a stop on its way, leaves the position limits
  kNegativeTime,
  kTooFast,       ///< the limits allow it in a longer time, or a slower jog: the answer has which
  kTooLong,       ///< it would take more than `OnlineTrajectory::kLongest_s`
  kNoPosition,    ///< where the axes are was never said: hold() or begin_at() comes first
  kZeroVelocity,  ///< a jog has no direction
  kAtLimit,       ///< a jog goes towards the limit at which its axis comes to rest
  kMotionLimit,   ///< from this motion no motion to the target was found that keeps a `MotionLimit`
};

/// A few words for a message, such as "a velocity is above the limit of its axis".
/// @rt nonblocking, no allocation
std::string_view to_text(TargetRefusal refusal);

}  // namespace armature::control
