// SPDX-License-Identifier: Apache-2.0
// The rover's chassis as its deployments make it: what it does with speeds, and when there are
// none.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/rover/numbers.hpp"
#include "tests/rover/rover.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;
using component::State;
using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Chassis, UnarmedNothingMovesWhateverItIsTold) {
  for (const char* file : {ROVER "/deployments/by_script.yaml", TESTS "/ports.yaml"}) {
    Robot robot(file);
    robot.start();
    for (int k = 0; k < 20; ++k) {
      EXPECT_THAT(robot.set_velocity(0.5F, 0.5F), HasSubstr("not armed: call Arming.arm first"));
      robot.run_for(100ms);
    }
    EXPECT_NEAR(robot.plant().place().x, kBeginX, 0.002);
    EXPECT_FALSE(robot.plant().is_on(0));
    EXPECT_FALSE(robot.plant().is_on(1));
  }
}

TEST(Chassis, DrivesACurveAsItsWheelsSay) {
  Robot robot(by_script());
  robot.start_armed();
  robot.drive(0.3F, 0.4F, 4s);
  const double heading = robot.plant().place().heading;
  EXPECT_NEAR(heading, 0.1 / kTrack * 4.0, 0.1);
  const double x = robot.value<double>("Chassis.Drive", "X");
  const double y = robot.value<double>("Chassis.Drive", "Y");
  EXPECT_NEAR(robot.plant().place().x - kBeginX, x, 0.02 * std::hypot(x, y));
  EXPECT_NEAR(robot.plant().place().y, y, 0.02 * std::hypot(x, y));
  EXPECT_NEAR(robot.value<double>("Chassis.Drive", "Heading"), heading, 0.03);
  EXPECT_NEAR(robot.speed(0), 0.3, 0.01);
  EXPECT_NEAR(robot.speed(1), 0.4, 0.01);
}

TEST(Chassis, WithFourWheelsIsUsedAlike) {
  Robot robot(by_script(), {"wheels=4"});
  robot.start_armed();
  robot.drive(0.3F, 0.4F, 4s);
  EXPECT_GT(robot.plant().place().heading, 0.6) << "less than with two: its wheels scrub";
  EXPECT_NEAR(robot.speed(0), 0.3, 0.02);
  EXPECT_NEAR(robot.speed(1), 0.4, 0.02);
  EXPECT_NEAR(robot.speed(2), 0.3, 0.02);
  EXPECT_NEAR(robot.speed(3), 0.4, 0.02);
  robot.run_for(1s);
  EXPECT_TRUE(robot.rests());
}

TEST(Chassis, TurnsOnTheSpot) {
  Robot robot(by_script());
  robot.start_armed();
  robot.drive(-0.15F, 0.15F, 2s);
  robot.run_for(1s);
  EXPECT_NEAR(robot.plant().place().heading, 2.0, 0.15);
  EXPECT_NEAR(robot.plant().place().x, kBeginX, 0.02);
}

TEST(Chassis, ASpeedThatIsNotRenewedEndsInASmoothStopInOneSecond) {
  Robot robot(by_script());
  robot.start_armed();
  robot.drive(0.6F, 0.6F, 2s);
  robot.run_for(80ms);  // 180 ms since the last command
  EXPECT_NEAR(robot.speed(0), 0.6, 0.02);
  robot.run_for(320ms);  // 300 ms later than the end of its validity
  EXPECT_NEAR(robot.speed(0), 0.4, 0.06);
  EXPECT_THAT(robot.stop_reason(), HasSubstr("was not renewed for 200 ms"));
  robot.run_for(600ms);
  EXPECT_TRUE(robot.rests());
  EXPECT_TRUE(robot.value<bool>("Arming", "armed")) << "a speed that comes is followed again";
  robot.drive(0.2F, 0.2F, 1s);
  EXPECT_NEAR(robot.speed(0), 0.2, 0.02);
}

