// SPDX-License-Identifier: Apache-2.0
// An own robot whose joints hang, as a newcomer has it: the arm of examples/07_own_robot.
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/base/limited_effort.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/testing/deployed_robot.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using ::testing::HasSubstr;

deploy::Deployment load(std::vector<std::string> overrides) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, SERVO_LIBRARY};
  options.document.overrides = std::move(overrides);
  return deploy::load_deployment(EXAMPLES "/07_own_robot/arm.yaml", options);
}

/// After the first samples.
class OwnRobot final : public testing::DeployedRobot {
 public:
  static constexpr std::size_t kShoulder = 2;  ///< the joint that carries most

  explicit OwnRobot(std::vector<std::string> overrides = {})
      : DeployedRobot(load(std::move(overrides))) {
    EXPECT_EQ(start(), "");
    run_for(105ms);
  }
  double shoulder() { return at(kShoulder); }
  double moved() const { return farthest(kShoulder); }
};

TEST(OwnRobot, IsHeldWhenItIsArmed) {
  OwnRobot robot;
  const auto arming = robot.run("Arming", "arm");
  EXPECT_EQ(arming.stage(), CommandStage::kDone) << arming.reason();
  EXPECT_LT(robot.moved(), 0.01);
  EXPECT_GT(robot.moved(), 0.001) << "it hangs";
  robot.run_for(3s);
  EXPECT_TRUE(robot.armed());
  EXPECT_LT(robot.moved(), 0.01);
}

TEST(OwnRobot, WithUntunedGainsIsCaughtByItsBrakeAndTheReasonSaysWhatMoved) {
  for (const char* kp : {"PID2.Kp=0", "PID2.Kp=5", "PID2.Kp=60"}) {
    OwnRobot robot({kp, "PID2.Ki=0", "PID2.Kd=0"});
    const auto arming = robot.run("Arming", "arm");
    EXPECT_EQ(arming.stage(), CommandStage::kFailed) << kp;
    EXPECT_THAT(std::string(arming.reason()), HasSubstr("Joint2 is not armed: it moved by 0.01"));
    EXPECT_THAT(std::string(arming.reason()), HasSubstr("its brake opened"));
    EXPECT_LT(robot.moved(), 0.025) << kp;
    EXPECT_FALSE(robot.armed());
    const double there = robot.shoulder();
    robot.run_for(3s);
    EXPECT_NEAR(robot.shoulder(), there, 1e-9) << kp;
    EXPECT_EQ(robot.application().faults(), 0u);
  }
}

/// Of a joint that nobody describes, or the check would refuse them.
TEST(OwnRobot, WithGainsThatShakeComesToRestBraked) {
  for (const char* kp : {"PID2.Kp=1e5", "PID2.Kp=1e6", "Joint2.ActuatorSign=-1"}) {
    OwnRobot robot({kp, "Joint2.RobotJoint=0"});
    static_cast<void>(robot.arm());
    robot.run_for(3s);
    const double there = robot.shoulder();
    robot.run_for(2s);
    EXPECT_FALSE(robot.armed()) << kp;
    EXPECT_NEAR(robot.shoulder(), there, 1e-9) << kp;
    EXPECT_LT(robot.moved(), 0.1) << kp;
  }
}

TEST(OwnRobot, NoToolOpensABrakeOrSwitchesAMotorOn) {
  OwnRobot robot;
  const types::Value permit(types::type_of<control::DrivePermit>());
  for (const char* operation : {"actuatorOn", "brakeRelease"}) {
    EXPECT_THAT(robot.call("Drive2", operation), HasSubstr("it was called with ()"));
    EXPECT_THAT(robot.call("Drive2", operation, {permit}),
                HasSubstr("takes a DrivePermit, which only components make"));
  }
  robot.run_for(1s);
  EXPECT_EQ(robot.moved(), 0.0);
}

TEST(OwnRobot, ADriveThatFaultsIsBraked) {
  OwnRobot robot;
  ASSERT_EQ(robot.arm(), CommandStage::kDone);
  robot.application().find("Drive2")->fault("for the test");
  robot.run_for(100ms);
  EXPECT_FALSE(robot.armed());
  EXPECT_EQ(robot.call("Joint2", "brakeApply"), "") << "by anybody, also now";
  EXPECT_LT(robot.moved(), 0.02);
}

}  // namespace
}  // namespace armature
