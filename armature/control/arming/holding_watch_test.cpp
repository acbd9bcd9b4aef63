// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/holding_watch.hpp"

#include <chrono>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using Verdict = HoldingWatch::Verdict;

class Holding : public ::testing::Test {
 protected:
  static HoldingWatch::Config config() {
    return {.period = 10ms,
            .max_motion = 0.1,
            .max_velocity = 0.5,
            .sinking_velocity = 0.05,
            .least_effort = 0.5,
            .max_alternation = 0.5,
            .alternation_time = 200ms,
            .rest_velocity = 0.02,
            .settling_time = 1s};
  }
  /// Steps in which the joint moves with `velocity`, until there is an alarm.
  HoldingWatch::Finding move_on(double velocity, int steps, bool driven = true) {
    HoldingWatch::Finding finding;
    for (int k = 0; k < steps && !finding.is_alarm(); ++k) {
      position_ += velocity * 0.01;
      finding =
          watch_.step({.position = position_, .velocity = velocity, .effort = 0, .driven = driven});
    }
    return finding;
  }

  HoldingWatch watch_ = HoldingWatch::make(config()).value();
  double position_ = 1.0;
};

TEST_F(Holding, WhatMayMoveIsNotJudged) {
  EXPECT_EQ(move_on(5.0, 100).verdict, Verdict::kMay);
  watch_.stand();
  EXPECT_EQ(move_on(0.0, 1).verdict, Verdict::kStands);
  watch_.move();
  EXPECT_EQ(move_on(5.0, 100).verdict, Verdict::kMay);
}

TEST_F(Holding, AJointThatComesToRestHasItsPlaceThere) {
  watch_.stand();
  EXPECT_EQ(move_on(1.0, 50).verdict, Verdict::kSettles);
  EXPECT_EQ(move_on(0.0, 1).verdict, Verdict::kStands);
  EXPECT_EQ(move_on(0.3, 33).verdict, Verdict::kStands) << "0.099 rad from there";
}

TEST_F(Holding, AJointThatDoesNotComeToRestInTimeIsAnAlarm) {
  watch_.stand();
  const auto finding = move_on(1.0, 103);
  EXPECT_EQ(finding.verdict, Verdict::kFast);
  EXPECT_EQ(finding.measured, 1.0);
  EXPECT_EQ(finding.bound, 0.5);
}

TEST_F(Holding, TooFarIsAnAlarmWithBothFigures) {
  watch_.stand();
  move_on(0.0, 1);
  const auto finding = move_on(0.3, 100);
  EXPECT_EQ(finding.verdict, Verdict::kMoved);
  EXPECT_NEAR(finding.measured, 0.102, 1e-12);
  EXPECT_EQ(finding.bound, 0.1);
}

TEST_F(Holding, TooFastIsAnAlarmInTheThirdStepAlsoThereAndBack) {
  watch_.stand();
  move_on(0.0, 1);
  EXPECT_FALSE(move_on(0.6, 1).is_alarm());
  EXPECT_FALSE(move_on(-0.6, 1).is_alarm());
  EXPECT_EQ(move_on(0.6, 1).verdict, Verdict::kFast);
}

TEST_F(Holding, OneFastSampleIsNone) {
  watch_.stand();
  move_on(0.0, 1);
  for (int k = 0; k < 20; ++k) {
    EXPECT_FALSE(move_on(k % 2 == 0 ? 2.0 : -2.0, 1).is_alarm());
    EXPECT_FALSE(move_on(0.0, 1).is_alarm());
  }
}

TEST_F(Holding, WhatIsNotDrivenMaySinkAsFarAsItsWeightTakesIt) {
  watch_.stand();
  EXPECT_EQ(move_on(-0.04, 2000, false).verdict, Verdict::kSinks) << "0.8 rad";
  EXPECT_EQ(move_on(-0.06, 3, false).verdict, Verdict::kFast) << "no brake does that";
}

TEST_F(Holding, WhatIsDrivenDoesNotSink) {
  watch_.stand();
  move_on(0.0, 1);
  EXPECT_EQ(move_on(-0.04, 2000).verdict, Verdict::kMoved);
}

TEST_F(Holding, AnEffortThatAlternatesIsAnAlarm) {
  watch_.stand();
  HoldingWatch::Finding finding;
  int steps = 0;
  while (!finding.is_alarm() && steps < 1000) {
    const double effort = ++steps % 2 == 0 ? 1.0 : -1.0;
    finding = watch_.step({.position = 1.0, .velocity = 0.0, .effort = effort, .driven = true});
  }
  EXPECT_EQ(finding.verdict, Verdict::kAlternates);
  EXPECT_GT(finding.measured, 0.5);
  EXPECT_EQ(steps, 15) << "0.7 of the time";
}

TEST_F(Holding, SmallOrSlowAlternationIsNone) {
  watch_.stand();
  for (int k = 0; k < 1000; ++k) {
    const double small = k % 2 == 0 ? 0.4 : -0.4;
    ASSERT_FALSE(watch_.step({.position = 1.0, .velocity = 0.0, .effort = small, .driven = true})
                     .is_alarm());
  }
  for (int k = 0; k < 1000; ++k) {
    const double slow = k % 6 < 3 ? 5.0 : -5.0;
    ASSERT_FALSE(
        watch_.step({.position = 1.0, .velocity = 0.0, .effort = slow, .driven = true}).is_alarm());
  }
}

TEST_F(Holding, ANumberThatIsNoneIsAnAlarm) {
  watch_.stand();
  move_on(0.0, 1);
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(
      watch_.step({.position = none, .velocity = 0.0, .effort = 0.0, .driven = true}).is_alarm());
}

TEST_F(Holding, StandingAgainBeginsAnew) {
  watch_.stand();
  move_on(0.0, 1);
  watch_.stand();
  EXPECT_EQ(move_on(0.4, 100).verdict, Verdict::kMoved) << "it was to stand already";
  watch_.move();
  watch_.stand();
  EXPECT_EQ(move_on(0.0, 1).verdict, Verdict::kStands);
}

TEST_F(Holding, AConfigurationThatCannotBeIsNamed) {
  auto wrong = config();
  wrong.max_motion = 0.0;
  wrong.sinking_velocity = 1.0;
  const auto made = HoldingWatch::make(wrong);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error(), HasSubstr("max_motion"));
  EXPECT_THAT(made.error(), HasSubstr("sinking_velocity is 1, expected at most max_velocity"));
}

}  // namespace
}  // namespace armature::control
