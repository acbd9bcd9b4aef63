// SPDX-License-Identifier: Apache-2.0
#include "armature/library/joint/joint.hpp"

#include <chrono>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::library {
namespace {

using namespace std::chrono_literals;
using component::State;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class JointTest : public ::testing::Test {
 protected:
  JointTest() {
    calls.reserve(1000);  // the hardware is called in real time
    joint.set("PeerName", "Card");
    joint.set("Brake", true);
    joint.set("GearRatio", 0.01);
    joint.set("InitialPos", 1.0);
    joint.set("PositionMin", -0.5);
    joint.set("PositionMax", 4.5);
    joint.set("MaxVelocity", 1.0);
    joint.set("MaxAcceleration", 5.0);
    joint.set("MaxVoltage", 12.0);
    joint.set("Period", 0.01);
    joint.set("ArmingTime", 0.0);
    for (const char* name : {"actuatorOn", "actuatorOff", "brakeApply", "brakeRelease"}) {
      joint.serve<bool()>(name, [this, name] {
        calls.emplace_back(name);
        return calls.back() != broken;
      });
    }
    joint.write("Voltage", 0.0);  // connects it; before the start, so that it does not count
    joint.serve<bool()>("sensorRead", [this] {
      calls.emplace_back("sensorRead");
      return true;
    });
  }
  /// A sampling period in which the motor's axis moved.
  void sample(double of_motor = 0.0) {
    joint.advance(10ms);
    joint.raise("Sample");
    joint.write("DisplacementSensor", of_motor);
  }
  void start() {
    ASSERT_TRUE(joint.start()) << joint.reason();
    sample();
    calls.clear();
  }
  void start_armed() {
    start();
    joint.raise("Arm");
    ASSERT_TRUE(armed());
    calls.clear();
  }
  /// What the hardware gets of `voltage`.
  double act(double voltage) {
    joint.write("Voltage", voltage);
    joint.raise("Act");
    return effort();
  }
  double effort() { return joint.output<control::LimitedEffort>("VoltageActuator"); }
  bool armed() { return joint.output<bool>("Armed"); }
  double position() { return joint.output<double>("Position"); }

  std::vector<std::string_view> calls;
  std::string_view broken;
  testing::Harness joint{std::make_unique<Joint>("Joint1")};  // last: it stops its hardware
};

TEST_F(JointTest, ReadsItsHardwareAtSample) {
  start();
  joint.raise("Sample");
  EXPECT_THAT(calls, ElementsAre("sensorRead"));
}

TEST_F(JointTest, PositionIsTheInitialOneAndAllDisplacementsInTheUnitsOfTheJoint) {
  joint.set("SensorSign", -1.0);
  start();
  sample(-20.0);
  EXPECT_DOUBLE_EQ(joint.output<double>("Displacement"), 0.2);
  EXPECT_DOUBLE_EQ(position(), 1.2);
  sample(5.0);
  EXPECT_DOUBLE_EQ(joint.output<double>("Displacement"), -0.05);
  EXPECT_DOUBLE_EQ(position(), 1.15);
}

TEST_F(JointTest, AStartDoesNotLoseThePosition) {
  start();
  sample(20.0);
  joint.stop();
  start();
  EXPECT_DOUBLE_EQ(position(), 1.2);
}

TEST_F(JointTest, ANewInitialPositionHoldsFromTheNextStart) {
  start();
  sample(20.0);
  joint.stop();
  joint.set("InitialPos", 2.0);
  start();
  EXPECT_DOUBLE_EQ(position(), 2.0);
}

TEST_F(JointTest, HandsTheIndexOn) {
  start();
  joint.write("IndexSensor", true);
  EXPECT_TRUE(joint.output<bool>("Index"));
}

TEST_F(JointTest, AppliesVoltageAtActInTheDirectionOfTheHardware) {
  joint.set("ActuatorSign", -1.0);
  start_armed();
  joint.write("Voltage", 3.0);
  EXPECT_EQ(effort(), 0.0) << "before Act";
  joint.raise("Act");
  EXPECT_EQ(effort(), -3.0);
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
  EXPECT_FALSE(joint.call<bool>("brakeRelease").value());
  EXPECT_EQ(effort(), 0.0);
  EXPECT_THAT(calls, ElementsAre());
}

TEST_F(JointTest, ArmingSwitchesOnThenReleasesTheBrake) {
  start();
  joint.raise("Arm");
  EXPECT_THAT(calls, ElementsAre("actuatorOn", "brakeRelease"));
  EXPECT_TRUE(armed());
  EXPECT_EQ(act(5.0), 5.0);
}

TEST_F(JointTest, WithoutABrakeNobodyAsksForOne) {
  joint.set("Brake", false);
  start();
  joint.raise("Arm");
  joint.raise("Disarm");
  EXPECT_THAT(calls, ElementsAre("actuatorOn", "actuatorOff"));
  EXPECT_FALSE(joint.call<bool>("brakeApply").value());
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
    EXPECT_FALSE(armed()) << what;
    EXPECT_EQ(act(5.0), 0.0) << what;
    EXPECT_EQ(calls.back(), "actuatorOff") << what;
    joint.stop();
  }
}

