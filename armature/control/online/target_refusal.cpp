// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/target_refusal.hpp"

namespace armature::control {

std::string_view to_text(TargetRefusal refusal) {
  switch (refusal) {
    case TargetRefusal::kNone:
      return "accepted";
    case TargetRefusal::kWrongNumber:
      return "expected one number for each axis";
    case TargetRefusal::kNotFinite:
      return "a number is not finite";
    case TargetRefusal::kOutsideLimits:
      return "a target is outside the limits of its axis";
    case TargetRefusal::kVelocityTooHigh:
      return "a velocity is above the limit of its axis";
    case TargetRefusal::kAccelerationTooHigh:
      return "an acceleration is above what the limits of its axis allow at this velocity";
    case TargetRefusal::kLeavesLimits:
      return "the motion would leave the limits of its axis on the way";
    case TargetRefusal::kNegativeTime:
      return "the time is negative";
    case TargetRefusal::kTooFast:
      return "the motion is faster than the limits allow";
    case TargetRefusal::kTooLong:
      return "the motion would take more than 1e9 s";
    case TargetRefusal::kNoPosition:
      return "the positions of the axes are not known yet: try again in the next cycle";
    case TargetRefusal::kZeroVelocity:
      return "the velocity is 0";
    case TargetRefusal::kAtLimit:
      return "the axis is at its limit";
    case TargetRefusal::kMotionLimit:
      return "the axes are too fast for a motion that the robot allows: stop first";
  }
  return "unknown";
}

}  // namespace armature::control
