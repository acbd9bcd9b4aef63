// SPDX-License-Identifier: Apache-2.0
// What the chassis computes with: speeds of its sides, and where they have brought it.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "robots/rover/odometry.hpp"
#include "robots/rover/speed_ramp.hpp"

namespace armature::rover {
namespace {

TEST(Speeds, AreLoweredByOneFactor) {
  const Speeds fast = within({-1.2, 0.6}, 0.6);
  EXPECT_DOUBLE_EQ(fast.left, -0.6);
  EXPECT_DOUBLE_EQ(fast.right, 0.3);
  EXPECT_EQ(within({0.5, 0.6}, 0.6).left, 0.5);
}

TEST(SpeedRamp, BothSidesArriveTogether) {
  SpeedRamp ramp;
  for (int step = 0; step < 5; ++step) ramp.step({1.0, -0.5}, 0.1);
  EXPECT_NEAR(ramp.now().left, 0.5, 1e-12);
  EXPECT_NEAR(ramp.now().right, -0.25, 1e-12);
  for (int step = 0; step < 6; ++step) ramp.step({1.0, -0.5}, 0.1);
  EXPECT_EQ(ramp.now().left, 1.0);
  EXPECT_EQ(ramp.now().right, -0.5);
}

TEST(SpeedRamp, ComesToRestExactly) {
  SpeedRamp ramp;
  ramp.step({0.33, 0.21}, 1.0);
  for (int step = 0; step < 33; ++step) {
    EXPECT_FALSE(ramp.at_rest());
    ramp.step({}, 0.01001);
  }
  EXPECT_TRUE(ramp.at_rest());
}

TEST(Odometry, ComesBackFromACircle) {
  Odometry odometry(0.3);
  constexpr int kSteps = 1000;
  const double turn = 2.0 * std::numbers::pi / kSteps;
  for (int step = 0; step < kSteps / 2; ++step) odometry.step(0.35 * turn, 0.65 * turn);
  EXPECT_NEAR(odometry.x(), 0.0, 1e-5);
  EXPECT_NEAR(odometry.y(), 1.0, 1e-5);
  EXPECT_NEAR(std::abs(odometry.heading()), std::numbers::pi, 1e-9);
  for (int step = 0; step < kSteps / 2; ++step) odometry.step(0.35 * turn, 0.65 * turn);
  EXPECT_NEAR(odometry.x(), 0.0, 1e-9);
  EXPECT_NEAR(odometry.y(), 0.0, 1e-9);
}

}  // namespace
}  // namespace armature::rover
