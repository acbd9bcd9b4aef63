// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/control/dynamics/inverse_dynamics.hpp"

namespace armature::control {

/// Compensation of gravity and a PD controller for each joint (paper 3, conclusion), which holds
/// any position without an integral part:
///
///     torque = G(q) + kp (q_r - q) + kd (qd_r - qd)
class GravityPd {
 public:
  /// One number for each joint, >= 0.
  struct Config {
    std::vector<double> kp;  ///< [N m/rad]
    std::vector<double> kd;  ///< [N m s/rad]
  };

  /// An error says how many numbers were expected, or which gain is wrong.
  static base::Result<GravityPd> make(InverseDynamics links, const Config& config);

  /// @param reference  [q1..qN, qd1..qdN, qdd1..qddN] [rad], [rad/s], [rad/s^2]
  /// @param measured   [q1..qN, qd1..qdN]
  /// @param torques    one for each joint [N m]; not finite if one of the others is not
  /// @return false, and nothing is computed, if one of them has another size
  /// @rt nonblocking, no allocation, O(joints)
  /// @thread the owning activity only
  bool step(std::span<const double> reference, std::span<const double> measured,
            std::span<double> torques);

  std::size_t joints() const { return links_.joints(); }

 private:
  GravityPd(InverseDynamics links, const Config& config);

  InverseDynamics links_;
  Config config_;
};

}  // namespace armature::control
