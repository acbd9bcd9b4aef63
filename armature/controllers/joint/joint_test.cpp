// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/joint/joint.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/controllers/internal/test_joint.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using component::State;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(JointTest, ReadsItsHardwareAtSample) {
  start();
  joint.advance(10ms);
  joint.raise("Sample");
  EXPECT_THAT(calls, ElementsAre("sensorRead"));
}

TEST_F(JointTest, SensorReadReturnsTheDisplacementOfTheJoint) {
  joint.set("SensorSign", -1.0);
  start();
  on_read = [this] { joint.write("DisplacementSensor", -20.0); };
  EXPECT_DOUBLE_EQ(joint.call<double>("sensorRead").value(), 0.2);
  on_read = nullptr;
  EXPECT_TRUE(std::isnan(joint.call<double>("sensorRead").value())) << "nothing was measured";
}

TEST_F(JointTest, HasBrakeOperationsOnlyWithABrake) {
  start();
  EXPECT_TRUE(joint.call<bool>("brakeApply"));
  joint.stop();
  joint.set("Brake", false);
  start();
  const auto answer = joint.call<bool>("brakeApply");
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error(), "'Joint1' has no operation 'brakeApply': its property Brake is false");
  EXPECT_TRUE(joint.call<bool>("motorOff")) << "whoever wants it off has this";
}

TEST_F(JointTest, SignsMayBeSaidAsBooleansOfWhichTrueInverts) {
  for (component::PropertyBase* each : component::interface_of(joint.component()).properties) {
    if (each->name() == "SensorSign") static_cast<void>(each->set(types::Value::of(true)));
    if (each->name() == "ActuatorSign") static_cast<void>(each->set(types::Value::of(false)));
  }
  EXPECT_EQ(joint.get<double>("SensorSign"), -1.0);
  EXPECT_EQ(joint.get<double>("ActuatorSign"), 1.0);
  start();
  sample(-20.0);
  EXPECT_DOUBLE_EQ(joint.output<double>("Displacement"), 0.2);
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

TEST_F(JointTest, AStartWithAnotherLimitDoesNotLoseThePosition) {
  start();
  sample(20.0);
  joint.stop();
  joint.set("MaxVoltage", 11.0);
  start();
  EXPECT_DOUBLE_EQ(position(), 1.2);
}

TEST_F(JointTest, AnInitialPositionThatIsGivenMeanwhileCounts) {
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

/// Without Act, and through the same limiter.
TEST_F(JointTest, MotorSetAppliesAVoltageAtOnceInTheDirectionOfTheHardware) {
  joint.set("ActuatorSign", -1.0);
  start_armed();
  EXPECT_TRUE(joint.call<bool>("motorSet", 3.0).value());
  EXPECT_EQ(effort(), -3.0);
  EXPECT_FALSE(joint.call<bool>("motorSet", 20.0).value()) << "more than MaxVoltage";
  EXPECT_EQ(effort(), -12.0);
}

TEST_F(JointTest, AVoltageFromBeforeTheStartIsNotApplied) {
  start();
  act(5.0);
  joint.stop();
  sample();
  start();
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

TEST_F(JointTest, WithAnEndItIsDrivenNoFarther) {
  start_armed();
  sample(400.0);  // at 5 rad, beyond PositionMax
  sample();
  EXPECT_EQ(act(1.0), 0.0);
}

TEST_F(JointTest, ThatIsContinuousIsDrivenOnWithoutEnd) {
  joint.set("Continuous", true);
  start_armed();
  for (int period = 0; period < 700; ++period) {
    act(0.1);
    sample(0.9);
  }
  EXPECT_GT(position(), 7.0);  // PositionMax is 4.5
  EXPECT_EQ(act(1.0), 1.0);
  EXPECT_EQ(act(-1.0), -1.0);
}

TEST(UnconnectedJoint, IsRefusedAtStartUnlessItFollowsNoSampler) {
  testing::Harness joint{std::make_unique<Joint>("Joint1")};
  joint.set("PeerName", "Card");
  joint.set("PositionMax", 1.0);
  joint.set("MaxVelocity", 1.0);
  joint.set("MaxAcceleration", 5.0);
  joint.set("MaxVoltage", 12.0);
  EXPECT_THAT(std::string(joint.start().reason()), HasSubstr("set Period"));
  joint.set("Period", 0.01);
  EXPECT_THAT(std::string(joint.start().reason()), HasSubstr("input Voltage has no writer"));
  joint.set("Sampler", false);
  EXPECT_TRUE(joint.start()) << joint.reason();
}

}  // namespace
}  // namespace armature::controllers
