// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/standing_watch.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::wam {
namespace {

using ::testing::HasSubstr;
using Vector = std::vector<double>;

class StandingWatchTest : public ::testing::Test {
 protected:
  static StandingWatch::Config config() {
    return {{0.01, 0.01}, {0.1, 0.1}, {50.0, 5.0}, 0.2, 0.002, {5.0, 5.0}};
  }
  /// What it says in one of so many cycles; empty if nothing.
  std::string step(const Vector& positions, const Vector& velocities,
                   const Vector& torques = {0, 0}, int cycles = 1) {
    for (int i = 0; i < cycles; ++i) {
      if (const auto why = watch.step(positions, velocities, torques)) {
        return std::string(why->view());
      }
    }
    return "";
  }
  void stand() {
    watch.stand(Vector{0.0, 0.0});
    EXPECT_EQ(step({1.0, 2.0}, {0.0, 0.0}, {0, 0}, 200), "");
  }
  StandingWatch watch = StandingWatch::make(config()).value();
};

TEST_F(StandingWatchTest, AnArmThatMayMoveIsNotJudged) {
  EXPECT_EQ(step({1.0, 2.0}, {5.0, 5.0}, {50.0, 5.0}, 10), "");
}

TEST_F(StandingWatchTest, AJointThatLeavesItsPlaceIsNamedWithHowFar) {
  stand();
  EXPECT_EQ(step({1.009, 2.0}, {0.0, 0.0}), "");
  EXPECT_THAT(
      step({1.0, 2.02}, {0.0, 0.0}),
      HasSubstr("joint 2 should stand still but has moved: by 0.02 rad, expected at most 0.01"));
}

TEST_F(StandingWatchTest, AJointThatBecomesFastIsNamedWithinThreeCycles) {
  stand();
  EXPECT_THAT(step({1.001, 2.0}, {0.3, 0.0}, {0, 0}, 3), HasSubstr("by 0.3 rad/s"));
}

TEST_F(StandingWatchTest, OnItsWayToRestItMayBeAsFastAsItWas) {
  watch.stand(Vector{2.0, 0.0});
  for (double v = 2.0; v > 0.0; v -= 0.02) EXPECT_EQ(step({1.0 - v, 2.0}, {v, 0.0}), "") << v;
  EXPECT_EQ(step({1.0, 2.0}, {0.0, 0.0}, {0, 0}, 1000), "");
}

TEST_F(StandingWatchTest, OnItsWayToRestItDoesNotBecomeFaster) {
  watch.stand(Vector{0.5, 0.0});
  EXPECT_THAT(
      step({1.0, 2.0}, {0.5, 0.9}, {0, 0}, 3),
      HasSubstr("joint 2 should stand still but has moved: by 0.9 rad/s, expected at most 0.8"));
}

TEST_F(StandingWatchTest, OnItsWayToRestItGoesNoFartherThanItNeedsToStop) {
  watch.stand(Vector{1.0, 0.0});
  EXPECT_THAT(step({1.0, 2.0}, {1.0, 0.0}, {0, 0}, 600),
              HasSubstr("joint 1 should stand still but has moved: by 0.36"));
  watch.move();
  watch.stand(Vector{0.0, 0.0});
  EXPECT_THAT(step({1.0, 2.0}, {0.0, 0.25}, {0, 0}, 600), HasSubstr("joint 2"))
      << "also where it rested: slower than what would be too fast";
}

TEST_F(StandingWatchTest, OnItsWayToRestItIsNotShaken) {
  watch.stand(Vector{0.0, 0.0});
  std::string said;
  for (int i = 0; i < 100 && said.empty(); ++i) {
    said = step({1.0, 2.0}, {0.0, 0.0}, {i % 2 == 0 ? 20.0 : -20.0, 0.0});
  }
  EXPECT_THAT(said, HasSubstr("joint 1 shakes"));
}

TEST_F(StandingWatchTest, AWayToRestHasAnEnd) {
  watch.stand(Vector{0.0, 0.0});
  EXPECT_NE(step({1.0, 2.0}, {0.2, 0.0}, {0, 0}, 800), "") << "within 1.6 s";
}

TEST_F(StandingWatchTest, TorquesThatShakeAreNamedAndTheNoiseOfEncodersIsNot) {
  stand();
  std::string said;
  for (int i = 0; i < 100 && said.empty(); ++i) {
    said = step({1.0, 2.0}, {0.0, 0.0}, {0.0, i % 2 == 0 ? 0.4 : -0.4});
  }
  EXPECT_EQ(said, "") << "0.4 Nm are below a tenth of 5 Nm";
  int cycles = 0;
  for (; cycles < 100 && said.empty(); ++cycles) {
    said = step({1.0, 2.0}, {0.0, 0.0}, {0.0, cycles % 2 == 0 ? 4.0 : -4.0});
  }
  EXPECT_THAT(said, HasSubstr("joint 2 shakes: what holds it has changed its sign in 0.2"));
  EXPECT_LT(cycles, 10);
}

TEST_F(StandingWatchTest, WhatIsNoNumberIsFound) {
  stand();
  EXPECT_NE(step({std::numeric_limits<double>::quiet_NaN(), 2.0}, {0.0, 0.0}), "");
}

}  // namespace
}  // namespace armature::wam
