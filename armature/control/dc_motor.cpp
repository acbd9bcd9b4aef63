// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dc_motor.hpp"

#include "armature/control/internal/mistakes.hpp"

namespace armature::control {

base::Result<void> DcMotor::check(const Config& config) {
  internal::Mistakes mistakes("DcMotor");
  mistakes.expect_positive("resistance_ohm", config.resistance_ohm);
  mistakes.expect_positive("torque_constant", config.torque_constant);
  mistakes.expect_positive("gear_ratio", config.gear_ratio);
  mistakes.expect_not_negative("viscous_friction", config.viscous_friction);
  mistakes.expect_not_negative("coulomb_friction", config.coulomb_friction);
  mistakes.expect_not_negative("coulomb_velocity", config.coulomb_velocity);
  mistakes.expect_not_negative("rotor_inertia", config.rotor_inertia);
  return mistakes.result();
}

base::Result<DcMotor> DcMotor::make(const Config& config) {
  if (const auto checked = check(config); !checked) return base::Error{checked.error()};
  return DcMotor(config);
}

DcMotor::DcMotor(const Config& config)
    : config_(config),
      volt_per_torque_(config.resistance_ohm / (config.gear_ratio * config.torque_constant)),
      volt_per_velocity_(config.torque_constant * config.gear_ratio) {}

}  // namespace armature::control
