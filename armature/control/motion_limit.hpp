// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace armature::control {

/// What limits a motion besides the limits of each axis, such as the speed of a robot's tip. It
/// grows with the velocities as they do: at half the velocities half of it is used.
class MotionLimit {
 public:
  /// @return the share that is used of what is allowed, above 1 if it is too fast
  /// @rt nonblocking, no allocation
  virtual double used(std::span<const double> positions, std::span<const double> velocities) = 0;

 protected:
  ~MotionLimit() = default;
};

}  // namespace armature::control
