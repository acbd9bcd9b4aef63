// SPDX-License-Identifier: Apache-2.0
// What becomes of a position that was found, when its joint stops, is set otherwise and starts.
#include <chrono>
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
using component::State;
using ::testing::HasSubstr;

/// The first joint stands at -0.4 rad, which its drive counts as 0, and was homed there.
class Homed : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    robot = std::make_unique<DeployedRobot>(
        load_arm(GetParam(), {"Joint1.HomingMethod=here", "Joint1.HomePosition=0.7 rad",
                              "Joint1.HomingRequired=false"}));
    ASSERT_EQ(robot->start(), "");
    robot->run_for(100ms);
    ASSERT_EQ(robot->run("Joint1", "home").stage(), CommandStage::kDone) << robot->reasons();
    ASSERT_DOUBLE_EQ(robot->at(1), 0.7);
    ASSERT_TRUE(robot->application().stop_component("Joint1"));
    robot->run_for(50ms);
  }
  void start_again() {
    robot->reset_and_start_everything();
    robot->run_for(200ms);
    ASSERT_EQ(robot->state("Joint1"), State::kRunning) << robot->reasons();
  }

  std::unique_ptr<DeployedRobot> robot;
};

TEST_P(Homed, IsWhereItIsAlsoWhenAnotherSettingWasChanged) {
  robot->set("Joint1", "HoldingMotion", 0.11);
  start_again();
  EXPECT_DOUBLE_EQ(robot->at(1), 0.7);
  ASSERT_EQ(robot->arm(), CommandStage::kDone) << robot->reasons();
  ASSERT_EQ(robot->move_to({0.9, 0.0}), CommandStage::kDone) << robot->reasons();
  robot->run_for(500ms);
  EXPECT_NEAR(robot->value<double>("Drive1", "angle"), -0.4 + 0.2, 0.01) << "really there";
}

TEST_P(Homed, IsNotArmedWhenItsZeroWasChangedBeforeTheOperatorHasLooked) {
  robot->set("Joint1", "InitialPos", 0.1);
  start_again();
  EXPECT_NE(robot->arm(), CommandStage::kDone);
  EXPECT_THAT(robot->log, HasSubstr("was changed since it was homed: call its command home"));
  robot->set("Drive1", "position_confirmed", true);
  EXPECT_EQ(robot->arm(), CommandStage::kDone) << robot->reasons();
}

/// Nothing of what it was told before counts.
TEST_P(Homed, AStartThatWasRefusedIsRefusedAgain) {
  robot->set("Joint1", "MaxAcceleration", -1.0);
  EXPECT_FALSE(robot->application().start_component("Joint1"));
  EXPECT_FALSE(robot->application().start_component("Joint1"));
  robot->set("Joint1", "MaxAcceleration", 8.0);
  start_again();
  EXPECT_DOUBLE_EQ(robot->at(1), 0.7);
}

INSTANTIATE_TEST_SUITE_P(Drives, Homed, ::testing::Values("torque", "position"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace armature::testing
