// SPDX-License-Identifier: Apache-2.0
// Drives that take torques, or follow velocities or positions: the arm of examples/11_drives.
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/base/joint_hardware.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/testing/deployed_robot.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using ::testing::HasSubstr;

/// A drive that stands, and takes commands as long as the test wants it to.
class Stubborn final : public controllers::JointHardware {
 public:
  explicit Stubborn(const std::string& name)
      : JointHardware(name, {controllers::JointCommand::kPosition}, Sensor::kAbsolute) {}

  int refuses = 0;  ///< commands from now on

 private:
  bool actuator_on() override { return true; }
  bool actuator_off() override { return true; }
  bool actuator_set(control::LimitedEffort /*effort*/) override { return false; }
  bool position_set(control::LimitedPosition /*position*/) override { return --refuses < 0; }
  bool sensor_read() override {
    sensor_.write(0.0);
    return true;
  }
  bool brake_apply() override { return true; }
  bool brake_release() override { return true; }
};

deploy::Deployment load(const std::string& file, std::vector<std::string> overrides = {}) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, DRIVE_LIBRARY};
  options.document.overrides = std::move(overrides);
  return deploy::load_deployment(EXAMPLES "/11_drives/" + file, options);
}

std::string mistakes(const std::string& file, std::vector<std::string> overrides = {}) {
  return load(file, std::move(overrides)).diagnostics.to_text();
}

/// After the first samples.
class Arm final : public testing::DeployedRobot {
 public:
  explicit Arm(const std::string& file) : Arm(load(file)) {}
  explicit Arm(deploy::Deployment deployment) : DeployedRobot(std::move(deployment)) {
    EXPECT_EQ(start(), "");
    run_for(100ms);
  }
};

class EachWay : public ::testing::TestWithParam<const char*> {};

TEST_P(EachWay, TheArmIsHeldWhenItIsArmedMovesAndStops) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  EXPECT_LT(std::abs(arm.at(1)), 0.01) << "the link hangs";
  EXPECT_EQ(arm.move_to({1.0, -1.0}), CommandStage::kDone);
  arm.run_for(500ms);
  EXPECT_NEAR(arm.at(1), 1.0, 2e-3);
  EXPECT_NEAR(arm.at(2), -1.0, 2e-3);
  EXPECT_GT(arm.fastest(1), 1.3) << "max_vel is 1.5";
  EXPECT_LT(arm.fastest(1), 2.0);
  EXPECT_EQ(arm.application().faults(), 0u);
}

/// The component that makes references faults in motion: the controller brakes by itself.
TEST_P(EachWay, WithoutAReferenceTheArmIsBrakedSmoothly) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  ASSERT_EQ(arm.begin_motion_to({1.2, 0.0}), "");
  arm.run_for(500ms);
  const double there = arm.at(1);
  ASSERT_GT(there, 0.2);
  ASSERT_TRUE(arm.application().stop_component("Generator"));
  arm.run_for(1s);
  EXPECT_GT(arm.at(1), there) << "no step back";
  EXPECT_LT(arm.at(1), there + 0.5);
  const double at_rest = arm.at(1);
  arm.run_for(500ms);
  EXPECT_NEAR(arm.at(1), at_rest, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Drives, EachWay,
                         ::testing::Values("torque.yaml", "velocity.yaml", "position.yaml"),
                         [](const auto& info) {
                           const std::string file = info.param;
                           return file.substr(0, file.find('.'));
                         });

deploy::Deployment load_stubborn() {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, DRIVE_LIBRARY};
  options.models = [](component::Registry& models) {
    models.add<Stubborn>("Stubborn", "does not take commands");
  };
  return deploy::parse_deployment(R"(
include: position.yaml
components:
  Drive1: {override: true, model: Stubborn, properties: {Weight: {remove: true}}}
)",
                                  EXAMPLES "/11_drives/stubborn.yaml", options);
}

TEST(Hardware, ThatDoesNotTakeThreeCommandsInARowFaults) {
  Arm arm(load_stubborn());
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  auto& drive = *static_cast<Stubborn*>(arm.application().find("Drive1"));
  for (int round = 0; round < 10; ++round) {
    drive.refuses = 2;
    arm.run_for(50ms);
  }
  EXPECT_TRUE(arm.armed()) << "one or two may get lost";
  drive.refuses = 1000;
  arm.run_for(20ms);
  EXPECT_EQ(drive.state(), component::State::kException);
  EXPECT_THAT(std::string(drive.reason()),
              HasSubstr("it did not take three commands of its joint in a row"));
  arm.run_for(100ms);
  EXPECT_FALSE(arm.armed());
}

