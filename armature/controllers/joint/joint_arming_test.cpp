// SPDX-License-Identifier: Apache-2.0
// What lets a joint move, what watches it while it is to stand, and what stops it.
#include <chrono>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/internal/test_joint.hpp"
#include "armature/controllers/joint/joint.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using component::State;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(JointTest, ANewInitialPositionHoldsFromTheNextStart) {
  start();
  sample(20.0);
  joint.stop();
  joint.set("InitialPos", 2.0);
  start();
  EXPECT_DOUBLE_EQ(position(), 2.0);
}

TEST_F(JointTest, IsSwitchedOffAndBrakedByAStart) {
  ASSERT_TRUE(joint.start()) << joint.reason();
  EXPECT_THAT(calls, ElementsAre("brakeApply", "actuatorOff"));
  EXPECT_FALSE(armed());
}

TEST_F(JointTest, PassesNothingBeforeItIsArmed) {
  start();
  EXPECT_EQ(act(5.0), 0.0);
  EXPECT_FALSE(joint.call<bool>("motorSet", 5.0).value());
  EXPECT_FALSE(joint.call<bool>("brakeRelease", control::DrivePermit())) << "by a tool";
  EXPECT_EQ(effort(), 0.0);
  EXPECT_THAT(calls, ElementsAre());
}

TEST_F(JointTest, ArmingSwitchesOnThenReleasesTheBrake) {
  start();
  arm();
  EXPECT_THAT(commands(), ElementsAre("actuatorOn", "brakeRelease"));
  EXPECT_TRUE(armed());
  EXPECT_EQ(act(5.0), 5.0);
}

TEST_F(JointTest, IsHeldBeforeItIsLetGo) {
  joint.set("ArmingTime", 1.0);
  start();
  joint.raise("Arm");
  double held = 0.0;
  while (commands().back() != "brakeRelease") {
    ASSERT_FALSE(armed());
    held = act(3.0);
    ASSERT_LE(held, 3.0);
    sample();
  }
  EXPECT_EQ(held, 3.0) << "when the brake opened";
  act(3.0);
  EXPECT_FALSE(armed()) << "it is watched first";
  EXPECT_EQ(act(12.0), 12.0) << "what holds it is not limited by the time since it was armed";
  for (int k = 0; k < 20; ++k) {
    act(3.0);
    sample(0.02);  // 0.2 mrad
  }
  EXPECT_TRUE(armed());
  EXPECT_NEAR(joint.get<double>("arming_moved"), 0.004, 1e-9);
}

TEST_F(JointTest, AJointThatFallsWhenItIsLetGoIsBrakedAgainAndSaysBy) {
  start();
  arm_until_let_go(0.5);
  ASSERT_EQ(commands().back(), "brakeRelease");
  act(0.5);
  sample(-0.9);
  EXPECT_EQ(commands().back(), "brakeRelease");
  sample(-0.2);  // 0.011 rad in all
  EXPECT_THAT(commands(), ElementsAre("actuatorOn", "brakeRelease", "brakeApply"));
  EXPECT_EQ(effort(), 0.0);
  EXPECT_FALSE(armed());
  EXPECT_EQ(act(5.0), 0.0);
  EXPECT_THAT(joint.log(), Contains(HasSubstr("not armed: it moved by 0.011")));
  EXPECT_THAT(joint.log(), Contains(HasSubstr("rad when its brake opened at 0.5 V")));
  sample();
  EXPECT_EQ(commands().back(), "actuatorOff") << "at rest";
}

TEST_F(JointTest, ABrakeThatDoesNotHoldIsNotOpened) {
  start();
  joint.raise("Arm");
  act(1.0);
  sample(1.5);
  EXPECT_THAT(commands(), Contains("brakeApply"));
  EXPECT_THAT(commands(), ::testing::Not(Contains("brakeRelease")));
  EXPECT_THAT(joint.log(), Contains(HasSubstr("rad against its closed brake")));
}

TEST_F(JointTest, AnEffortThatDoesNotSettleOpensNoBrake) {
  start();
  joint.raise("Arm");
  double voltage = 0.0;
  for (int k = 0; k < 250; ++k) {
    act(voltage += 0.1);
    sample();
  }
  EXPECT_THAT(commands(), ::testing::Not(Contains("brakeRelease")));
  EXPECT_EQ(commands().back(), "actuatorOff");
  EXPECT_THAT(joint.log(), Contains(HasSubstr("did not settle: 12 V of 12 V")));
}

TEST_F(JointTest, AnEffortAtItsLimitHoldsNothing) {
  start();
  arm(12.0);
  EXPECT_FALSE(armed());
  EXPECT_THAT(commands(), ::testing::Not(Contains("brakeRelease")));
}

TEST_F(JointTest, WithoutABrakeTheMotorIsSwitchedOnWithWhatHolds) {
  joint.set("Brake", false);
  joint.set("ArmingTime", 1.0);
  start();
  joint.raise("Arm");
  act(12.0);  // of a reference from before
  sample();
  while (commands().empty() || commands().back() != "actuatorOn") {
    EXPECT_EQ(act(3.0), 0.0) << "the motor is off";
    sample();
  }
  EXPECT_EQ(effort(), 3.0);
  EXPECT_NEAR(act(12.0), 3.12, 1e-9) << "grows from there";
}

