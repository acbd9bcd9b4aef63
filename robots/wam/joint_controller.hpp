// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/control/positional_pid.hpp"
#include "robots/wam/arm_numbers.hpp"

namespace armature::wam {

/// The vendor's joint position controller: a control::PositionalPid for each joint, whose sum has
/// no limit of its own. What it computes is added to the compensation of gravity.
class JointController {
 public:
  struct Config {
    std::vector<JointGains> gains;  ///< one for each joint
    double period_s = kPeriod;
  };

  /// An error names the joint, and what is wrong with its gains.
  static base::Result<JointController> make(const Config& config);

  /// One sample. All vectors have one number for each joint.
  /// @param reference  [rad]
  /// @param measured   [rad]
  /// @param torques    [N m], each within its largest; not a number where an argument is none
  /// @rt nonblocking, no allocation, O(joints)
  /// @thread the owning activity only
  void step(std::span<const double> reference, std::span<const double> measured,
            std::span<double> torques);
  /// The same where the reference's velocities are known: they count instead of the differences
  /// of its positions, of which those of the measured ones are taken. The first step knows none.
  /// @param velocities  [rad/s] of the reference
  /// @rt nonblocking, no allocation, O(joints)
  /// @thread the owning activity only
  void step(std::span<const double> reference, std::span<const double> velocities,
            std::span<const double> measured, std::span<double> torques);

  /// Forgets the past, which the arm's own software does not: whoever takes it into service again,
  /// after a stop or on another reference, calls this, or past errors drive the arm.
  /// @rt nonblocking, no allocation, O(joints)
  void reset();
  /// The same, as if the arm had been there before: the next step does not kick.
  /// @rt nonblocking, no allocation, O(joints)
  void reset_to(std::span<const double> reference, std::span<const double> measured);

  std::size_t joints() const { return pids_.size(); }

 private:
  void keep(std::span<const double> measured);

  std::vector<control::PositionalPid> pids_;
  std::vector<double> last_measured_;  ///< [rad]
  bool measured_before_ = false;       ///< since it forgot
  double period_s_ = kPeriod;
};

}  // namespace armature::wam
