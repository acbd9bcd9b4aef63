// SPDX-License-Identifier: Apache-2.0
// An arm on a rail: two joints that turn and a linear axis, examples/11_drives/rail.yaml.
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "armature/testing/deployed_robot.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using ::testing::AllOf;
using ::testing::HasSubstr;

deploy::Deployment load(std::vector<std::string> overrides = {}) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, DRIVE_LIBRARY};
  options.document.overrides = std::move(overrides);
  return deploy::load_deployment(EXAMPLES "/11_drives/rail.yaml", options);
}

/// With other components.
deploy::Deployment load_with(const std::string& components) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, DRIVE_LIBRARY};
  return deploy::parse_deployment("include: rail.yaml\ncomponents:\n" + components,
                                  EXAMPLES "/11_drives/other.yaml", options);
}

std::string mistakes(std::vector<std::string> overrides = {}) {
  return load(std::move(overrides)).diagnostics.to_text();
}

/// After the first samples.
class Rail final : public testing::DeployedRobot {
 public:
  explicit Rail(std::vector<std::string> overrides = {}) : Rail(load(std::move(overrides))) {}
  explicit Rail(deploy::Deployment deployment) : DeployedRobot(std::move(deployment)) {
    EXPECT_EQ(start(), "");
    run_for(100ms);
  }
};

TEST(Rail, JointsAndALinearAxisMoveTogether) {
  Rail rail;
  ASSERT_EQ(rail.arm(), CommandStage::kDone) << rail.log;
  EXPECT_EQ(rail.move_to({1.0, -1.0, 1.2}), CommandStage::kDone);
  rail.run_for(500ms);
  EXPECT_NEAR(rail.at(1), 1.0, 2e-3);
  EXPECT_NEAR(rail.at(2), -1.0, 2e-3);
  EXPECT_NEAR(rail.at(3), 1.2, 2e-3) << "[m]";
  EXPECT_EQ(rail.application().faults(), 0u);
}

TEST(Rail, MovesByTheOnlineGeneratorToo) {
  Rail rail(
      load_with("  Generator: {override: true, model: nAxesGeneratorOnline, properties: {max_jerk: "
                "[40 rad/s^3, 40, 15000 mm/s^3]}}\n"));
  ASSERT_EQ(rail.arm(), CommandStage::kDone) << rail.log;
  EXPECT_EQ(rail.move_to({0.5, -0.5, 1.2}), CommandStage::kDone);
  rail.run_for(500ms);
  EXPECT_NEAR(rail.at(3), 1.2, 2e-3) << "[m]";
}

TEST(Rail, TheCheckRefusesTheUnitsOfTheOtherKind) {
  EXPECT_EQ(mistakes(), "");
  EXPECT_THAT(mistakes({"Joint3.MaxVelocity=2 rad/s"}),
              AllOf(HasSubstr("Joint3"), HasSubstr("rad/s"), HasSubstr("m/s")));
  EXPECT_THAT(mistakes({"Joint3.MaxTorque=20 Nm"}), HasSubstr("Nm"));
  EXPECT_THAT(mistakes({"Joint1.MaxVelocity=2 m/s"}), HasSubstr("m/s"));
  EXPECT_THAT(mistakes({"PID3.Kp=300 Nm/rad"}), HasSubstr("Nm/rad"));
  EXPECT_THAT(mistakes({"PID1.Kp=300 V/rad"}), HasSubstr("V/rad"))
      << "the gains of a PID of torques are in Nm/rad";
  EXPECT_THAT(mistakes({"Generator.max_vel=[1 V]"}), HasSubstr("V"));
  EXPECT_THAT(mistakes({"Sensor.Unit=rad"}),
              HasSubstr("'Joint3.Position' is in 'm', but 'Sensor.Position3' expects 'rad'"));
  EXPECT_THAT(mistakes({"PID3.Unit=rad", "PID3.Kp=300"}),
              HasSubstr("its Unit is rad, but that of Joint3 is m: set Unit to m"));
  EXPECT_THAT(mistakes({"Joint3.Unit=mm"}), HasSubstr("expected rad or m"));
}

/// The motor of the rail turns the other way than its sign says.
TEST(Rail, TheWatchOfArmingSpeaksOfMetres) {
  Rail rail({"Joint3.ActuatorSign=-1", "Joint3.PositionMax=2", "Drive3.Weight=10"});
  EXPECT_EQ(rail.arm(), CommandStage::kFailed);
  EXPECT_THAT(rail.log, HasSubstr(" m when its brake opened at "));
  EXPECT_THAT(rail.log, HasSubstr(" N (ArmingMotion: 0.01)"));
}

}  // namespace
}  // namespace armature