TEST_F(JointTest, ToldWhyAJointDoesNotArmTheRobotIsNotArmed) {
  std::string told;
  told.reserve(200);
  joint.serve<void(const ComponentName&, const component::Reason&)>(
      "notArmed", [&told](const ComponentName& name, const component::Reason& why) {
        told.append(name.view()).append(": ").append(why.view());
      });
  ASSERT_TRUE(joint.start()) << joint.reason();
  joint.raise("Arm");
  joint.run_cycles();
  EXPECT_EQ(told, "Joint1: it was not measured in this sampling period");
}

TEST_F(JointTest, WithoutABrakeNobodyAsksForOne) {
  joint.set("Brake", false);
  start();
  arm();
  joint.raise("Disarm");
  EXPECT_THAT(commands(), ElementsAre("actuatorOn", "actuatorOff"));
  EXPECT_FALSE(joint.call<bool>("brakeApply")) << "there is no such operation";
}

TEST_F(JointTest, IsNotArmedIfItWasNotMeasuredJustBefore) {
  ASSERT_TRUE(joint.start()) << joint.reason();
  joint.raise("Arm");
  EXPECT_FALSE(armed()) << "never measured";
  sample();
  joint.advance(20ms);
  joint.raise("Arm");
  EXPECT_FALSE(armed()) << "measured two periods ago";
  EXPECT_THAT(joint.log(), Contains(HasSubstr("not armed: it was not measured")));
}

TEST_F(JointTest, IsNotArmedIfItsHardwareDoesNotSwitchOn) {
  for (const char* what : {"actuatorOn", "brakeRelease"}) {
    broken = what;
    start();
    joint.raise("Arm");
    for (int k = 0; k < 50; ++k) {
      act(0.0);
      sample();
    }
    EXPECT_FALSE(armed()) << what;
    EXPECT_EQ(act(5.0), 0.0) << what;
    EXPECT_EQ(commands().back(), "actuatorOff") << what;
    joint.stop();
  }
}

TEST_F(JointTest, IsArmedOnlyWhenItsDriveIsOnAndItsBrakeOpen) {
  bool as_told = false;
  joint.serve<bool()>("isAsTold", [&] { return as_told; });
  start();
  joint.raise("Arm");
  const auto wait = [&] {
    for (int k = 0; k < 50; ++k) {
      act(0.0);
      sample();
    }
  };
  wait();
  EXPECT_THAT(commands(), ElementsAre("actuatorOn")) << "it is not on";
  as_told = true;
  for (int k = 0; k < 50 && commands().size() < 2; ++k) {
    act(0.0);
    sample();
  }
  EXPECT_THAT(commands(), ElementsAre("actuatorOn", "brakeRelease"));
  as_told = false;
  wait();
  EXPECT_FALSE(armed()) << "its brake is not open";
  as_told = true;
  wait();
  EXPECT_TRUE(armed());
}

TEST_F(JointTest, IsNotArmedIfItsDriveNeverSwitchesOn) {
  joint.serve<bool()>("isAsTold", [] { return false; });
  start();
  arm();
  EXPECT_FALSE(armed());
  EXPECT_EQ(commands().back(), "actuatorOff");
}

TEST_F(JointTest, AfterArmingTheVoltageGrowsSlowly) {
  joint.set("ArmingTime", 1.0);
  start();
  joint.raise("Arm");
  EXPECT_NEAR(act(12.0), 0.12, 1e-9);
  EXPECT_NEAR(act(12.0), 0.24, 1e-9);
}

/// Moves to and fro.
TEST_F(JointTest, AnArmedJointThatIsToStandAndShakesIsBrakedAndFaults) {
  start_armed();
  joint.raise("Rest");
  act(1.0);
  for (int k = 0; k < 300 && joint.state() == State::kRunning; ++k) {
    joint.write("Voltage", 1.0);
    sample(k % 2 == 0 ? 0.6 : -0.6);
  }
  EXPECT_EQ(joint.state(), State::kException);
  EXPECT_THAT(joint.reason(),
              HasSubstr("should stand still but moves at 0.6 rad/s (HoldingVelocity: 0.5)"));
  EXPECT_EQ(effort(), 0.0);
  EXPECT_THAT(commands(), Contains("brakeApply"));
}

TEST_F(JointTest, AnArmedJointThatIsToStandAndCreepsAwayIsBrakedAndFaults) {
  start_armed();
  joint.raise("Rest");
  for (int k = 0; k < 40 && joint.state() == State::kRunning; ++k) {
    joint.write("Voltage", 1.0);
    sample(k == 0 ? 0.0 : 0.4);  // 4 mrad
  }
  EXPECT_EQ(joint.state(), State::kException);
  EXPECT_THAT(joint.reason(), HasSubstr("moved by 0.1 rad (HoldingMotion: 0.1)"));
}

