// SPDX-License-Identifier: Apache-2.0
// What the head does and does not do before, at and after arming.
#include <gmock/gmock.h>

#include "tests/janus/experiment.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using component::State;
using ::testing::HasSubstr;

class Head : public ::testing::Test {
 protected:
  SimulatedJanus& janus() {
    return *static_cast<SimulatedJanus*>(robot.application().find("Cards"));
  }
  double position(std::size_t joint) { return janus().position(joint); }
  AicState card(std::size_t joint) { return janus().simulation().card(joint).state(); }
  double effort(const char* joint) {
    return robot.value<control::LimitedEffort>(joint, "VoltageActuator");
  }
  void expect_off() {
    EXPECT_NE(card(0), AicState::kOn);
    EXPECT_NE(card(1), AicState::kOn);
    EXPECT_EQ(effort("Joint1"), 0.0);
    EXPECT_EQ(effort("Joint2"), 0.0);
    EXPECT_FALSE(robot.value<bool>("Arming", "armed"));
  }

  Robot robot{"pid.yaml"};
};

TEST_F(Head, StandsStillBeforeItIsArmedWhateverItIsTold) {
  robot.start();
  robot.run_for(1s);
  EXPECT_THAT(robot.move_to({1.0, 1.0}, 1.0), HasSubstr("the robot is not armed: arm first"));
  robot.run_for(3s);
  expect_off();
  EXPECT_NEAR(position(0), 0.0, 1e-6);
  EXPECT_NEAR(position(1), 0.0, 2e-3) << "the brake holds it";
}

TEST_F(Head, ArmingMovesNothingAlsoAfterAMotionThatWasNotMade) {
  robot.start();
  robot.run_for(1s);
  EXPECT_NE(robot.move_to({1.0, 1.0}, 1.0), "") << "arm first";
  robot.run_for(2s);
  robot.arm();
  double farthest = 0.0;
  for (int k = 0; k < 200; ++k) {
    robot.run_for(10ms);
    for (std::size_t i = 0; i < kJoints; ++i) {
      farthest = std::max(farthest, std::abs(position(i)));
    }
  }
  EXPECT_LE(farthest, 0.005);
  EXPECT_EQ(card(0), AicState::kOn);
  EXPECT_EQ(card(1), AicState::kOn);
}

/// A head that is armed step by step, with one of its controllers.
struct ArmingHead {
  explicit ArmingHead(const std::string& file, std::vector<std::string> overrides = {})
      : robot(file, std::move(overrides)) {
    robot.start();
    robot.run_for(105ms);
  }
  SimulatedJanus& janus() {
    return *static_cast<SimulatedJanus*>(robot.application().find("Cards"));
  }
  AicFirmware& card() { return janus().simulation().card(1); }
  /// A cycle; how far joint 2 was at most from where it was.
  void cycle() {
    robot.run_for(10ms);
    farthest = std::max(farthest, std::abs(janus().position(1)));
  }

  Robot robot;
  double farthest = 0.0;
};

TEST(ArmingHead, WithAModelTheWeightIsHeldBeforeTheBrakeOpens) {
  ArmingHead head("pid_feed_forward.yaml");
  const auto arming = head.robot.application().begin("Arming", "arm", {}).value();
  while (!head.card().brake_released()) {
    ASSERT_FALSE(arming.ended()) << arming.reason();
    head.cycle();
  }
  EXPECT_GT(head.robot.value<control::LimitedEffort>("Joint2", "VoltageActuator"), 0.4)
      << "[V]; 0.49 V hold it where it is level";
  while (!arming.ended()) head.cycle();
  EXPECT_EQ(arming.stage(), component::CommandStage::kDone) << arming.reason();
  for (int k = 0; k < 200; ++k) head.cycle();
  EXPECT_LT(head.farthest, 1e-3);
}

