// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/reference_brake.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Vector = std::vector<double>;

ReferenceBrake make_brake() {
  return ReferenceBrake::make({.joints = 2, .max_acceleration = {2.0, 4.0}, .period = 10ms})
      .value();
}

TEST(ReferenceBrake, BringsEachJointToRestWithItsAccelerationAndHoldsIt) {
  ReferenceBrake brake = make_brake();
  brake.begin({1.0, -1.0, 0.5, -0.8, 0.0, 0.0});
  Vector before{1.0, -1.0, 0.5, -0.8, 0.0, 0.0};
  for (int k = 0; k < 30; ++k) {
    const Vector& now = brake.step();
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LE(std::abs(now[2 + i] - before[2 + i]), (i == 0 ? 0.02 : 0.04) + 1e-12);
      EXPECT_NEAR(now[i] - before[i], 0.005 * (now[2 + i] + before[2 + i]), 1e-12);
      EXPECT_NEAR(now[4 + i], (now[2 + i] - before[2 + i]) / 0.01, 1e-9);
    }
    before = now;
  }
  // v^2 / (2 a)
  EXPECT_THAT(before,
              ElementsAre(DoubleNear(1.0625, 1e-9), DoubleNear(-1.08, 1e-9), 0.0, 0.0, 0.0, 0.0));
  EXPECT_EQ(brake.step(), before);
}

TEST(ReferenceBrake, GivesWayOnlyAtRestToAReferenceThatRestsWhereTheJointsAre) {
  ReferenceBrake brake = make_brake();
  brake.begin({1.0, 2.0, 0.1, 0.0, 0.0, 0.0});
  const Vector measured{1.003, 2.0, 0.0, 0.0};
  const Vector here{1.003, 2.0, 0.0, 0.0, 0.0, 0.0};
  brake.step();
  EXPECT_FALSE(brake.may_give_way_to(here, measured)) << "it still brakes";
  for (int k = 0; k < 10; ++k) brake.step();
  EXPECT_TRUE(brake.may_give_way_to(here, measured));
  EXPECT_FALSE(brake.may_give_way_to({1.2, 2.0, 0.0, 0.0, 0.0, 0.0}, measured)) << "elsewhere";
  EXPECT_FALSE(brake.may_give_way_to({1.003, 2.0, 0.0, 0.3, 0.0, 0.0}, measured)) << "passing by";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(brake.may_give_way_to({nan, 2.0, 0.0, 0.0, 0.0, 0.0}, measured));
}

TEST(ReferenceBrake, KnowsWhetherItWouldRestNearAMotion) {
  ReferenceBrake brake = make_brake();
  brake.begin({1.0, -1.0, 1.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(brake.rests_near({1.0, -1.0, 1.0, 0.0}, 1e-9));
  EXPECT_TRUE(brake.rests_near({1.25, -1.0, 0.0, 0.0}, 1e-9)) << "1^2 / (2 * 2) further";
  EXPECT_FALSE(brake.rests_near({1.0, -1.0, -1.0, 0.0}, 0.49)) << "the other way";
  EXPECT_FALSE(brake.rests_near({1.25, 0.0, 0.0, 0.0}, 0.9)) << "the second joint is elsewhere";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(brake.rests_near({nan, -1.0, 0.0, 0.0}, 1.0));
}

TEST(ReferenceBrake, NamesEveryNumberThatIsWrong) {
  const auto made = ReferenceBrake::make(
      {.joints = 3, .max_acceleration = {1.0, -1.0, 1.0}, .period = 0ms, .tolerance = 0.0});
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error(), HasSubstr("max_acceleration is -1"));
  EXPECT_THAT(made.error(), HasSubstr("period [s] is 0"));
  EXPECT_THAT(made.error(), HasSubstr("tolerance is 0"));
  const auto two =
      ReferenceBrake::make({.joints = 3, .max_acceleration = {1.0, 1.0}, .period = 10ms});
  ASSERT_FALSE(two);
  EXPECT_THAT(two.error(), HasSubstr("max_acceleration"));
}

}  // namespace
}  // namespace armature::control