TEST(Chassis, PortsThatAreSilentEndInTheSameStop) {
  Robot robot(TESTS "/ports.yaml", {"Left.Value=0.6", "Right.Value=0.6"});
  robot.start_armed();
  robot.run_for(1500ms);
  EXPECT_NEAR(robot.speed(0), 0.6, 0.02);
  ASSERT_TRUE(robot.application().stop_component("Left"));
  ASSERT_TRUE(robot.application().stop_component("Right"));
  robot.run_for(150ms);
  EXPECT_NEAR(robot.speed(1), 0.6, 0.02);
  robot.run_for(870ms);
  EXPECT_TRUE(robot.rests());
  EXPECT_THAT(robot.stop_reason(), HasSubstr("was not renewed for 200 ms"));
}

TEST(Chassis, OneSilentPortIsEnough) {
  Robot robot(TESTS "/ports.yaml");
  robot.start_armed();
  robot.run_for(1s);
  ASSERT_TRUE(robot.application().stop_component("Right"));
  robot.run_for(1s);
  EXPECT_TRUE(robot.rests());
}

TEST(Chassis, ANumberThatIsNoneEndsInASmoothStopAndIsNamed) {
  Robot robot(by_script());
  robot.start_armed();
  robot.drive(0.4F, 0.4F, 1s);
  EXPECT_THAT(robot.set_velocity(0.1F, kNan), HasSubstr("right is nan, expected a number"));
  robot.run_for(100ms);
  EXPECT_LT(robot.speed(0), 0.38);
  EXPECT_GT(robot.speed(0), 0.2);
  EXPECT_EQ(robot.stop_reason(), "right is nan, expected a number");
  robot.run_for(500ms);
  EXPECT_TRUE(robot.rests());
}

TEST(Chassis, ANumberThatIsNoneOnAPortIsNamed) {
  Robot robot(TESTS "/ports.yaml");
  robot.start_armed();
  robot.run_for(1s);
  ASSERT_TRUE(robot.application().stop_component("Left"));
  robot.set("Left", "Value", types::Value::of(std::nan("")));
  ASSERT_TRUE(robot.application().start_component("Left"));
  robot.run_for(600ms);
  EXPECT_TRUE(robot.rests());
  EXPECT_EQ(robot.stop_reason(), "VelocityLeft is nan, expected a number");
}

TEST(Chassis, SpeedsAboveTheTopSpeedAreLoweredTogether) {
  Robot robot(by_script());
  robot.start_armed();
  robot.drive(1.0F, 2.0F, 1s);
  EXPECT_NEAR(robot.speed(0), 0.3, 0.02);
  EXPECT_NEAR(robot.speed(1), 0.6, 0.02);
}

TEST(Chassis, ComesToRestWhenArmingStopsItsMotions) {
  Robot robot(by_script());
  robot.start_armed();
  robot.drive(0.4F, 0.4F, 1s);
  ASSERT_TRUE(robot.application().call("Arming", "stop", {}));
  robot.run_for(550ms);
  EXPECT_TRUE(robot.rests());
  EXPECT_EQ(robot.stop_reason(), "Arming.stop was called");
  EXPECT_TRUE(robot.value<bool>("Arming", "armed"));
}

TEST(Chassis, DisarmedItRestsUntilItIsArmedAgain) {
  Robot robot(by_script());
  robot.start_armed();
  robot.drive(0.5F, 0.5F, 1s);
  ASSERT_TRUE(robot.application().call("Arming", "disarm", {}));
  robot.run_for(600ms);
  EXPECT_TRUE(robot.rests());
  EXPECT_THAT(robot.stop_reason(), HasSubstr("is disarmed"));
  for (int k = 0; k < 10; ++k) {
    EXPECT_THAT(robot.set_velocity(0.5F, 0.5F), HasSubstr("not armed"));
    robot.run_for(100ms);
  }
  EXPECT_TRUE(robot.rests());
  robot.arm();
  EXPECT_TRUE(robot.rests()) << "what was wanted before does not count";
  robot.drive(0.3F, 0.3F, 1s);
  EXPECT_NEAR(robot.speed(0), 0.3, 0.02);
}