TEST(ArmingHead, WithGainsThatDoNotHoldItTheBrakeClosesAgainAndTheReasonSaysWhy) {
  ArmingHead head("pid.yaml", {"PID2.Kp=5", "PID2.Ki=0", "PID2.Kd=0"});
  const auto arming = head.robot.application().begin("Arming", "arm", {}).value();
  while (!arming.ended()) head.cycle();
  EXPECT_EQ(arming.stage(), component::CommandStage::kFailed);
  EXPECT_THAT(std::string(arming.reason()), HasSubstr("Joint2 is not armed: it moved by 0.01"));
  head.cycle();  // the card is told
  EXPECT_FALSE(head.card().brake_released());
  EXPECT_LT(head.farthest, 0.03);
  for (int k = 0; k < 100; ++k) head.cycle();
  EXPECT_NE(head.card().state(), AicState::kOn);
  EXPECT_LT(head.farthest, 0.03);
  EXPECT_EQ(head.robot.application().faults(), 0u);
}

TEST_F(Head, AMotionEndsWhereItShould) {
  robot.start_armed();
  ASSERT_EQ(robot.move_to({1.0, 2.0}, 2.0), "");
  robot.run_for(4s);
  EXPECT_NEAR(position(0), 1.0, 1e-3);
  EXPECT_NEAR(position(1), 2.0, 1e-3);
}

/// sensorRead of the card, all the way to what the joint tells (paper 1, section 3.1).
TEST_F(Head, AReadingBringsDisplacementAndIndexToTheJoint) {
  robot.start_armed();
  EXPECT_TRUE(robot.value<bool>("AIC1", "IndexSensor")) << "the switch is at 0 rad";
  EXPECT_TRUE(robot.value<bool>("Joint1", "Index"));
  ASSERT_EQ(robot.move_to({1.0, 0.0}, 2.0), "");
  robot.run_for(1s);
  const double before = robot.value<double>("Joint1", "Position");
  robot.run_for(10ms);
  const double of_motor = robot.value<double>("AIC1", "DisplacementSensor");
  const double of_joint = robot.value<double>("Joint1", "Displacement");
  EXPECT_GT(of_joint, 1e-3);
  EXPECT_NEAR(of_joint, 0.01 * of_motor, 1e-12);
  EXPECT_NEAR(robot.value<double>("Joint1", "Position"), before + of_joint, 1e-12);
  EXPECT_FALSE(robot.value<bool>("Joint1", "Index"));
}

TEST_F(Head, StopIsASmoothMotionToRest) {
  robot.start_armed();
  ASSERT_EQ(robot.move_to({4.0, 4.0}, 3.0), "");
  robot.run_for(1500ms);
  ASSERT_EQ(robot.call("Arming", "stop"), "");
  Vector last{position(0), position(1)};
  Vector velocity(2, 0.0);
  double hardest = 0.0;
  for (int k = 0; k < 150; ++k) {
    robot.run_for(10ms);
    for (std::size_t i = 0; i < kJoints; ++i) {
      const double now = (position(i) - last[i]) / 0.01;
      if (k > 1) hardest = std::max(hardest, std::abs(now - velocity[i]) / 0.01);
      velocity[i] = now;
      last[i] = position(i);
    }
  }
  EXPECT_NEAR(velocity[0], 0.0, 1e-3);
  EXPECT_NEAR(velocity[1], 0.0, 1e-3);
  EXPECT_LE(hardest, 10.0) << "[rad/s^2]; the generator has 5";
  EXPECT_TRUE(robot.value<bool>("Arming", "armed"));
  ASSERT_EQ(robot.move_to({1.0, 1.0}, 3.0), "") << "and then goes on";
}

