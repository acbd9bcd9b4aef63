// SPDX-License-Identifier: Apache-2.0
// An own robot whose joints hang, as a newcomer has it: the arm of examples/07_own_robot.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/base/limited_effort.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using component::State;
using ::testing::HasSubstr;

class OwnRobot {
 public:
  explicit OwnRobot(std::vector<std::string> overrides = {}) {
    deploy::DeploymentOptions options;
    options.library_folders = {ROBOT_LIBRARY, SERVO_LIBRARY};
    options.document.overrides = std::move(overrides);
    deployment_ = deploy::load_deployment(EXAMPLES "/07_own_robot/arm.yaml", options);
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
    const auto started = application_->start();
    EXPECT_TRUE(started.ok()) << started.to_text();
    run_for(105ms);
  }

  exec::Application& application() { return *application_; }
  /// Keeps an eye on the joint that carries most.
  void run_for(base::Duration duration) {
    for (base::Duration passed{}; passed < duration; passed += 5ms) {
      application_->run_for(5ms);
      farthest = std::max(farthest, std::abs(shoulder()));
    }
  }
  double shoulder() { return value<double>("Joint2", "Position"); }
  bool armed() { return value<bool>("Arming", "armed"); }
  component::CommandHandle arm() {
    auto arming = application_->begin("Arming", "arm", {}).value();
    for (int k = 0; k < 1000 && !arming.ended(); ++k) run_for(10ms);
    return arming;
  }
  template <typename T>
  T value(const char* component, const char* item) {
    const auto value = application_->value_of(component, item);
    EXPECT_TRUE(value) << value.error();
    return *static_cast<const T*>(value.value().data());
  }
  std::string call(const char* component, const char* operation,
                   std::vector<types::Value> arguments = {}) {
    const auto answer = application_->call(component, operation, std::move(arguments));
    return answer ? "" : answer.error();
  }

  double farthest = 0.0;

 private:
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

TEST(OwnRobot, IsHeldWhenItIsArmed) {
  OwnRobot robot;
  const auto arming = robot.arm();
  EXPECT_EQ(arming.stage(), CommandStage::kDone) << arming.reason();
  EXPECT_LT(robot.farthest, 0.01);
  EXPECT_GT(robot.farthest, 0.001) << "it hangs";
  robot.run_for(3s);
  EXPECT_TRUE(robot.armed());
  EXPECT_LT(robot.farthest, 0.01);
}

TEST(OwnRobot, WithUntunedGainsIsCaughtByItsBrakeAndTheReasonSaysWhatMoved) {
  for (const char* kp : {"PID2.Kp=0", "PID2.Kp=5", "PID2.Kp=60"}) {
    OwnRobot robot({kp, "PID2.Ki=0", "PID2.Kd=0"});
    const auto arming = robot.arm();
    EXPECT_EQ(arming.stage(), CommandStage::kFailed) << kp;
    EXPECT_THAT(std::string(arming.reason()), HasSubstr("Joint2 is not armed: it moved by 0.01"));
    EXPECT_THAT(std::string(arming.reason()), HasSubstr("its brake opened"));
    EXPECT_LT(robot.farthest, 0.025) << kp;
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
    EXPECT_LT(robot.farthest, 0.1) << kp;
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
  EXPECT_EQ(robot.farthest, 0.0);
}

TEST(OwnRobot, ADriveThatFaultsIsBraked) {
  OwnRobot robot;
  ASSERT_EQ(robot.arm().stage(), CommandStage::kDone);
  robot.application().find("Drive2")->fault("for the test");
  robot.run_for(100ms);
  EXPECT_FALSE(robot.armed());
  EXPECT_EQ(robot.call("Joint2", "brakeApply"), "") << "by anybody, also now";
  EXPECT_LT(robot.farthest, 0.02);
}

}  // namespace
}  // namespace armature
