// SPDX-License-Identifier: Apache-2.0
// The arms as tests have them.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "robots/wam/arm_numbers.hpp"

namespace armature::wam {

using Vector = std::vector<double>;

inline std::string description_of(const ArmNumbers& arm) {
  return std::string(ROBOT_FOLDER "/") + std::string(arm.urdf);
}

/// For the instances of a test.
inline std::string name_of_arm(const ::testing::TestParamInfo<const ArmNumbers*>& tested) {
  return "Of" + std::to_string(tested.param->joints()) + "Joints";
}

inline control::InverseDynamics dynamics_of(const ArmNumbers& arm) {
  base::Diagnostics diagnostics;
  auto made = control::InverseDynamics::load(description_of(arm),
                                             {.gravity = {0.0, 0.0, -kGravity}}, diagnostics);
  EXPECT_TRUE(made.has_value() && diagnostics.empty()) << diagnostics.to_text();
  return std::move(made.value());
}

inline control::Transmission transmission_of(const ArmNumbers& arm) {
  auto made = control::Transmission::make(arm.transmission);
  EXPECT_TRUE(made.ok()) << made.error();
  return made.value();
}

/// The largest magnitude of a vector, and of the difference of two.
inline double largest(const Vector& numbers) {
  double most = 0.0;
  for (const double number : numbers) most = std::max(most, std::abs(number));
  return most;
}
inline double largest_difference(const Vector& left, const Vector& right) {
  double most = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) most = std::max(most, std::abs(left[i] - right[i]));
  return most;
}

}  // namespace armature::wam
