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
  ASSERT_EQ(robot.move_to({1.0, 1.0}, 1.0), "");
  robot.run_for(3s);
  expect_off();
  EXPECT_NEAR(position(0), 0.0, 1e-6);
  EXPECT_NEAR(position(1), 0.0, 2e-3) << "the brake holds it";
}

TEST_F(Head, ArmingMovesNothingAlsoAfterAMotionThatWasNotMade) {
  robot.start();
  robot.run_for(1s);
  ASSERT_EQ(robot.move_to({1.0, 1.0}, 1.0), "");
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

TEST_F(Head, AMotionEndsWhereItShould) {
  robot.start_armed();
  ASSERT_EQ(robot.move_to({1.0, 2.0}, 2.0), "");
  robot.run_for(4s);
  EXPECT_NEAR(position(0), 1.0, 1e-3);
  EXPECT_NEAR(position(1), 2.0, 1e-3);
}

TEST_F(Head, StopIsASmoothMotionToRest) {
  robot.start_armed();
  ASSERT_EQ(robot.move_to({4.0, 4.0}, 3.0), "");
  robot.run_for(1500ms);
  ASSERT_EQ(robot.call("Arming", "stop"), "");
  Vector last{position(0), position(1)};
  Vector velocity(2, 0.0);
  double hardest = 0.0;
  for (int k = 0; k < 100; ++k) {
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

TEST_F(Head, IsDisarmedAsAWholeIfOneJointIs) {
  robot.start_armed();
  ASSERT_EQ(robot.call("Joint1", "motorOff"), "");
  robot.run_for(30ms);
  expect_off();
}

}  // namespace
}  // namespace armature::janus
