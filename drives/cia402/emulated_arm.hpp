// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "armature/base/time.hpp"
#include "drives/cia402/axis.hpp"

namespace armature::cia402 {

/// The bodies that emulated drives move together, in place of an axis each: joints of an arm, by
/// the order of their drives.
class EmulatedArm {
 public:
  virtual ~EmulatedArm() = default;

  virtual std::size_t joints() const = 0;
  /// What the drive of a joint is set up for: inertia, most torque, ends.
  virtual Axis::Config axis(std::size_t joint) const = 0;
  virtual double position(std::size_t joint) const = 0;  ///< [rad], 0 where it began
  virtual double velocity(std::size_t joint) const = 0;  ///< [rad/s]

  /// With its brake open, until the next word [N m].
  virtual void push(std::size_t joint, double torque) = 0;
  /// By its brake, until it is pushed.
  virtual void hold(std::size_t joint) = 0;
  virtual void step(base::Duration by) = 0;
};

}  // namespace armature::cia402
