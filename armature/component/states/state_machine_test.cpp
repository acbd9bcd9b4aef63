// SPDX-License-Identifier: Apache-2.0
// Which transition is taken, and what is left, done and entered in which order.
#include "armature/component/states/state_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/component/internal/test_chassis.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;

TEST_F(Machine, StartingEntersTheInitialStateAndStoppingLeavesEverything) {
  Chassis other("other");
  thread_.add(other);
  EXPECT_EQ(other.mode.path(), "");
  EXPECT_EQ(other.mode.current(), kNoState);
  start(other);
  EXPECT_EQ(other.mode.path(), "Idle");
  EXPECT_THAT(other.take_log(), ElementsAre("+Idle"));
  ASSERT_EQ(other.drive.raise(), TriggerStatus::kTaken);
  other.log.clear();
  Host::stop(other);
  EXPECT_THAT(other.take_log(), ElementsAre("-Accelerating", "-Moving"));
  EXPECT_EQ(other.mode.path(), "");
}

TEST_F(Machine, ATransitionLeavesInnerFirstActsAndEntersOuterFirst) {
  EXPECT_EQ(chassis_.drive.raise(), TriggerStatus::kTaken);
  EXPECT_EQ(path(), "Moving/Accelerating");
  EXPECT_THAT(chassis_.take_log(), ElementsAre("-Idle", "release", "+Moving", "+Accelerating"));
  EXPECT_EQ(chassis_.halt.raise(), TriggerStatus::kTaken);
  EXPECT_THAT(chassis_.take_log(), ElementsAre("-Accelerating", "-Moving", "+Idle"));
}

TEST_F(Machine, ATransitionBetweenSiblingsDoesNotLeaveTheirParent) {
  chassis_.drive.raise();
  chassis_.log.clear();
  chassis_.fast = true;
  EXPECT_THAT(step(), ElementsAre("-Accelerating", "+Cruising", "Moving", "update"));
  EXPECT_EQ(path(), "Moving/Cruising");
}

TEST_F(Machine, ATransitionMayEnterAStateDeepInside) {
  chassis_.drive.raise();
  chassis_.bumped.raise();
  EXPECT_EQ(path(), "Broken");
  chassis_.log.clear();
  chassis_.repair.raise();
  EXPECT_THAT(chassis_.take_log(), ElementsAre("+Moving", "+Cruising"));
}

TEST_F(Machine, InnerTransitionsComeBeforeOuterOnes) {
  chassis_.drive.raise();
  chassis_.log.clear();
  EXPECT_EQ(chassis_.ping.raise(), TriggerStatus::kTaken);
  EXPECT_THAT(chassis_.take_log(), ElementsAre("pong"));
  chassis_.fast = true;
  step();
  EXPECT_EQ(chassis_.ping.raise(), TriggerStatus::kTaken);
  EXPECT_THAT(chassis_.take_log(), ElementsAre("outer pong"));
}

TEST_F(Machine, TransitionsOfAStateAreTriedInTheirOrderAndAGuardPassesOnToTheNext) {
  chassis_.free = false;
  EXPECT_EQ(chassis_.drive.raise(), TriggerStatus::kTaken);
  EXPECT_THAT(chassis_.take_log(), ElementsAre("complain")) << "no state was left";
  EXPECT_EQ(path(), "Idle");
}

TEST_F(Machine, FromAStateToItselfLeavesAndEntersIt) {
  chassis_.repair.raise();
  chassis_.drive.raise();
  chassis_.fast = true;
  step();
  EXPECT_EQ(chassis_.restart.raise(), TriggerStatus::kTaken);
  EXPECT_THAT(chassis_.take_log(), ElementsAre("-Cruising", "+Cruising"));
}

TEST_F(Machine, FromAnOuterStateToItselfBeginsAfreshInside) {
  chassis_.drive.raise();
  chassis_.log.clear();
  EXPECT_EQ(chassis_.restart.raise(), TriggerStatus::kTaken);
  EXPECT_THAT(chassis_.take_log(),
              ElementsAre("-Accelerating", "-Moving", "+Moving", "+Accelerating"));
}

TEST_F(Machine, ATriggerWithoutATransitionIsIgnoredAndCounted) {
  EXPECT_EQ(chassis_.repair.raise(), TriggerStatus::kIgnored);
  EXPECT_EQ(chassis_.mode.triggers_ignored(), 1u);
  EXPECT_EQ(chassis_.mode.transitions_taken(), 0u);
  EXPECT_THAT(chassis_.take_log(), ElementsAre());
}

TEST_F(Machine, ATriggerOfWhatDoesNotRunSaysSo) {
  Host::stop(chassis_);
  EXPECT_EQ(chassis_.drive.raise(), TriggerStatus::kNotRunning);
  chassis_.fault("for the test");
  EXPECT_EQ(chassis_.drive.raise(), TriggerStatus::kNotRunning);
  EXPECT_EQ(Trigger("unused").raise(), TriggerStatus::kNotRunning);
}

