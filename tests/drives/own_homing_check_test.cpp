// SPDX-License-Identifier: Apache-2.0
// What the check says of homing, and joints that are where the operator says.
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/deployed_robot.hpp"
#include "tests/drives/own_homing_arm.hpp"

namespace armature::testing {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using ::testing::HasSubstr;
using ::testing::Not;

// --- here ------------------------------------------------------------------------------------

std::unique_ptr<DeployedRobot> at_here(const std::string& way, const std::string& drive) {
  auto robot = std::make_unique<DeployedRobot>(
      load_arm(way, {"drive=" + drive, "Joint1.HomingMethod=here", "Joint1.HomePosition=0.5 rad",
                     "Joint1.HomingRequired=true"}));
  return robot;
}

TEST(HomingHere, IsWhatTheOperatorSaysAndMovesNothing) {
  auto robot = at_here("torque", "CountingDrive");
  ASSERT_EQ(robot->start(), "");
  robot->run_for(100ms);
  EXPECT_NE(robot->arm(), CommandStage::kDone);
  const double there = robot->value<double>("Drive1", "angle");
  EXPECT_EQ(robot->run("Joint1", "home").stage(), CommandStage::kDone);
  EXPECT_DOUBLE_EQ(robot->at(1), 0.5);
  EXPECT_EQ(robot->value<double>("Drive1", "angle"), there);
  EXPECT_THAT(robot->log, Not(HasSubstr("InitialPos"))) << "the encoder will begin anywhere";
  ASSERT_EQ(robot->arm(), CommandStage::kDone) << robot->reasons();
  EXPECT_FALSE(robot->application().begin("Joint1", "home", {})) << "it is armed";
}

TEST(HomingHere, ACancelledCommandSaysNothing) {
  auto robot = at_here("torque", "CountingDrive");
  ASSERT_EQ(robot->start(), "");
  robot->run_for(100ms);
  auto home = robot->application().begin("Joint1", "home", {});
  ASSERT_TRUE(home) << home.error();
  home.value().cancel();
  robot->run_for(100ms);
  EXPECT_EQ(home.value().stage(), CommandStage::kCancelled);
  EXPECT_FALSE(robot->value<bool>("Joint1", "homed"));
  EXPECT_DOUBLE_EQ(robot->at(1), 0.0);
  EXPECT_TRUE(robot->value<bool>("Drive1", "position_exact")) << "nothing was begun";
}

TEST(HomingHere, PrintsTheLineThatKeepsItForAnAbsoluteSensor) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, EXAMPLE_LIBRARY};
  options.document.overrides = {"Joint1.HomingMethod=here", "Joint1.HomePosition=0.5 rad",
                                "Joint1.InitialPos=0.1 rad"};
  DeployedRobot robot(deploy::load_deployment(EXAMPLES "/11_drives/torque.yaml", options));
  ASSERT_EQ(robot.start(), "");
  robot.run_for(100ms);
  EXPECT_EQ(robot.run("Joint1", "home").stage(), CommandStage::kDone);
  EXPECT_THAT(robot.log, HasSubstr("Joint1: {override: true, properties: {InitialPos: 0.5 rad}}"));
  EXPECT_DOUBLE_EQ(robot.at(1), 0.5);
  ASSERT_EQ(robot.arm(), CommandStage::kDone) << robot.reasons();
  ASSERT_EQ(robot.move_to({0.8, 0.0}), CommandStage::kDone);
  robot.run_for(500ms);
  EXPECT_NEAR(robot.at(1), 0.8, 0.01);
}

// --- the most that it is driven with ---------------------------------------------------------

/// Which is less than its weight here.
TEST(HomingEffort, BoundsADriveThatFollowsWhateverItLooksFor) {
  for (const char* way : {"velocity", "position"}) {
    for (const char* method : {"index", "switch", "switch_index", "hard_stop"}) {
      SCOPED_TRACE(std::string(way) + " " + method);
      std::vector<std::string> settings = settings_of(way, method);
      settings.emplace_back("Joint1.HomePosition=-1.1 rad");
      settings.emplace_back("Joint1.HomingEffort=1 Nm");
      DeployedRobot robot(load_arm(way, settings));
      ASSERT_EQ(robot.start(), "");
      robot.run_for(100ms);
      const component::CommandHandle home = robot.run("Joint1", "home");
      EXPECT_EQ(home.stage(), CommandStage::kFailed);
      EXPECT_THAT(std::string(home.reason()), HasSubstr("when it was let go"));
    }
  }
}

// --- what the check refuses ------------------------------------------------------------------

