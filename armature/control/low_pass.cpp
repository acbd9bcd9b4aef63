// SPDX-License-Identifier: Apache-2.0
#include "armature/control/low_pass.hpp"

#include "armature/control/internal/mistakes.hpp"

namespace armature::control {

base::Result<LowPass> LowPass::make(const Config& config) {
  internal::Mistakes mistakes("LowPass");
  mistakes.expect_positive("omega", config.omega);
  mistakes.expect_positive("period_s", config.period_s);
  if (const auto checked = mistakes.result(); !checked) return base::Error{checked.error()};
  const double turned = config.omega * config.period_s;
  return LowPass(turned / (1.0 + turned));
}

}  // namespace armature::control