// --- what breaks -----------------------------------------------------------------------------

struct Broken : public ::testing::TestWithParam<const char*> {
  Broken() : robot(by_script(), {std::string("wheels=") + GetParam()}) {
    robot.start_armed();
    robot.drive(0.6F, 0.6F, 1s);
  }
  void expect_all_rest() {
    EXPECT_TRUE(robot.rests());
    for (std::size_t i = 0; i < robot.plant().wheels(); ++i) EXPECT_FALSE(robot.plant().is_on(i));
    EXPECT_NE(robot.set_velocity(0.5F, 0.5F), "");
    robot.run_for(1s);
    EXPECT_TRUE(robot.rests());
  }

  Robot robot;
};

TEST_P(Broken, AnEncoderThatDoesNotAnswerStopsAllWheelsAndIsNamed) {
  robot.set("Rover", "SilentEncoder", types::Value::of(1));
  robot.run_for(60ms);
  EXPECT_EQ(robot.state("Chassis.Drive"), State::kException);
  EXPECT_EQ(robot.reason("Chassis.Drive"),
            "wheel 1 (Chassis.Joint1) has failed: its encoder does not answer");
  EXPECT_EQ(robot.stop_reason(), robot.reason("Chassis.Drive"));
  robot.run_for(540ms);
  expect_all_rest();
}

/// Of four wheels the others carry it along, so that it is no more than a brake.
TEST(BrokenMotor, StopsBothWheelsAndIsNamed) {
  Robot robot(by_script());
  robot.start_armed();
  robot.drive(0.6F, 0.6F, 1s);
  robot.set("Rover", "DeadMotor", types::Value::of(2));
  for (int k = 0; k < 10 && robot.state("Chassis.Drive") == State::kRunning; ++k) {
    robot.set_velocity(0.6F, 0.6F);
    robot.run_for(100ms);
  }
  EXPECT_THAT(robot.reason("Chassis.Drive"), HasSubstr("wheel 2 (Chassis.Joint2) has failed: it is "
                                                       "to roll with "));
  robot.run_for(1s);
  EXPECT_FALSE(robot.plant().is_on(0));
  EXPECT_FALSE(robot.plant().is_on(1));
  EXPECT_LT(std::abs(robot.speed(0)), 0.01);
}

TEST_P(Broken, WheelsWhoseChassisIsGoneStopTogether) {
  ASSERT_TRUE(robot.application().stop_component("Chassis.Drive"));
  robot.run_for(110ms);
  for (std::size_t i = 0; i < robot.plant().wheels(); ++i) EXPECT_FALSE(robot.plant().is_on(i));
  robot.run_for(500ms);
  EXPECT_TRUE(robot.rests());
}

TEST_P(Broken, ADriveThatStopsByItselfTakesTheOthersAlong) {
  robot.plant().switch_off(1, robot.application().now());
  robot.run_for(30ms);
  EXPECT_EQ(robot.reason("Chassis.Wheel2"),
            "the drive stopped by itself: no effort came for 100 ms");
  robot.run_for(600ms);
  expect_all_rest();
  EXPECT_FALSE(robot.value<bool>("Arming", "armed"));
}

