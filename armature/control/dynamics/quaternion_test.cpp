// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/quaternion.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

using Axis = std::array<double, 3>;

std::array<double, 9> rotation_about(const Axis& axis, double angle) {
  const auto& [x, y, z] = axis;
  const double c = std::cos(angle), s = std::sin(angle), d = 1.0 - c;
  return {c + x * x * d,     x * y * d - z * s, x * z * d + y * s, y * x * d + z * s, c + y * y * d,
          y * z * d - x * s, z * x * d - y * s, z * y * d + x * s, c + z * z * d};
}

constexpr double kPi = std::numbers::pi;

TEST(Quaternion, OfNoRotationIsOne) {
  EXPECT_EQ(quaternion_of({1, 0, 0, 0, 1, 0, 0, 0, 1}), (std::array<double, 4>{0, 0, 0, 1}));
}

TEST(Quaternion, HasAxisAndHalfTheAngleAlsoAtAHalfTurn) {
  const double third = 1.0 / std::sqrt(3.0);
  for (const Axis& axis : {Axis{1, 0, 0}, Axis{0, 1, 0}, Axis{0, 0, 1}, Axis{third, third, third},
                           Axis{0.6, 0.0, -0.8}}) {
    for (const double angle : {-3.0, -kPi / 2, -1e-9, 0.7, 2.5, kPi - 1e-9, kPi}) {
      const double sine = std::sin(angle / 2);
      const std::array<double, 4> expected{axis[0] * sine, axis[1] * sine, axis[2] * sine,
                                           std::cos(angle / 2)};
      const auto made = quaternion_of(rotation_about(axis, angle), expected);
      for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(made[i], expected[i], 1e-12) << angle;
    }
  }
}

TEST(Quaternion, StaysOnTheSideOfTheLastOneThroughAWholeTurn) {
  std::array<double, 4> last{0, 0, 0, 1};
  for (double angle = 0.0; angle < 2.0 * kPi; angle += 0.01) {
    const auto next = quaternion_of(rotation_about({0, 0, 1}, angle), last);
    EXPECT_NEAR(next[3], std::cos(angle / 2), 1e-9);
    last = next;
  }
}

}  // namespace
}  // namespace armature::control