TEST_F(JointTest, AnArmedJointWhoseVoltageAlternatesIsBrakedAndFaults) {
  start_armed();
  joint.raise("Rest");
  for (int k = 0; k < 100 && joint.state() == State::kRunning; ++k) {
    act(k % 2 == 0 ? 2.0 : -2.0);
    sample();
  }
  EXPECT_EQ(joint.state(), State::kException);
  EXPECT_THAT(joint.reason(), HasSubstr("its effort changes its sign"));
}

TEST_F(JointTest, ADisarmedJointThatSinksIsToldOnceAndDoesNotFault) {
  start_armed();
  joint.raise("Disarm");
  for (int k = 0; k < 30; ++k) {
    act(0.0);
    sample(-0.5);  // 5 mrad
  }
  EXPECT_EQ(joint.state(), State::kRunning);
  EXPECT_NEAR(joint.get<double>("sunk"), -0.15, 1e-9);
  EXPECT_THAT(joint.log(), Contains(HasSubstr("sinks: it moved by -0.1 rad")).Times(1));
}

TEST_F(JointTest, AJointThatMayMoveIsNotWatched) {
  start_armed();
  joint.raise("Rest");
  sample();
  joint.raise("Motion");
  for (int k = 0; k < 50; ++k) {
    act(k % 2 == 0 ? 2.0 : -2.0);
    sample(0.8);
  }
  EXPECT_TRUE(armed());
}

TEST_F(JointTest, WhateverDisarmsItDoesSoWithTheBrakeFirst) {
  start_armed();
  act(5.0);
  joint.raise("Disarm");
  EXPECT_EQ(effort(), 0.0);
  EXPECT_FALSE(armed());
  EXPECT_THAT(calls, ElementsAre("brakeApply", "actuatorOff"));
  for (const char* operation : {"motorOff", "brakeApply"}) {
    sample();
    arm();
    ASSERT_TRUE(armed());
    act(5.0);
    EXPECT_TRUE(joint.call<bool>(operation).value());
    EXPECT_EQ(effort(), 0.0) << operation;
    EXPECT_FALSE(armed()) << operation;
  }
}

TEST_F(JointTest, AMotorThatTurnsIsSwitchedOffWhenItRests) {
  start_armed();
  sample(1.0);  // 1 rad/s
  calls.clear();
  joint.raise("Disarm");
  EXPECT_EQ(effort(), 0.0);
  EXPECT_FALSE(armed());
  EXPECT_THAT(calls, ElementsAre("brakeApply"));
  EXPECT_EQ(act(5.0), 0.0);
  calls.clear();
  sample(0.5);
  EXPECT_THAT(calls, ElementsAre("sensorRead"));
  calls.clear();
  sample(0.01);
  EXPECT_THAT(calls, ElementsAre("sensorRead", "actuatorOff"));
}

TEST_F(JointTest, AMotorThatGoesOnTurningIsSwitchedOffAfterASecond) {
  start_armed();
  sample(1.0);
  joint.raise("Disarm");
  calls.clear();
  for (int k = 0; k < 100; ++k) {
    act(0.0);
    sample(1.0);
  }
  EXPECT_THAT(calls, ::testing::Not(Contains("actuatorOff")));
  act(0.0);
  sample(1.0);
  EXPECT_EQ(calls.back(), "actuatorOff");
}

TEST_F(JointTest, AStopDisarmsIt) {
  start_armed();
  act(5.0);
  calls.clear();
  joint.stop();
  EXPECT_EQ(effort(), 0.0);
  EXPECT_FALSE(armed());
  EXPECT_THAT(calls, ElementsAre("brakeApply", "actuatorOff"));
}

TEST_F(JointTest, OldVoltageStopsAndDisarmsIt) {
  start_armed();
  act(5.0);
  for (int k = 0; k < 12 && joint.state() == State::kRunning; ++k) sample();
  EXPECT_EQ(joint.state(), State::kStopped);
  EXPECT_EQ(effort(), 0.0);
  EXPECT_FALSE(armed());
}

TEST_F(JointTest, NoToolCanMakeWhatItsHardwareTakes) {
  const types::Type& type = types::type_of<control::LimitedEffort>();
  EXPECT_TRUE(type.sealed);
  EXPECT_FALSE(types::same_type(type, types::type_of<double>()));
  const types::Type& permit = types::type_of<control::DrivePermit>();
  EXPECT_TRUE(permit.sealed);
  EXPECT_FALSE(types::same_type(permit, types::type_of<bool>()));
}

TEST_F(JointTest, IsSwitchedOffAndBrakedByAnybodyAlsoWhileItDoesNotRun) {
  start_armed();
  joint.stop();
  for (const char* operation : {"motorOff", "brakeApply"}) {
    calls.clear();
    EXPECT_TRUE(joint.call<bool>(operation).value());
    EXPECT_THAT(calls, ElementsAre("brakeApply", "actuatorOff")) << operation;
  }
}

}  // namespace
}  // namespace armature::controllers
