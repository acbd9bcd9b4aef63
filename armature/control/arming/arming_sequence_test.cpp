// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/arming_sequence.hpp"

#include <chrono>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using Next = ArmingSequence::Next;

class Arming : public ::testing::Test {
 protected:
  static ArmingSequence::Config config() {
    return {.max_motion = 0.01,
            .effort_tolerance = 0.2,
            .settling_time = 100ms,
            .patience = 2s,
            .watch_time = 200ms};
  }
  void begin() { sequence_.begin(1.0, now_); }
  Next step(const ArmingSequence::Measured& measured) {
    now_ += 10ms;
    return sequence_.step(measured, now_);
  }
  /// The same again, until something happens.
  Next wait(const ArmingSequence::Measured& measured, int& steps) {
    Next next = Next::kWait;
    for (steps = 0; next == Next::kWait && steps < 1000; ++steps) next = step(measured);
    return next;
  }

  ArmingSequence sequence_ = ArmingSequence::make(config()).value();
  base::Time now_ = base::Time() + 5s;
  int steps_ = 0;
};

TEST_F(Arming, LetsGoWhenTheEffortHasSettledAndIsDoneWhenTheJointWasHeldForAWhile) {
  begin();
  for (int k = 1; k <= 40; ++k) {
    ASSERT_EQ(step({1.0, 0.1 * k, false}), Next::kWait) << "it grows";
  }
  EXPECT_EQ(wait({1.0, 4.0, true}, steps_), Next::kLetGo);
  EXPECT_EQ(steps_, 10);
  EXPECT_EQ(wait({1.004, 4.0, true}, steps_), Next::kDone);
  EXPECT_EQ(steps_, 20);
  EXPECT_NEAR(sequence_.moved(), 0.004, 1e-12);
}

TEST_F(Arming, WaitsForADriveThatTakesItsTime) {
  begin();
  for (int k = 0; k < 50; ++k) {
    ASSERT_EQ(step({1.0, 4.0, true, false}), Next::kWait) << "it is not on";
  }
  EXPECT_EQ(wait({1.0, 4.0, true, true}, steps_), Next::kLetGo);
  EXPECT_EQ(steps_, 10);
  for (int k = 0; k < 50; ++k) {
    ASSERT_EQ(step({1.0, 4.0, true, false}), Next::kWait) << "its brake is not open";
  }
  EXPECT_EQ(wait({1.0, 4.0, true, true}, steps_), Next::kDone);
  EXPECT_EQ(steps_, 20) << "watched from when it is";
}

TEST_F(Arming, ADriveThatDoesNotDoWhatItWasToldFails) {
  begin();
  ASSERT_EQ(wait({1.0, 4.0, true, true}, steps_), Next::kLetGo);
  EXPECT_EQ(wait({1.0, 4.0, true, false}, steps_), Next::kNotDriven);
  EXPECT_EQ(steps_, 200) << "the patience";
  begin();
  EXPECT_EQ(wait({1.0, 4.0, true, false}, steps_), Next::kNeverSettled);
}

TEST_F(Arming, AJointThatMovesBeforeItsDriveIsOnFails) {
  begin();
  ASSERT_EQ(wait({1.0, 4.0, true, true}, steps_), Next::kLetGo);
  EXPECT_EQ(step({1.02, 4.0, true, false}), Next::kNotHeld);
}

TEST_F(Arming, AnEffortOfBeforeIsNotTakenForTheOneThatHolds) {
  begin();
  ASSERT_EQ(step({1.0, 12.0, true}), Next::kWait);
  ASSERT_EQ(step({1.0, 12.0, true}), Next::kWait);
  EXPECT_EQ(wait({1.0, 0.5, true}, steps_), Next::kLetGo);
  EXPECT_EQ(steps_, 11) << "counted from the change";
}

TEST_F(Arming, AJointThatFallsIsSeenBeforeTheWatchIsOver) {
  begin();
  ASSERT_EQ(wait({1.0, 0.0, true}, steps_), Next::kLetGo);
  EXPECT_EQ(step({1.002, 0.5, true}), Next::kWait);
  EXPECT_EQ(step({1.012, 2.0, true}), Next::kNotHeld);
  EXPECT_NEAR(sequence_.moved(), 0.012, 1e-12);
}

TEST_F(Arming, AJointThatMovesAgainstItsBrakeIsNotLetGo) {
  begin();
  EXPECT_EQ(step({1.011, 0.0, true}), Next::kMovedBefore);
  begin();
  EXPECT_EQ(step({std::numeric_limits<double>::quiet_NaN(), 0.0, true}), Next::kMovedBefore);
}

TEST_F(Arming, AnEffortThatNeverSettlesEndsIt) {
  begin();
  Next next = Next::kWait;
  double effort = 0.0;
  while (next == Next::kWait) next = step({1.0, effort += 0.05, true});
  EXPECT_EQ(next, Next::kNeverSettled);
  begin();
  EXPECT_EQ(wait({1.0, 1.0, false}, steps_), Next::kNeverSettled) << "never caught up";
  EXPECT_EQ(steps_, 200);
}

TEST_F(Arming, AConfigurationThatCannotBeIsNamed) {
  auto wrong = config();
  wrong.max_motion = 0.0;
  wrong.patience = 50ms;
  const auto made = ArmingSequence::make(wrong);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error(), HasSubstr("max_motion"));
  EXPECT_THAT(made.error(), HasSubstr("more than settling_time"));
}

}  // namespace
}  // namespace armature::control
