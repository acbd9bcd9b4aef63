// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/result.hpp"
#include "armature/control/dc_motor.hpp"

namespace armature::sim {

/// A DC motor with its gear and its bridge: voltage in, torque at the joint out. The inertia of its
/// rotor and its friction belong to the plant's joint (`armature`, the URDF's friction).
class Motor {
 public:
  /// The motor and the voltage of its supply.
  struct Config {
    control::DcMotor::Config motor;
    double supply = 0.0;  ///< [V], > 0
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<Motor> make(const Config& config);

  /// @param voltage  [V]; limited to the supply
  /// @rt nonblocking, no allocation
  void set_voltage(double voltage);
  /// Opens the winding: no current, so the back-EMF does not brake either.
  /// @rt nonblocking, no allocation
  void switch_off() { on_ = false; }

  /// @param velocity  [rad/s] of the joint
  /// @return [A]
  /// @rt nonblocking, no allocation
  double current(double velocity) const;
  /// @param velocity  [rad/s] of the joint
  /// @return [N m] at the joint, before friction
  /// @rt nonblocking, no allocation
  double torque(double velocity) const;

  double supply() const { return supply_; }
  /// What the rotor adds to the inertia of the joint [kg m^2].
  double armature() const { return motor_.reflected_inertia(); }

 private:
  Motor(const control::DcMotor& motor, double supply) : motor_(motor), supply_(supply) {}

  control::DcMotor motor_;
  double supply_;
  double voltage_ = 0.0;
  bool on_ = false;
};

}  // namespace armature::sim
