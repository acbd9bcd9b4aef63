// SPDX-License-Identifier: Apache-2.0
#include "armature/control/pid.hpp"

#include "armature/control/internal/mistakes.hpp"

namespace armature::control {

base::Result<void> Pid::check(const Config& config) {
  internal::Mistakes mistakes("Pid");
  mistakes.expect_not_negative("kp", config.kp);
  mistakes.expect_not_negative("ki", config.ki);
  mistakes.expect_not_negative("kd", config.kd);
  mistakes.expect_finite("u_min", config.u_min);
  mistakes.expect_finite("u_max", config.u_max);
  mistakes.expect(!(config.u_max <= config.u_min), "u_max", config.u_max, "a number above u_min");
  return mistakes.result();
}

base::Result<Pid> Pid::make(const Config& config) {
  if (const auto checked = check(config); !checked) return base::Error{checked.error()};
  return Pid(config);
}

base::Result<void> Pid::reconfigure(const Config& config) {
  auto checked = check(config);
  if (checked) config_ = config;
  return checked;
}

}  // namespace armature::control
