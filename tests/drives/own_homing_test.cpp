// SPDX-License-Identifier: Apache-2.0
// Joints that home by themselves, in each way that a drive is commanded: the arm of
// examples/11_drives, whose encoders begin anywhere. Its first joint stands at -0.4 rad at first,
// has a switch that is closed below -1.2 rad, index marks at -1.1 rad and each 0.4 rad, and stops
// at 1.6 rad both ways; it weighs 2 Nm.
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/properties/keeping.hpp"
#include "armature/testing/deployed_robot.hpp"
#include "tests/drives/own_homing_arm.hpp"

namespace armature::testing {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kBegin = -0.4;
constexpr double kTravel = 1.3;

class OwnHoming : public ::testing::TestWithParam<const char*> {
 protected:
  void start(const std::string& method, const std::string& home,
             const std::vector<std::string>& more = {}) {
    home_.reset();
    farthest_ = fastest_ = 0.0;
    last_ = kBegin;
    std::vector<std::string> settings = settings_of(GetParam(), method);
    settings.push_back("Joint1.HomePosition=" + home);
    settings.insert(settings.end(), more.begin(), more.end());
    robot_.reset();
    robot_ = std::make_unique<DeployedRobot>(load_arm(GetParam(), settings));
    ASSERT_EQ(robot_->start(), "");
    run_for(100ms);
  }
  void begin() {
    auto begun = application().begin("Joint1", "home", {});
    if (!begun) refusal_ = begun.error();
    if (!begun) return home_.reset();
    home_ = std::make_unique<component::CommandHandle>(std::move(begun).value());
  }
  /// On its way, at full speed.
  void begin_and_move() {
    begin();
    run_for(1500ms);
    ASSERT_TRUE(home_) << refusal_;
    ASSERT_FALSE(home_->ended()) << home_->reason();
    ASSERT_LT(angle(), kBegin - 0.1) << "by itself";
  }
  CommandStage finish(base::Duration within = 70s) {
    if (!home_) return CommandStage::kRefused;
    for (base::Duration passed{}; passed < within && !home_->ended(); passed += 10ms) run_for(10ms);
    return home_->stage();
  }
  CommandStage home() {
    begin();
    return finish();
  }
  void run_for(base::Duration duration) {
    for (base::Duration passed{}; passed < duration; passed += 5ms) {
      robot_->run_for(5ms);
      farthest_ = std::max(farthest_, std::abs(angle() - kBegin));
      fastest_ = std::max(fastest_, std::abs(angle() - last_) / 0.005);
      last_ = angle();
    }
  }
  double angle() { return robot_->value<double>("Drive1", "angle"); }
  double at() { return robot_->at(1); }
  exec::Application& application() { return robot_->application(); }
  void break_it(const std::string& what) { robot_->set("Drive1", "Fails", what); }
  std::string reason() { return home_ ? std::string(home_->reason()) : refusal_; }

  /// Nobody knows where it is: it rests, and is not armed.
  void expect_rest_unhomed(double most_travel = kTravel) {
    ASSERT_TRUE(home_) << refusal_;
    EXPECT_NE(home_->stage(), CommandStage::kDone);
    run_for(200ms);
    const double there = angle();
    run_for(2s);
    EXPECT_NEAR(angle(), there, 1e-9) << "its brake is closed, and it does not begin again";
    EXPECT_LE(farthest_, most_travel);
    EXPECT_FALSE(robot_->value<bool>("Joint1", "homed"));
    EXPECT_NE(robot_->arm(), CommandStage::kDone);
    run_for(100ms);
    EXPECT_NEAR(angle(), there, 1e-9);
  }
  void expect_home(double really, double within) {
    ASSERT_TRUE(home_ && home_->stage() == CommandStage::kDone) << reason() << robot_->log;
    EXPECT_NEAR(at(), angle(), within);
    EXPECT_LT(std::abs(angle() - really), 0.1) << "it rests beside it";
    EXPECT_LE(farthest_, kTravel);
    EXPECT_LE(fastest_, 0.4);
    EXPECT_FALSE(robot_->armed());
    const double there = angle();
    run_for(1s);
    EXPECT_EQ(angle(), there) << "braked";
    ASSERT_EQ(robot_->arm(), CommandStage::kDone) << robot_->reasons();
    EXPECT_NEAR(angle(), there, 0.01) << "the controller begins where it is";
    ASSERT_EQ(robot_->move_to({-0.2, 0.0}), CommandStage::kDone) << robot_->reasons();
    run_for(500ms);
    EXPECT_NEAR(angle(), -0.2, 0.01) << "really there";
  }

