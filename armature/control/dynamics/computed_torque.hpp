// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/control/transmission.hpp"

namespace armature::control {

/// Computed torque (paper 3, conclusion; the textbooks' inverse dynamics control): the torque that
/// gives the robot the acceleration that takes each joint to its reference like a spring and a
/// damper, by the model of links and rotors where the robot is and as it moves now:
///
///     a = qdd_r + kd (qd_r - qd) + kp (q_r - q)
///     torque = (D(q) + R) a + H(q, qd) + G(q) + F qd_r
///
/// with the inertia R and the friction F of the motors. That takes the velocity as desired: what is
/// measured of it would push the robot on where F is too large.
class ComputedTorque {
 public:
  /// One number for each joint, >= 0.
  struct Config {
    std::vector<double> kp;  ///< [1/s^2]; the square of each joint's frequency [rad/s]
    std::vector<double> kd;  ///< [1/s]; twice that frequency: as fast as without overshoot
  };

  /// An error says how many numbers were expected, or which gain is wrong.
  static base::Result<ComputedTorque> make(InverseDynamics links, Transmission rotors,
                                           const Config& config);

  /// @param reference  [q1..qN, qd1..qdN, qdd1..qddN] [rad], [rad/s], [rad/s^2]
  /// @param measured   [q1..qN, qd1..qdN]
  /// @param torques    one for each joint [N m]; not finite if one of the others is not
  /// @return false, and nothing is computed, if one of them has another size
  /// @rt nonblocking, no allocation, O(joints^2)
  /// @thread the owning activity only
  bool step(std::span<const double> reference, std::span<const double> measured,
            std::span<double> torques);

  std::size_t joints() const { return rotors_.joints(); }

 private:
  ComputedTorque(InverseDynamics links, Transmission rotors, const Config& config);

  InverseDynamics links_;
  Transmission rotors_;
  Config config_;
  std::vector<double> motion_;  ///< [q, qd, a]
};

}  // namespace armature::control
