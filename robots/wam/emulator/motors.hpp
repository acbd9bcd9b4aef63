// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "armature/base/time.hpp"

namespace armature::wam {

/// What the emulated pucks are screwed to: the motors of an arm with 4 joints or with 7, and
/// whatever they move. Motors are numbered from 0; angles are those of the motors' own shafts.
class Motors {
 public:
  Motors() = default;
  Motors(const Motors&) = delete;
  Motors& operator=(const Motors&) = delete;
  virtual ~Motors() = default;

  /// 4 or 7, always the same.
  virtual std::size_t count() const = 0;
  /// Everything moves up to `now`, which never goes back, or by whole steps of its own to the last
  /// before it. Called before each of the others, with the time that they happen at.
  virtual void advance_to(base::Time now) = 0;
  /// [rad], of any number of turns
  virtual double angle(std::size_t motor) const = 0;
  /// From now on the motor drives with this torque [Nm], and is not braked.
  virtual void drive(std::size_t motor, double torque) = 0;
  /// From now on its terminals are connected with each other: it drives nothing, and resists being
  /// turned. So it begins.
  virtual void brake(std::size_t motor) = 0;
};

}  // namespace armature::wam