  std::unique_ptr<DeployedRobot> robot_;
  std::unique_ptr<component::CommandHandle> home_;
  std::string refusal_;
  double last_ = kBegin;
  double farthest_ = 0.0;
  double fastest_ = 0.0;
};

// --- finding it ------------------------------------------------------------------------------

TEST_P(OwnHoming, AtASwitchItMovesFromItsNewPosition) {
  start("switch", "-1.2 rad");
  EXPECT_NE(robot_->arm(), CommandStage::kDone) << "it is not homed";
  home();
  expect_home(-1.2, 1e-3);
}

TEST_P(OwnHoming, AtTheIndexBehindASwitch) {
  start("switch_index", "-1.1 rad");
  home();
  expect_home(-1.1, 2e-4);
}

TEST_P(OwnHoming, AtAnIndex) {
  start("index", "-0.7 rad");
  home();
  expect_home(-0.7, 2e-4);
}

TEST_P(OwnHoming, AtAHardStopItComesAwayFromIt) {
  start("hard_stop", "-1.57 rad");
  home();
  ASSERT_TRUE(home_ && home_->stage() == CommandStage::kDone) << reason() << robot_->log;
  EXPECT_NEAR(at() + 1.57, angle() + 1.6, 2e-3);
  EXPECT_NEAR(angle(), -1.55, 5e-3) << "by HomingBackOff";
  EXPECT_LE(fastest_, 0.4);
}

TEST_P(OwnHoming, ItIsHomedAgainAndFromItsSwitch) {
  start("switch", "-1.2 rad");
  ASSERT_EQ(home(), CommandStage::kDone) << reason();
  run_for(300ms);
  ASSERT_EQ(home(), CommandStage::kDone) << reason();
  expect_home(-1.2, 1e-3);
}

TEST_P(OwnHoming, WhatControllersWantMovesNothingMeanwhile) {
  start("switch", "-1.2 rad");
  begin_and_move();
  EXPECT_NE(robot_->begin_motion_to({1.0, 1.0}), "") << "nothing is armed";
  EXPECT_EQ(robot_->call("Joint1", "motorSet", {types::Value::of(5.0)}), "");
  finish();
  expect_home(-1.2, 1e-3);
}

// --- what goes wrong on the way --------------------------------------------------------------

TEST_P(OwnHoming, ASwitchThatNeverComesEndsItWithinItsTravel) {
  start("switch", "-1.2 rad", {"Joint1.HomingTravel=1.0 rad"});
  break_it("switch_open");
  EXPECT_EQ(home(), CommandStage::kFailed);
  EXPECT_THAT(reason(), HasSubstr("(HomingTravel: 1), and its switch did not close"));
  EXPECT_GT(farthest_, 0.95) << "it has looked";
  expect_rest_unhomed(1.0);
}

TEST_P(OwnHoming, ASwitchThatIsStuckEndsItWithinItsTravel) {
  start("switch", "-1.2 rad", {"Joint1.HomingTravel=0.5 rad"});
  break_it("switch_closed");
  run_for(10ms);
  EXPECT_EQ(home(), CommandStage::kFailed);
  EXPECT_THAT(reason(), HasSubstr("and its switch did not open"));
  expect_rest_unhomed(0.5);
}

TEST_P(OwnHoming, AnIndexThatNeverComesEndsIt) {
  for (const char* method : {"index", "switch_index"}) {
    SCOPED_TRACE(method);
    start(method, "-1.1 rad", {"Joint1.HomingTravel=1.0 rad"});
    break_it("index");
    farthest_ = 0.0;
    EXPECT_EQ(home(), CommandStage::kFailed);
    EXPECT_THAT(reason(), HasSubstr("no index came"));
    expect_rest_unhomed(1.0);
  }
}

TEST_P(OwnHoming, AHardStopThatSlipsIsNone) {
  start("hard_stop", "-1.57 rad", {"Joint1.HomingTravel=1.35 rad"});
  break_it("stop");
  EXPECT_EQ(home(), CommandStage::kFailed);
  EXPECT_THAT(reason(), HasSubstr("nothing stopped it: look for what gives way"));
  expect_rest_unhomed(1.35);
}

TEST_P(OwnHoming, ASensorThatDiesEndsItAfterAFewHundredths) {
  for (const char* method : {"switch", "index", "hard_stop"}) {
    SCOPED_TRACE(method);
    start(method, "-1.1 rad");
    begin();
    run_for(800ms);
    break_it("sensor");
    const double there = angle();
    EXPECT_EQ(finish(), CommandStage::kFailed);
    EXPECT_THAT(reason(), HasSubstr("look for what blocks it, at its brake and at its sensor"));
    const double most = std::string(method) == "hard_stop" ? 0.3 : 0.05;
    EXPECT_LT(std::abs(angle() - there), most);
    farthest_ = 0.0;
    expect_rest_unhomed();
  }
}

TEST_P(OwnHoming, ACounterThatJumpsIsAFault) {
  start("switch", "-1.2 rad");
  begin_and_move();
  break_it("counter");
  run_for(20ms);
  EXPECT_TRUE(home_->ended());
  EXPECT_THAT(robot_->reason("Joint1"), HasSubstr("PositionSensor says that it moved by 0.4"));
  const double there = angle();
  run_for(1s);
  EXPECT_NEAR(angle(), there, 1e-3) << "braked";
}

TEST_P(OwnHoming, ABrakeThatDoesNotOpenIsNoHardStop) {
  for (const char* method : {"switch", "index", "hard_stop"}) {
    SCOPED_TRACE(method);
    start(method, "-1.1 rad");
    break_it("brake");
    EXPECT_EQ(home(), CommandStage::kFailed);
    EXPECT_THAT(reason(), HasSubstr("at its brake and at its sensor"));
    EXPECT_EQ(angle(), kBegin);
    expect_rest_unhomed();
  }
}

TEST_P(OwnHoming, AnEmergencyStopEndsItAtOnce) {
  start("switch", "-1.2 rad");
  begin_and_move();
  const double there = angle();
  ASSERT_EQ(robot_->call("Arming", "disarm"), "");
  run_for(20ms);
  EXPECT_EQ(home_->stage(), CommandStage::kFailed);
  EXPECT_NEAR(angle(), there, 0.005);
  expect_rest_unhomed();
}

TEST_P(OwnHoming, AStopOfAllMotionEndsItAtOnce) {
  start("switch", "-1.2 rad");
  begin_and_move();
  const double there = angle();
  ASSERT_EQ(robot_->call("Arming", "stop"), "");
  run_for(20ms);
  EXPECT_EQ(home_->stage(), CommandStage::kFailed);
  EXPECT_NEAR(angle(), there, 0.005);
  expect_rest_unhomed();
}

TEST_P(OwnHoming, ArmingInTheMiddleOfItEndsIt) {
  start("switch", "-1.2 rad");
  begin_and_move();
  EXPECT_NE(robot_->arm(), CommandStage::kDone);
  expect_rest_unhomed();
}

TEST_P(OwnHoming, ACancelledCommandEndsIt) {
  start("switch", "-1.2 rad");
  begin_and_move();
  home_->cancel();
  run_for(20ms);
  EXPECT_EQ(home_->stage(), CommandStage::kCancelled);
  expect_rest_unhomed();
}

TEST_P(OwnHoming, ATimeThatIsOverEndsIt) {
  start("switch", "-1.2 rad", {"Joint1.HomingTime=2 s", "Joint1.HomingTravel=0.39 rad"});
  EXPECT_EQ(home(), CommandStage::kFailed);
  EXPECT_THAT(reason(), HasSubstr("has not found home within 2 s (HomingTime)"));
  expect_rest_unhomed();
}

/// What ends a run, in a fault or in order, ends it: also where others died.
TEST_P(OwnHoming, AComponentThatDiesEndsIt) {
  for (const char* component : {"Drive1", "Joint1", "Sampler", "Arming"}) {
    SCOPED_TRACE(component);
    start("switch", "-1.2 rad");
    begin();
    run_for(1500ms);
    ASSERT_TRUE(home_) << refusal_;
    application().run_in_thread_of(*application().find(component),
                                   [] { throw std::runtime_error("out of order"); });
    const double there = angle();
    run_for(300ms);
    EXPECT_TRUE(home_->ended());
    EXPECT_NE(home_->stage(), CommandStage::kDone);
    // Nobody has the simulated axis move without samples: its brake says it.
    EXPECT_LT(std::abs(angle() - there), 0.03);
    const double rest = angle();
    robot_->reset_and_start_everything();
    run_for(500ms);
    robot_->reset_and_start_everything();
    run_for(1s);
    EXPECT_EQ(angle(), rest) << "nothing goes on";
    EXPECT_NE(robot_->arm(), CommandStage::kDone);
  }
}

TEST_P(OwnHoming, TheOperatorMaySayWhereItIsAfterItFailed) {
  start("switch", "-1.2 rad", {"Joint1.HomingRequired=false"});
  begin_and_move();
  ASSERT_EQ(robot_->call("Arming", "disarm"), "");
  run_for(100ms);
  EXPECT_NE(robot_->arm(), CommandStage::kDone);
  EXPECT_THAT(robot_->log, HasSubstr("it has begun to home, and has not found home"));
  robot_->set("Drive1", "position_confirmed", true);
  EXPECT_EQ(robot_->arm(), CommandStage::kDone) << robot_->reasons();
}

TEST_P(OwnHoming, AWordThatWasGivenWhileItMovedDoesNotCountAfterwards) {
  start("switch", "-1.2 rad", {"Joint1.HomingRequired=false"});
  begin_and_move();
  robot_->set("Drive1", "position_confirmed", true);
  run_for(100ms);
  ASSERT_EQ(robot_->call("Arming", "disarm"), "");
  expect_rest_unhomed();
}

TEST_P(OwnHoming, NoPositionIsKeptOfAJointThatDidNotFindHome) {
  start("switch", "-1.2 rad");
  begin_and_move();
  ASSERT_EQ(robot_->call("Arming", "disarm"), "");
  run_for(500ms);
  ASSERT_TRUE(application().stop().ok());
  auto& joint = dynamic_cast<component::Keeps&>(*application().find("Joint1"));
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  EXPECT_THAT(joint.keeping().end({.owner = "arm/Joint1", .now = now}),
              HasSubstr("it has begun to home, and has not found home"));
}

TEST_P(OwnHoming, AStartAfterItFailedSaysWhyItIsNotArmed) {
  start("switch", "-1.2 rad", {"Joint1.HomingRequired=false"});
  begin_and_move();
  ASSERT_TRUE(application().stop_component("Drive1"));
  run_for(300ms);
  robot_->reset_and_start_everything();
  robot_->reset_and_start_everything();
  run_for(500ms);
  robot_->log.clear();
  EXPECT_NE(robot_->arm(), CommandStage::kDone);
  EXPECT_THAT(robot_->log, HasSubstr("it has begun to home, and has not found home"));
}

/// Samples are what watches it.
TEST_P(OwnHoming, IsNotBegunWhereOldCommandsAreHeld) {
  start("switch", "-1.2 rad");
  for (auto* input : component::interface_of(*application().find("Joint1")).inputs) {
    const bool commands = !input->name().ends_with("Sensor");
    if (commands) input->set_max_age(component::max_age(100ms, component::Reaction::kHold));
  }
  EXPECT_EQ(home(), CommandStage::kRefused);
  EXPECT_THAT(reason(), HasSubstr("nobody would brake it if samples no longer came"));
  EXPECT_EQ(angle(), kBegin);
}

TEST_P(OwnHoming, WhatIsArmedOrHomesIsNotHomed) {
  start("switch", "-1.2 rad", {"Joint1.HomingRequired=false"});
  ASSERT_EQ(robot_->arm(), CommandStage::kDone);
  EXPECT_EQ(home(), CommandStage::kRefused);
  EXPECT_THAT(reason(), HasSubstr("disarm first"));
  ASSERT_EQ(robot_->call("Arming", "disarm"), "");
  run_for(500ms);
  begin_and_move();
  EXPECT_FALSE(application().begin("Joint1", "home", {})) << "it homes already";
  EXPECT_EQ(finish(), CommandStage::kDone) << "the first goes on";
}

INSTANTIATE_TEST_SUITE_P(Drives, OwnHoming,
                         ::testing::Values("voltage", "torque", "velocity", "position"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace armature::testing
