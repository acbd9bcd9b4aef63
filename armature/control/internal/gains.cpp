// SPDX-License-Identifier: Apache-2.0
#include "armature/control/internal/gains.hpp"

#include <cmath>

namespace armature::control::internal {

void Gains::expect(std::string_view name, const std::vector<double>& gains) {
  if (gains.size() != joints_) {
    note(std::string(name) + " has " + std::to_string(gains.size()) + " numbers, expected " +
         std::to_string(joints_) + ", one for each joint");
    return;
  }
  for (std::size_t i = 0; i < joints_; ++i) {
    if (std::isfinite(gains[i]) && gains[i] >= 0.0) continue;
    note(std::string(name) + " of joint " + std::to_string(i + 1) + " is " +
         std::to_string(gains[i]) + ", expected a finite number of at least 0");
  }
}

void Gains::expect_joints(std::string_view name, std::size_t joints) {
  if (joints == joints_) return;
  note(std::string(name) + " are for " + std::to_string(joints) + " joints, expected " +
       std::to_string(joints_));
}

base::Result<void> Gains::result() const {
  if (all_.empty()) return {};
  return base::Error{object_ + ": " + all_};
}

}  // namespace armature::control::internal
