// SPDX-License-Identifier: Apache-2.0
#include "armature/control/positional_pid.hpp"

#include "armature/control/internal/mistakes.hpp"

namespace armature::control {

base::Result<PositionalPid> PositionalPid::make(const Config& config) {
  internal::Mistakes mistakes("PositionalPid");
  mistakes.expect_not_negative("kp", config.kp);
  mistakes.expect_not_negative("ki", config.ki);
  mistakes.expect_not_negative("kd", config.kd);
  mistakes.expect_not_negative("max_integral", config.max_integral);
  mistakes.expect_not_negative("max_output", config.max_output);
  mistakes.expect_positive("period_s", config.period_s);
  if (const auto checked = mistakes.result(); !checked) return base::Error{checked.error()};
  return PositionalPid(config);
}

}  // namespace armature::control
