// SPDX-License-Identifier: Apache-2.0
#include "armature/control/absolute_position.hpp"

#include <chrono>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/control/following_watch.hpp"

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

AbsolutePosition made(const AbsolutePosition::Config& config) {
  return AbsolutePosition::make(config).value();
}

TEST(AbsolutePosition, IsBehindAGearAndFromAnotherZero) {
  auto position = made({.ratio = -0.5, .offset = 1.0, .max_velocity = 1.0});
  const auto first = position.step(4.0, 100.0);
  EXPECT_EQ(first.position, -1.0);
  EXPECT_EQ(first.displacement, 0.0);
  const auto second = position.step(3.9, 0.1);
  EXPECT_NEAR(second.position, -0.95, 1e-12);
  EXPECT_NEAR(second.displacement, 0.05, 1e-12);
  EXPECT_FALSE(second.jumped);
}

TEST(AbsolutePosition, GoesOnWhereTheSensorBeginsAgain) {
  auto position = made({.range = 1.0, .max_velocity = 10.0});
  double sensor = 0.4;
  EXPECT_NEAR(position.step(sensor, 0.0).position, 0.4, 1e-12);
  double expected = 0.4;
  for (int k = 0; k < 100; ++k) {  // ten turns on
    sensor += 0.1;
    if (sensor >= 1.0) sensor -= 1.0;
    expected += 0.1;
    EXPECT_NEAR(position.step(sensor, 0.1).position, expected, 1e-9);
  }
}

TEST(AbsolutePosition, AJumpIsMoreThanTheJointCanHaveMoved) {
  auto position = made({.max_velocity = 2.0});
  position.step(0.0, 0.0);
  EXPECT_FALSE(position.step(0.039, 0.01).jumped);
  const auto jump = position.step(0.08, 0.01);
  EXPECT_TRUE(jump.jumped);
  EXPECT_NEAR(jump.possible, 0.04, 1e-12);
}

TEST(AbsolutePosition, ANewBeginningIsNoJump) {
  auto position = made({.max_velocity = 2.0});
  position.step(0.0, 0.0);
  position.reset();
  const auto first = position.step(100.0, 0.01);
  EXPECT_FALSE(first.jumped);
  EXPECT_EQ(first.position, 100.0);
}

TEST(AbsolutePosition, WhatWasFoundBeyondItsRangeIsTheSameAfterAStart) {
  auto position = made({.ratio = 0.5, .offset = 0.1, .range = 2.0, .max_velocity = 10.0});
  position.step(0.9, 0.0);
  position.step(-0.8, 0.1);  // 1.2 of its axis
  ASSERT_NEAR(position.position(), 0.7, 1e-12);
  position.shift(0.2);
  EXPECT_NEAR(position.position(), 0.9, 1e-12);
  EXPECT_NEAR(position.offset(), 0.9 + 0.4, 1e-12);
  EXPECT_NEAR(position.at(1.0), -0.6, 1e-12);
  auto again =
      made({.ratio = 0.5, .offset = position.offset(), .range = 2.0, .max_velocity = 10.0});
  EXPECT_NEAR(again.step(-0.8, 0.0).position, 0.9, 1e-12);
}

TEST(AbsolutePosition, ADriveIsToldInWhatItsSensorSays) {
  auto position = made({.ratio = -0.01, .offset = 1.0, .range = 6.0, .max_velocity = 1.0});
  position.step(2.0, 0.0);  // 0.98
  EXPECT_NEAR(position.at(0.98), 2.0, 1e-12);
  EXPECT_NEAR(position.at(0.9), 10.0, 1e-12) << "counted on, beyond its range";
}

TEST(AbsolutePosition, WhatCannotBeIsNamed) {
  EXPECT_THAT(AbsolutePosition::make({.ratio = 0.0, .max_velocity = 1.0}).error(),
              HasSubstr("ratio is 0"));
  EXPECT_THAT(AbsolutePosition::make({.range = -1.0, .max_velocity = 0.0}).error(),
              HasSubstr("range is -1"));
  EXPECT_THAT(AbsolutePosition::make({.max_velocity = 0.0}).error(), HasSubstr("max_velocity"));
}

TEST(FollowingWatch, AnErrorThatLastsLongerThanItMayIsFound) {
  FollowingWatch watch({.max_error = 0.1, .patience = 50ms});
  EXPECT_TRUE(watch.step(0.2, base::Time{0ms}));
  EXPECT_TRUE(watch.step(-0.2, base::Time{49ms}));
  EXPECT_TRUE(watch.step(0.1, base::Time{50ms})) << "it follows again";
  EXPECT_TRUE(watch.step(0.2, base::Time{60ms}));
  EXPECT_FALSE(watch.step(0.2, base::Time{110ms}));
}

TEST(FollowingWatch, WithoutPatienceOneErrorIsEnough) {
  FollowingWatch watch({.max_error = 0.1, .patience = 0ms});
  EXPECT_FALSE(watch.step(0.11, base::Time{0ms}));
  EXPECT_FALSE(watch.step(std::numeric_limits<double>::quiet_NaN(), base::Time{10ms}));
}

}  // namespace
}  // namespace armature::control
