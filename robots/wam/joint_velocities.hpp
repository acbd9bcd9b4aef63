// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "armature/control/low_pass.hpp"
#include "robots/wam/arm_numbers.hpp"

namespace armature::wam {

/// The velocities of joints as the vendor's software has them: differences of positions by the time
/// that passed between them, behind a low pass.
class JointVelocities {
 public:
  static constexpr double kCorner = 180.0;  ///< [rad/s]

  explicit JointVelocities(std::size_t joints);

  /// One sample; velocities of the first are those before, which are 0 at the beginning.
  /// @param positions   [rad]
  /// @param elapsed_s   since the sample before, as measured, > 0
  /// @param velocities  [rad/s]
  /// @rt nonblocking, no allocation, O(joints)
  void step(std::span<const double> positions, double elapsed_s, std::span<double> velocities);

  /// The next positions are elsewhere, as after zeroing: their difference is no motion.
  /// @rt nonblocking, no allocation
  void jump() { begun_ = false; }

 private:
  std::vector<control::LowPass> filters_;
  std::vector<double> last_;
  bool begun_ = false;
};

}  // namespace armature::wam