std::string refusal(const std::string& way, std::vector<std::string> settings,
                    const std::string& method = "switch") {
  std::vector<std::string> all = settings_of(way, method);
  all.emplace_back("Joint1.HomePosition=-1.2 rad");
  all.insert(all.end(), settings.begin(), settings.end());
  const deploy::Deployment loaded = load_arm(way, all);
  return loaded.ok() ? "" : loaded.diagnostics.to_text();
}

TEST(HomingCheck, TakesWhatTheTestsHere) {
  for (const char* way : {"voltage", "torque", "velocity", "position"}) {
    for (const char* method : {"index", "switch", "switch_index", "hard_stop"}) {
      EXPECT_EQ(refusal(way, {}, method), "");
    }
  }
}

TEST(HomingCheck, RefusesAMethodThatThereIsNot) {
  EXPECT_THAT(refusal("torque", {"Joint1.HomingMethod=limit"}),
              HasSubstr("HomingMethod is 'limit', expected drive, index, switch"));
}

TEST(HomingCheck, RefusesWhatTheHardwareDoesNotHave) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, EXAMPLE_LIBRARY};
  options.document.overrides = settings_of("torque", "switch");
  const auto loaded = deploy::load_deployment(EXAMPLES "/11_drives/torque.yaml", options);
  EXPECT_THAT(loaded.diagnostics.to_text(), HasSubstr("'Drive1' knows where it is: use 'here'"));
}

TEST(HomingCheck, RefusesNumbersThatCannotBe) {
  const std::map<std::string, std::string> wrong{
      {"HomingVelocity=0", "HomingVelocity is 0, expected up to 1, half of MaxVelocity"},
      {"HomingVelocity=-1.5", "HomingVelocity is -1.5"},
      {"HomingTravel=0.04", "HomingTravel is 0.04, expected more than 0.04"},
      {"HomingTravel=5", "HomingTravel is 5, expected up to 4.71"},
      {"HomingTime=6 s", "HomingTime is 6 s, expected more than 6.5 s"},
      {"Sampler=false", "Sampler is false: nobody would brake the joint"},
      {"HomingBackOff=0.1", "HomingBackOff is given, and HomingMethod is 'switch'"},
      {"HomingEffort=30", "HomingEffort is 30, expected more than 0 and up to MaxTorque 20"},
      {"HomingEffort=1", "the joint weighs up to 2 Nm"},
      {"HomingStiffness=0", "HomingStiffness is 0"},
      {"HomingStiffness=100", "lets its weight of 2 Nm move it by 0.02"},
      {"HomingStiffness=20000", "gains"},
      {"HomePosition=-3 rad", "HomePosition is -3"},
      {"HomingVelocity=0.2 m/s", "m/s"},
  };
  for (const auto& [setting, text] : wrong) {
    EXPECT_THAT(refusal("torque", {"Joint1." + setting}), HasSubstr(text)) << setting;
  }
}

TEST(HomingCheck, WarnsOfOneThatArmsWhereNobodyKnows) {
  const deploy::Deployment loaded =
      load_arm("torque", {"Joint1.HomingMethod=here", "Joint1.HomePosition=0.5 rad"});
  EXPECT_TRUE(loaded.ok()) << loaded.diagnostics.to_text();
  EXPECT_THAT(loaded.diagnostics.to_text(),
              HasSubstr("HomingRequired is not set, and 'Drive1' counts from where it was switched "
                        "on: it can be armed at a position that nobody knows"));
}

TEST(HomingCheck, RefusesContradictions) {
  EXPECT_THAT(refusal("torque", {"Joint1.HomingMethod=drive"}),
              HasSubstr("is given, and HomingMethod is 'drive'"));
  EXPECT_THAT(refusal("torque", {"Joint1.HomingMethod=here"}),
              HasSubstr("is given, and HomingMethod is 'here': nothing moves"));
  EXPECT_THAT(refusal("velocity", {"Joint1.HomingEffort=0"}, "hard_stop"),
              HasSubstr("expected what its drive may push with"));
  EXPECT_THAT(refusal("velocity", {"Joint1.HomingStiffness=300"}),
              HasSubstr("HomingStiffness is given, and its drive follows by its own gains"));
  EXPECT_THAT(refusal("position", {"Joint1.HomingDamping=3"}), HasSubstr("HomingDamping is given"));
  EXPECT_THAT(refusal("torque", {"Joint1.HomingBackOff=0.01"}, "hard_stop"),
              HasSubstr("HomingBackOff is 0.01, expected more than 0.02"));
}

}  // namespace
}  // namespace armature::testing
