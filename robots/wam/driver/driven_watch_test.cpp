// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/driven_watch.hpp"

#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::wam {
namespace {

using ::testing::HasSubstr;
using Vector = std::vector<double>;

/// Two joints, of which the second carries weight: it is pulled to greater positions.
class DrivenWatchTest : public ::testing::Test {
 protected:
  DrivenWatchTest() { watch.begin(); }

  /// What it says in one of so many cycles, in which the second joint moves on; empty if nothing.
  std::string move(double velocity, double torque, int cycles) {
    std::string said;
    for (int i = 0; i < cycles && said.empty(); ++i) {
      position += velocity * kPeriod_s;
      said = step({0.0, position}, {0.0, velocity}, {0.0, torque});
    }
    return said;
  }
  std::string step(const Vector& positions, const Vector& velocities, const Vector& torques) {
    const auto why = watch.step({positions, velocities, torques, weight, tip});
    return why ? std::string(why->view()) : "";
  }
  void rest() {
    watch.rest();
    EXPECT_EQ(move(0.0, 0.0, 1), "");
  }

  static constexpr double kPeriod_s = 0.002;
  const Vector weight{0.0, -10.0};
  double position = 1.0;
  double tip = 0.0;
  DrivenWatch watch =
      DrivenWatch::make({{2.5, 2.5}, {50.0, 50.0}, 0.985, 0.1, 0.5, 0.2, kPeriod_s}).value();
};

TEST_F(DrivenWatchTest, AMotionThatIsCommandedIsNotJudgedByItsWay) {
  EXPECT_EQ(move(2.0, 20.0, 1000), "");
  EXPECT_EQ(move(-2.0, -20.0, 1000), "");
}

TEST_F(DrivenWatchTest, AJointThatIsFasterThanItMayBeIsNamedWithinThreeCycles) {
  EXPECT_EQ(move(2.7, 0.0, 100), "") << "the limiter lets it overshoot a little";
  EXPECT_THAT(move(2.9, 0.0, 3), HasSubstr("joint 2 is too fast: 2.9 rad/s, expected at most 2.8"));
}

TEST_F(DrivenWatchTest, ATipThatGetsFasterThanItMayBeIsFoundBeforeItIs) {
  for (const double acceleration : {0.5, 2.5, 4.5}) {  // [m/s^2]
    watch.begin();
    std::string said;
    for (tip = 0.0; said.empty() && tip < 1.2; tip += kPeriod_s * acceleration) {
      said = move(0.0, 0.0, 1);
    }
    EXPECT_THAT(said, HasSubstr("the tip gets too fast: "));
    EXPECT_LT(tip + 0.01 * acceleration, 0.995) << "braked ten milliseconds later";
    EXPECT_GT(tip, 0.9);
  }
}

TEST_F(DrivenWatchTest, StepsOfEncodersDoNotMakeATipFaster) {
  for (tip = 0.0; tip < 0.95; tip += 0.001) EXPECT_EQ(move(0.0, 0.0, 1), "") << tip;
  for (int i = 0; i < 1000; ++i) {
    tip = 0.95 + (i % 3 == 0 ? 0.02 : -0.01);
    ASSERT_EQ(move(0.0, 0.0, 1), "") << i;
  }
}

TEST_F(DrivenWatchTest, TorquesThatShakeAreNamedAlsoInMotion) {
  std::string said;
  int cycles = 0;
  for (; cycles < 100 && said.empty(); ++cycles) said = move(1.0, cycles % 2 == 0 ? 6.0 : -6.0, 1);
  EXPECT_THAT(said, HasSubstr("joint 2 shakes: what drives it has changed its sign in 0.2"));
  EXPECT_LT(cycles, 10);
}

TEST_F(DrivenWatchTest, TheNoiseOfEncodersDoesNotShake) {
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(move(0.0, i % 2 == 0 ? 4.9 : -4.9, 1), "");
}

TEST_F(DrivenWatchTest, AControllerThatDrivesAJointOffItsPlaceIsNamed) {
  rest();
  EXPECT_EQ(move(0.3, 10.0, 150), "") << "0.09 rad";
  EXPECT_THAT(move(0.3, 10.0, 100),
              HasSubstr("joint 2 should stand still but is driven away: by 0.1"));
}

TEST_F(DrivenWatchTest, AHandThatPushesAnArmWhoseControllerHoldsAgainstItIsNoFault) {
  rest();
  EXPECT_EQ(move(-0.5, 20.0, 300), "") << "0.3 rad upwards";
  EXPECT_EQ(move(0.5, 20.0, 300), "") << "and the controller moves it back";
}

TEST_F(DrivenWatchTest, AWeightlessArmIsLedByHandWithBreaks) {
  rest();
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(move(0.8, 0.0, 250), "") << "0.4 rad down, stroke " << i;
    EXPECT_EQ(move(0.0, 0.0, 260), "");
    EXPECT_EQ(move(-1.0, 0.0, 200), "") << "and up";
  }
}

TEST_F(DrivenWatchTest, AWeightlessArmThatSinksOnAndOnIsNamedHoweverSlowlyItDoes) {
  for (const double velocity : {0.03, 0.3, 2.0}) {
    watch.move();
    rest();
    EXPECT_EQ(move(velocity, 0.0, static_cast<int>(0.49 / velocity / kPeriod_s)), "") << velocity;
    EXPECT_THAT(move(velocity, 0.0, static_cast<int>(0.03 / velocity / kPeriod_s)),
                HasSubstr("joint 2 sinks, and nothing drives it down: by 0.5 rad, expected at most "
                          "0.5"));
  }
}

TEST_F(DrivenWatchTest, StepsOfEncodersAreNoSinking) {
  rest();
  for (int i = 0; i < 100'000; ++i) {
    const double velocity = i % 7 == 0 ? 0.08 : i % 7 == 3 ? -0.08 : 0.0;
    ASSERT_EQ(move(velocity, 0.0, 1), "") << i;
  }
}

TEST_F(DrivenWatchTest, WhatItFoundBeforeItIsArmedAgainDoesNotCount) {
  rest();
  EXPECT_NE(move(0.3, 0.0, 1000), "");
  watch.begin();
  EXPECT_EQ(move(0.3, 0.0, 1000), "") << "it may move until it is to stand";
}

TEST_F(DrivenWatchTest, WhatIsNoNumberIsFound) {
  EXPECT_NE(move(std::numeric_limits<double>::quiet_NaN(), 0.0, 3), "");
}

}  // namespace
}  // namespace armature::wam