TEST_P(Broken, RecoveredItRestsUntilTheOperatorArms) {
  robot.set("Rover", "SilentEncoder", types::Value::of(1));
  robot.run_for(1s);
  robot.set("Rover", "SilentEncoder", types::Value::of(0));
  for (int number = 1; number <= static_cast<int>(robot.plant().wheels()); ++number) {
    for (const char* part : {"Chassis.Wheel", "Chassis.Joint", "Chassis.PID"}) {
      static_cast<void>(robot.application().start_component(part + std::to_string(number)));
    }
  }
  ASSERT_TRUE(robot.application().reset_component("Chassis.Drive"));
  ASSERT_TRUE(robot.application().start_component("Chassis.Drive"));
  ASSERT_TRUE(robot.application().start_component("Arming"));
  robot.run_for(200ms);
  EXPECT_THAT(robot.set_velocity(0.5F, 0.5F), HasSubstr("not armed"));
  robot.run_for(500ms);
  EXPECT_TRUE(robot.rests());
  robot.arm();
  robot.drive(0.3F, 0.3F, 1s);
  EXPECT_NEAR(robot.speed(0), 0.3, 0.02);
}

TEST_P(Broken, AWheelThatStopsTakesTheOthersAlong) {
  ASSERT_TRUE(robot.application().stop_component("Chassis.Wheel2"));
  robot.run_for(50ms);
  EXPECT_EQ(robot.reason("Chassis.Drive"),
            "wheel 2 (Chassis.Joint2) has failed: its encoder does not answer");
  robot.run_for(600ms);
  EXPECT_TRUE(robot.rests());
  EXPECT_FALSE(robot.value<bool>("Arming", "armed"));
}

INSTANTIATE_TEST_SUITE_P(Chassis, Broken, ::testing::Values("2", "4"));

// --- the whole body --------------------------------------------------------------------------

TEST(RoverBody, TwentyImagesASecondAndTwiceTheSameToTheBit) {
  std::vector<std::uint8_t> first;
  double x = 0.0;
  for (int run = 0; run < 2; ++run) {
    Robot robot(by_script());
    robot.start_armed();
    const int before = robot.value<int>("Camera", "images");
    robot.drive(0.2F, 0.35F, 2s);
    EXPECT_EQ(robot.value<int>("Camera", "images") - before, 40);
    const auto image = robot.value<std::vector<std::uint8_t>>("Camera", "Image");
    ASSERT_EQ(image.size(), 320U * 240U * 3U);
    if (run == 0) {
      first = image;
      x = robot.plant().place().x;
    } else {
      EXPECT_EQ(image, first);
      EXPECT_EQ(robot.plant().place().x, x);
    }
  }
}

TEST(RoverBody, BreaksNoRuleOfRealTime) {
  Robot robot(by_script());
  robot.start_armed();
  robot.drive(0.3F, 0.3F, 1s);
  const testing::RealtimeGuard guard;
  robot.run_for(500ms);
  robot.set("Rover", "SilentEncoder", types::Value::of(1));
  robot.run_for(500ms);
  EXPECT_EQ(guard.violations(), 0U) << guard.report();
}

TEST(RoverBody, GainsThatWouldShakeAWheelAreRefused) {
  const auto wild = Robot::load(by_script(), {"Chassis.PID1.Kp=20"});
  EXPECT_THAT(wild.diagnostics.to_text(), HasSubstr("Chassis.Joint1: shakes at "));
}

TEST(RoverBody, ATopSpeedThatItsJointsWouldCutIsRefusedAtCheckAndAtRunTime) {
  const auto fast = Robot::load(by_script(), {"Chassis.Drive.MaxSpeed=1.2 m/s"});
  EXPECT_THAT(fast.diagnostics.to_text(),
              HasSubstr("'Chassis.Drive': MaxSpeed is 1.2 m/s, which Chassis.Joint1 makes with 24 "
                        "rad/s, expected at most its MaxVelocity of 20 rad/s"));
  Robot robot(by_script());
  robot.start_armed();
  EXPECT_FALSE(
      robot.application().set_property("Chassis.Drive", "MaxSpeed", types::Value::of(1.2)));
  EXPECT_TRUE(robot.application().set_property("Chassis.Drive", "MaxSpeed", types::Value::of(0.4)));
  robot.drive(0.6F, 0.6F, 1s);
  EXPECT_NEAR(robot.speed(0), 0.4, 0.02);
}

}  // namespace
}  // namespace armature::rover
