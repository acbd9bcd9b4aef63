// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "armature/base/result.hpp"

namespace armature::control {

/// A DC motor behind a gear, without its electrical and mechanical transients: what voltage makes
/// how much torque at the joint. For feed-forward, which adds `voltage(model torque, velocity)` to
/// the output of a Pid.
///
///     voltage = resistance i + k w,   k i gear_ratio = torque + friction,   w = gear_ratio
///     velocity
///
/// with k the torque constant, which in SI units is also that of the back-EMF, and the friction at
/// the joint: viscous_friction velocity + coulomb_friction sign(velocity).
class DcMotor {
 public:
  /// The numbers of the motor and its gear.
  struct Config {
    double resistance_ohm = 0.0;    ///< of the winding; > 0
    double torque_constant = 0.0;   ///< [N m/A] and [V s/rad], at the motor; > 0
    double gear_ratio = 1.0;        ///< turns of the motor for one of the joint; > 0
    double viscous_friction = 0.0;  ///< [N m s/rad], at the joint; >= 0
    double coulomb_friction = 0.0;  ///< [N m], at the joint; >= 0
    /// [rad/s] at the joint: below it Coulomb friction falls linearly to 0, so that feed-forward
    /// does not jump where a motion begins; 0: the plain sign.
    double coulomb_velocity = 0.0;
    double rotor_inertia = 0.0;  ///< [kg m^2], at the motor; >= 0
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<void> check(const Config& config);
  static base::Result<DcMotor> make(const Config& config);

  /// What makes `torque` at a joint that moves with `velocity`. Not limited to the supply; not
  /// finite if an argument is not.
  /// @param torque    [N m] at the joint, beyond friction
  /// @param velocity  [rad/s] of the joint
  /// @return [V]
  /// @rt nonblocking, no allocation
  double voltage(double torque, double velocity) const {
    return volt_per_torque_ * (torque + friction(velocity)) + volt_per_velocity_ * velocity;
  }

  /// The inverse of `voltage`: what is left at the joint, beyond friction. Meant for a joint that
  /// moves: at rest Coulomb friction is 0 here, while a real one holds against small torques.
  /// @param voltage   [V]
  /// @param velocity  [rad/s] of the joint
  /// @return [N m] at the joint
  /// @rt nonblocking, no allocation
  double torque(double voltage, double velocity) const {
    return (voltage - volt_per_velocity_ * velocity) / volt_per_torque_ - friction(velocity);
  }

  /// @return [A] through the winding
  /// @rt nonblocking, no allocation
  double current(double voltage, double velocity) const {
    return (voltage - volt_per_velocity_ * velocity) / config_.resistance_ohm;
  }

  /// @return [N m] against a motion with `velocity` [rad/s], both at the joint
  /// @rt nonblocking, no allocation
  double friction(double velocity) const {
    return config_.viscous_friction * velocity + config_.coulomb_friction * direction(velocity);
  }

  /// What the rotor adds to the inertia of the joint [kg m^2]: rotor_inertia gear_ratio^2. A model
  /// of the links does not know it; feed-forward adds it times the acceleration to the torque.
  /// @rt nonblocking, no allocation
  double reflected_inertia() const {
    return config_.rotor_inertia * config_.gear_ratio * config_.gear_ratio;
  }

  const Config& config() const { return config_; }

 private:
  explicit DcMotor(const Config& config);

  /// -1 to 1.
  double direction(double velocity) const {
    if (config_.coulomb_velocity > 0.0) {
      return std::clamp(velocity / config_.coulomb_velocity, -1.0, 1.0);
    }
    return static_cast<double>(velocity > 0.0) - static_cast<double>(velocity < 0.0);
  }

  Config config_;
  double volt_per_torque_;    ///< [V/(N m)]
  double volt_per_velocity_;  ///< [V s/rad]
};

}  // namespace armature::control