TEST_F(JointTest, AfterArmingTheVoltageGrowsSlowly) {
  joint.set("ArmingTime", 1.0);
  start_armed();
  EXPECT_NEAR(act(12.0), 0.12, 1e-9);
  EXPECT_NEAR(act(12.0), 0.24, 1e-9);
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
    joint.raise("Arm");
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

TEST_F(JointTest, AVoltageFromBeforeTheStartIsNotApplied) {
  start();
  act(5.0);
  joint.stop();
  sample();
  start_armed();
  const auto before = joint.writes("VoltageActuator");
  joint.raise("Act");
  EXPECT_EQ(joint.writes("VoltageActuator"), before);
}

TEST_F(JointTest, DrivesNothingOnThatCouldNotStopBeforeItsLimit) {
  start_armed();
  sample(345.0);  // at 4.45 rad
  sample(0.5);    // at 0.5 rad/s: 0.025 rad to stop
  EXPECT_EQ(act(5.0), 5.0);
  sample(2.5);  // at 4.48 rad with 2.5 rad/s
  EXPECT_EQ(act(5.0), 0.0);
  EXPECT_EQ(act(-5.0), -5.0) << "braking";
  EXPECT_EQ(joint.get<int>("clipped"), 1);
}

TEST_F(JointTest, AVoltageThatIsNoNumberIsAFaultWithEffortZero) {
  start_armed();
  act(5.0);
  EXPECT_EQ(act(std::numeric_limits<double>::quiet_NaN()), 0.0);
  EXPECT_EQ(joint.state(), State::kException);
  EXPECT_THAT(joint.reason(), HasSubstr("Voltage is nan at the position 1"));
  EXPECT_FALSE(armed());
  EXPECT_THAT(calls, ElementsAre("brakeApply", "actuatorOff"));
}

TEST_F(JointTest, RefusesToStartWithWhatCannotBe) {
  joint.set("ActuatorSign", 2.0);
  EXPECT_THAT(std::string(joint.start().reason()), HasSubstr("1 or -1"));
  joint.set("ActuatorSign", 1.0);
  joint.set("GearRatio", 0.0);
  EXPECT_THAT(std::string(joint.start().reason()), HasSubstr("GearRatio"));
  joint.set("GearRatio", 0.01);
  joint.set("PositionMax", -1.0);
  EXPECT_THAT(std::string(joint.start().reason()), HasSubstr("upper"));
}

TEST(UnconnectedJoint, IsRefusedAtStartUnlessItFollowsNoSampler) {
  testing::Harness joint{std::make_unique<Joint>("Joint1")};
  joint.set("PeerName", "Card");
  joint.set("PositionMax", 1.0);
  joint.set("MaxVelocity", 1.0);
  joint.set("MaxAcceleration", 5.0);
  joint.set("MaxVoltage", 12.0);
  EXPECT_THAT(std::string(joint.start().reason()), HasSubstr("nobody writes the input Voltage"));
  joint.set("Sampler", false);
  EXPECT_TRUE(joint.start()) << joint.reason();
}

TEST_F(JointTest, NoToolCanMakeWhatItsHardwareTakes) {
  const types::Type& type = types::type_of<control::LimitedEffort>();
  EXPECT_TRUE(type.sealed);
  EXPECT_FALSE(types::same_type(type, types::type_of<double>()));
}

}  // namespace
}  // namespace armature::library