TEST_F(Machine, TheComponentsOwnEventIsATrigger) {
  chassis_.drive.raise();
  chassis_.bumped.raise();
  EXPECT_EQ(path(), "Broken");
}

TEST_F(Machine, DuringActionsRunOuterFirstBeforeTheUpdate) {
  chassis_.drive.raise();
  chassis_.log.clear();
  EXPECT_THAT(step(), ElementsAre("Moving", "Accelerating", "update"));
  EXPECT_THAT(step(), ElementsAre("Moving", "Accelerating", "update"));
}

TEST_F(Machine, AtMostOneTransitionOnTimeOrConditionIsTakenInAStep) {
  chassis_.drive.raise();
  chassis_.fast = true;
  chassis_.near = true;
  chassis_.rest = true;
  step();
  EXPECT_EQ(path(), "Moving/Cruising");
  step();
  EXPECT_EQ(path(), "Moving/Decelerating");
}

TEST_F(Machine, TimeCountsFromEnteringTheStateThatHasTheTransition) {
  thread_.cycle(100ms);
  chassis_.drive.raise();
  chassis_.fast = true;
  step(4ms);
  EXPECT_EQ(path(), "Moving/Cruising") << "entering a substate does not count";
  step(5ms);
  EXPECT_EQ(path(), "Moving/Cruising");
  step(1ms);
  EXPECT_EQ(path(), "Idle");
  chassis_.drive.raise();
  step(9ms);
  EXPECT_EQ(path(), "Moving/Cruising") << "entering it again starts afresh";
}

TEST_F(Machine, AnInnerConditionComesBeforeAnOuterTime) {
  chassis_.drive.raise();
  chassis_.fast = true;
  step(20ms);
  EXPECT_EQ(path(), "Moving/Cruising");
  step();
  EXPECT_EQ(path(), "Idle");
}

TEST_F(Machine, AFinalSubstateMakesItsParentDone) {
  chassis_.drive.raise();
  chassis_.fast = true;
  chassis_.near = true;
  chassis_.rest = true;
  step();
  step();
  chassis_.log.clear();
  EXPECT_THAT(step(), ElementsAre("-Moving", "+Idle", "update"));
  EXPECT_EQ(path(), "Idle");
}

TEST_F(Machine, GoingBackEntersWhereAStateWasLeft) {
  chassis_.drive.raise();
  chassis_.fast = true;
  step();
  chassis_.halt.raise();
  chassis_.log.clear();
  EXPECT_EQ(chassis_.resume.raise(), TriggerStatus::kTaken);
  EXPECT_EQ(path(), "Moving/Cruising");
  EXPECT_THAT(chassis_.take_log(), ElementsAre("-Idle", "+Moving", "+Cruising"));
}

TEST_F(Machine, GoingBackToWhereNothingWasEverActiveOrWhatWasDoneBeginsAfresh) {
  chassis_.resume.raise();
  EXPECT_EQ(path(), "Moving/Accelerating");
  chassis_.fast = chassis_.near = chassis_.rest = true;
  for (int i = 0; i < 3; ++i) step();
  ASSERT_EQ(path(), "Idle");
  chassis_.resume.raise();
  EXPECT_EQ(path(), "Moving/Accelerating");
}

TEST_F(Machine, ARestartForgetsWhereItWas) {
  chassis_.drive.raise();
  chassis_.fast = true;
  step();
  Host::stop(chassis_);
  ASSERT_TRUE(Host::start(chassis_));
  EXPECT_EQ(path(), "Idle");
  chassis_.resume.raise();
  EXPECT_EQ(path(), "Moving/Accelerating");
}

TEST_F(Machine, ItsStateCanBeAsked) {
  chassis_.drive.raise();
  EXPECT_TRUE(chassis_.mode.is_in("Moving"));
  EXPECT_TRUE(chassis_.mode.is_in("Moving/Accelerating"));
  EXPECT_FALSE(chassis_.mode.is_in("Moving/Acc"));
  EXPECT_FALSE(chassis_.mode.is_in("Accelerating")) << "whole paths only";
  EXPECT_FALSE(chassis_.mode.is_in("Idle"));
  EXPECT_FALSE(chassis_.mode.is_in(""));
}

TEST_F(Machine, StaysAsItIsDuringARunTimeError) {
  class Erring : public Chassis {
   public:
    using Chassis::Chassis;
    using Chassis::error;
  };
  Erring chassis("erring");
  thread_.add(chassis);
  start(chassis);
  chassis.drive.raise();
  chassis.error("for the test");
  chassis.fast = true;
  Host::update(chassis);
  EXPECT_EQ(chassis.halt.raise(), TriggerStatus::kNotRunning);
  EXPECT_EQ(chassis.mode.path(), "Moving/Accelerating");
  ASSERT_TRUE(Host::recover(chassis));
  Host::update(chassis);
  EXPECT_EQ(chassis.mode.path(), "Moving/Cruising");
}

}  // namespace
}  // namespace armature::component
