// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/motor.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace armature::sim {

base::Result<Motor> Motor::make(const Config& config) {
  auto motor = control::DcMotor::make(config.motor);
  std::string mistakes = motor ? "" : motor.error();
  if (!std::isfinite(config.supply) || config.supply <= 0.0) {
    mistakes += (motor ? "Motor: supply is " : "; supply is ") + std::to_string(config.supply) +
                ", expected a finite number above 0";
  }
  if (!mistakes.empty()) return base::Error{mistakes};
  return Motor(motor.value(), config.supply);
}

void Motor::set_voltage(double voltage) {
  voltage_ = std::clamp(voltage, -supply_, supply_);
  on_ = true;
}

double Motor::current(double velocity) const {
  return on_ ? motor_.current(voltage_, velocity) : 0.0;
}

double Motor::torque(double velocity) const {
  const control::DcMotor::Config& config = motor_.config();
  return config.torque_constant * config.gear_ratio * current(velocity);
}

}  // namespace armature::sim
