// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "armature/control/transmission.hpp"

namespace armature::wam {

/// [m/s^2], as the vendor's software counts with it, along -z of the arm's base.
constexpr double kGravity = 9.805;
/// [s] of the vendor's control cycle.
constexpr double kPeriod = 0.002;

/// One motor, by its data sheet (Barrett support wiki, "Specifications: Motors").
struct MotorNumbers {
  double torque_constant = 0.0;  ///< [N m/A] and [V s/rad]
  double resistance_ohm = 0.0;   ///< of the winding
};

/// The gains of the vendor's joint position controller (libbarrett, config/wam7w.conf, wam4.conf).
struct JointGains {
  double kp = 0.0;          ///< [N m/rad]
  double ki = 0.0;          ///< [N m/(rad s)]
  double kd = 0.0;          ///< [N m s/rad]
  double max_torque = 0.0;  ///< [N m]
};

/// What the description of an arm's links, wam7.urdf or wam4.urdf, does not say. All vectors go
/// from the base on.
struct ArmNumbers {
  std::string_view urdf;  ///< the name of the description's file
  /// Of the cable drives (libbarrett; manual) and of rotors with their pinions (a laboratory that
  /// measured them), and the viscous friction of the motors' data sheets. Those of the shoulder and
  /// of the wrist are differentials.
  control::Transmission::Config transmission;
  std::vector<double> home;  ///< [rad] where the arm is put to be zeroed (libbarrett, zerocal.conf)
  std::vector<MotorNumbers> motors;
  std::vector<JointGains> gains;

  std::size_t joints() const { return home.size(); }
};

/// The arm with seven joints, and that without a wrist.
const ArmNumbers& wam7();
const ArmNumbers& wam4();

}  // namespace armature::wam