TEST_F(Head, EmergencyStopIsEffortZeroAndBrakeAtOnceAndNothingGoesOnAfterArmingAgain) {
  robot.start_armed();
  ASSERT_EQ(robot.move_to({4.0, 4.0}, 5.0), "");
  robot.run_for(2s);
  ASSERT_EQ(robot.call("Arming", "disarm"), "");
  const double speed = robot.value<double>("Joint1", "Displacement") / 0.01;
  ASSERT_GT(speed, 0.5) << "[rad/s]";
  const double there = position(0);
  robot.run_for(10ms);
  EXPECT_EQ(effort("Joint1"), 0.0);
  EXPECT_EQ(effort("Joint2"), 0.0);
  EXPECT_FALSE(robot.value<bool>("Arming", "armed"));
  robot.run_for(500ms);
  expect_off();
  EXPECT_NEAR(position(0), there, 0.1) << "the motor brakes itself, as it has no brake";
  const Vector rest{position(0), position(1)};
  robot.run_for(5s);
  EXPECT_NEAR(position(0), rest[0], 1e-6);
  EXPECT_NEAR(position(1), rest[1], 2e-3);
  robot.arm();
  robot.run_for(5s);
  EXPECT_NEAR(position(0), rest[0], 5e-3) << "the old motion is forgotten";
  EXPECT_NEAR(position(1), rest[1], 5e-3);
}

TEST_F(Head, NoToolCallsAroundTheLimiter) {
  robot.start_armed();
  EXPECT_THAT(
      robot.call("AIC1", "actuatorSet", {types::Value(types::type_of<control::LimitedEffort>())}),
      HasSubstr("takes a LimitedEffort, which only components make"));
  EXPECT_THAT(
      robot.call("Cards", "setMotor",
                 {types::Value::of(1), types::Value(types::type_of<control::LimitedEffort>())}),
      HasSubstr("takes a LimitedEffort"));
  EXPECT_THAT(robot.call("AIC1", "actuatorSet", {types::Value::of(5.0)}),
              HasSubstr("it was called with (double)"));
}

TEST_F(Head, NoToolSwitchesAMotorOnOrOpensABrake) {
  robot.start();
  robot.run_for(500ms);
  const types::Value permit(types::type_of<control::DrivePermit>());
  const auto number = types::Value::of(2);
  for (const auto& [component, operation] :
       {std::pair("AIC2", "actuatorOn"), std::pair("AIC2", "brakeRelease"),
        std::pair("Joint2", "motorOn"), std::pair("Joint2", "brakeRelease")}) {
    EXPECT_THAT(robot.call(component, operation, {permit}), HasSubstr("takes a DrivePermit"));
    EXPECT_THAT(robot.call(component, operation), HasSubstr("it was called with ()"));
  }
  for (const int command : {1, 4}) {
    EXPECT_THAT(robot.call("Cards", "energizeCard", {number, types::Value::of(command), permit}),
                HasSubstr("takes a DrivePermit"));
    static_cast<void>(robot.call("Cards", "commandCard", {number, types::Value::of(command)}));
  }
  robot.run_for(1s);
  expect_off();
  EXPECT_NEAR(position(1), 0.0, 2e-3) << "the brake holds it";
}

TEST_F(Head, AnybodySwitchesOffAndBrakesAlsoWhatDoesNotRun) {
  robot.start_armed();
  robot.application().find("AIC2")->fault("for the test");
  robot.run_for(1s);
  expect_off();
  const double there = position(1);
  for (const char* operation : {"motorOff", "brakeApply"}) {
    EXPECT_EQ(robot.call("Joint2", operation), "");
  }
  EXPECT_EQ(robot.call("Joint1", "motorOff"), "");
  EXPECT_EQ(robot.call("Joint1", "brakeApply"),
            "'Joint1' has no operation 'brakeApply': its property Brake is false");
  ASSERT_TRUE(robot.application().stop_component("AIC1"));
  for (const char* operation : {"actuatorOff", "brakeApply"}) {
    EXPECT_EQ(robot.call("AIC1", operation), "");
    EXPECT_EQ(robot.call("AIC2", operation), "") << "which has faulted";
  }
  EXPECT_EQ(robot.call("Arming", "disarm"), "");
  robot.run_for(1s);
  EXPECT_NEAR(position(1), there, 2e-3);
}

TEST_F(Head, IsDisarmedAsAWholeIfOneJointIs) {
  robot.start_armed();
  ASSERT_EQ(robot.call("Joint1", "motorOff"), "");
  robot.run_for(30ms);
  expect_off();
}

}  // namespace
}  // namespace armature::janus