/// In motion it is redirected, and stopped.
TEST(OnlineGenerator, TakesThePlaceOfTheOtherByOneLine) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, DRIVE_LIBRARY};
  for (const char* const file : {"torque.yaml", "velocity.yaml", "position.yaml"}) {
    Arm arm(deploy::parse_deployment(
        std::string("include: ") + file +
            "\ncomponents:\n  Generator: {override: true, model: nAxesGeneratorOnline}\n",
        EXAMPLES "/11_drives/online.yaml", options));
    ASSERT_EQ(arm.arm(), CommandStage::kDone) << file;
    EXPECT_EQ(arm.move_to({0.5, -0.5}), CommandStage::kDone) << file;
    auto moving = arm.application().begin(
        "Generator", "moveTo",
        {types::Value::of(std::vector<double>{1.2, 0.0}), types::Value::of(0.0)});
    ASSERT_TRUE(moving) << moving.error();
    arm.run_for(300ms);
    ASSERT_TRUE(arm.application().call("Generator", "changeTarget",
                                       {types::Value::of(std::vector<double>{0.0, 0.3})}));
    for (int k = 0; k < 500 && !moving.value().ended(); ++k) arm.run_for(10ms);
    EXPECT_EQ(moving.value().stage(), CommandStage::kDone) << file;
    arm.run_for(500ms);
    EXPECT_NEAR(arm.at(1), 0.0, 2e-3) << file;
    EXPECT_NEAR(arm.at(2), 0.3, 2e-3) << file;
    EXPECT_EQ(arm.application().faults(), 0u) << file;
  }
}

TEST(DrivesCheck, UnitsAndKindsHaveToFit) {
  EXPECT_THAT(mistakes("torque.yaml", {"PID1.OutUnit=V"}),
              HasSubstr("'PID1.Out' is in 'V', but 'Controller.Out1' expects 'Nm'"));
  EXPECT_THAT(mistakes("position.yaml", {"Controller.OutUnit=rad/s"}),
              HasSubstr("'Controller.act' is in 'rad/s', but 'Actuator.act' expects 'rad'"));
  EXPECT_THAT(mistakes("torque.yaml", {"joint=Joint"}),
              HasSubstr("'Joint1' has no output port 'TorqueActuator'"));
}

TEST(DrivesCheck, ADriveThatTakesSeveralKindsIsGivenOne) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, DRIVE_LIBRARY};
  const std::string text = "include: torque.yaml\ncomponents:\n  Extra: {model: Drive}\n";
  const std::string found =
      deploy::parse_deployment(text, EXAMPLES "/11_drives/extra.yaml", options)
          .diagnostics.to_text();
  EXPECT_THAT(found, HasSubstr("'Extra': 0 of its inputs TorqueActuator, VelocityActuator, "
                               "PositionActuator have a writer, expected one"));
}

TEST(DrivesCheck, TorquesHaveToHoldTheJoint) {
  EXPECT_THAT(mistakes("torque.yaml", {"Joint1.MaxTorque=1"}),
              HasSubstr("MaxTorque 1: its torque is 1 Nm, the joint weighs up to 2 Nm"));
}

TEST(DrivesCheck, AJointHasOneSensor) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, DRIVE_LIBRARY};
  const auto found = [&](const std::string& connections) {
    return deploy::parse_deployment("include: position.yaml\nconnections: " + connections,
                                    EXAMPLES "/11_drives/other.yaml", options)
        .diagnostics.to_text();
  };
  EXPECT_THAT(found("[{from: Drive1.PositionSensor, to: Joint1.PositionSensor, remove: true}]"),
              HasSubstr("'Joint1': neither DisplacementSensor nor PositionSensor has a writer"));
  EXPECT_THAT(found("[Drive1.PositionSensor -> Joint1.DisplacementSensor]"),
              HasSubstr("'Joint1': both DisplacementSensor and PositionSensor have a writer"));
}

}  // namespace
}  // namespace armature
