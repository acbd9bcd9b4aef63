// SPDX-License-Identifier: Apache-2.0
#include "armature/control/still_watch.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

constexpr double kPeriod = 0.01;

TEST(StillWatch, LetsAJointStandThatIsToldToStand) {
  StillWatch watch({.most = 0.01});
  for (int k = 0; k < 100'000; ++k) ASSERT_TRUE(watch.step(0.5, 0.0, kPeriod));
}

TEST(StillWatch, FindsAPositionThatStaysWhileTheJointIsToldToGo) {
  StillWatch watch({.most = 0.01});
  double told = 0.0;
  while (watch.step(0.5, 0.0005, kPeriod)) told += 0.0005;
  EXPECT_NEAR(told, 0.01, 0.001);
}

TEST(StillWatch, OneCountOfItsSensorIsNews) {
  StillWatch watch({.most = 0.01});
  double position = 0.5;
  for (int k = 0; k < 1000; ++k) {
    if (k % 15 == 0) position += 1e-9;
    ASSERT_TRUE(watch.step(position, 0.0005, kPeriod)) << k;
  }
}

TEST(StillWatch, ToldToGoForthAndBackAJointMayStand) {
  StillWatch watch({.most = 0.01});
  for (int k = 0; k < 10'000; ++k)
    ASSERT_TRUE(watch.step(0.5, k % 2 == 0 ? 0.006 : -0.006, kPeriod));
}

TEST(StillWatch, VelocitiesThatADriveRoundsToNoneDoNotAddUp) {
  StillWatch watch({.most = 0.02, .memory = 1.0});
  for (int k = 0; k < 100'000; ++k) ASSERT_TRUE(watch.step(0.5, 0.015 * kPeriod, kPeriod));
  int periods = 0;
  while (watch.step(0.5, 0.2 * kPeriod, kPeriod)) ++periods;
  EXPECT_LT(periods, 20);
}

TEST(StillWatch, BeginsAnewWhenItIsReset) {
  StillWatch watch({.most = 0.01});
  for (int k = 0; k < 15; ++k) ASSERT_TRUE(watch.step(0.5, 0.0006, kPeriod));
  watch.reset();
  for (int k = 0; k < 15; ++k) ASSERT_TRUE(watch.step(0.5, 0.0006, kPeriod));
  for (int k = 0; k < 3; ++k) static_cast<void>(watch.step(0.5, 0.0006, kPeriod));
  EXPECT_FALSE(watch.step(0.5, 0.0006, kPeriod));
}

TEST(StillWatch, WhatIsNoNumberIsNoMotion) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  StillWatch watch({.most = 0.01});
  EXPECT_FALSE(watch.step(kNone, 0.0, kPeriod));
  for (int k = 0; k < 12; ++k) static_cast<void>(watch.step(0.5, kNone, kPeriod));
  EXPECT_FALSE(watch.step(0.5, 0.0, kPeriod));
}

TEST(StillWatch, ASensorThatTellsEachPositionTenTimesIsInOrder) {
  StillWatch watch({.most = 0.01});
  for (int k = 0; k < 1000; ++k) ASSERT_TRUE(watch.step(0.02 * (k / 10), 0.02, kPeriod)) << k;
}

TEST(StillWatch, AFastJointThatMovesIsInOrder) {
  StillWatch watch({.most = 0.01});
  for (int k = 0; k < 1000; ++k) ASSERT_TRUE(watch.step(0.02 * k, 0.02, kPeriod)) << k;
}

}  // namespace
}  // namespace armature::control
