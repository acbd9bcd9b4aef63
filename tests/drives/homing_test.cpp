// SPDX-License-Identifier: Apache-2.0
// Drives that home by themselves, as deployments use them: the arm of examples/12_cia402, whose
// first drive has an encoder that begins anywhere, and a limit switch at -3 rad of its axis.
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "drives/cia402_components/emulated_cia402_bus.hpp"

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using component::State;
using ::testing::HasSubstr;

/// Where the switch is, by the drive's axis, and what the joint says there.
constexpr double kSwitch = -3.0;
constexpr double kHome = -1.5;

deploy::Deployment load(const std::string& file, const std::vector<std::string>& more) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.document.overrides = {"Drive1.homing_method=17", "Drive1.homing_speed=0.5",
                                "Drive1.home_offset=-1.5", "Joint1.HomingRequired=true"};
  for (const std::string& each : more) options.document.overrides.push_back(each);
  return deploy::load_deployment(EXAMPLES "/12_cia402/" + file, options);
}

class Homing : public ::testing::TestWithParam<const char*> {
 protected:
  void start(const std::vector<std::string>& more = {}) {
    deployment_ = load(GetParam(), more);
    ASSERT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
    ASSERT_EQ(application_->start().to_text(), "");
    run_for(100ms);
  }
  void begin_homing() {
    home_ = begin("Joint1", "home");
    run_for(2s);
    ASSERT_LT(axis(1).velocity(), -0.45) << "by itself";
  }

  void run_for(base::Duration time) { application_->run_for(time); }
  EmulatedBus& bus() {
    return static_cast<EmulatedCia402Bus*>(application_->find("Bus"))->drives();
  }
  EmulatedDrive& drive(unsigned node) { return *bus().find(node); }
  const Axis& axis(unsigned node) { return drive(node).axis(); }
  double at(const char* joint) {
    return *static_cast<const double*>(application_->value_of(joint, "Position").value().data());
  }
  component::CommandHandle begin(const char* component, const char* command,
                                 std::vector<types::Value> arguments = {}) {
    auto begun = application_->begin(component, command, std::move(arguments));
    EXPECT_TRUE(begun) << begun.error();
    return std::move(begun).value();
  }
  CommandStage run(const char* component, const char* command,
                   std::vector<types::Value> arguments = {}) {
    auto begun = application_->begin(component, command, std::move(arguments));
    if (!begun) {
      reason_ = begun.error();
      return CommandStage::kRefused;
    }
    auto command_run = std::move(begun).value();
    for (int k = 0; k < 1000 && !command_run.ended(); ++k) run_for(10ms);
    reason_ = command_run.reason();
    return command_run.stage();
  }
  CommandStage arm() { return run("Arming", "arm"); }
  CommandStage move_to(double first, double second) {
    return run("Generator", "moveTo",
               {types::Value::of(std::vector<double>{first, second}), types::Value::of(0.0)});
  }
  std::string reason_of(const char* name) {
    return std::string(application_->find(name)->reason());
  }
  /// Both axes rest from now on, and nobody has said that it is at home.
  void expect_rest_unhomed() {
    EXPECT_NEAR(axis(1).velocity(), 0.0, 1e-3);
    const double there = axis(1).position();
    run_for(3s);
    EXPECT_NEAR(axis(1).position(), there, 1e-3) << "it does not begin again";
    EXPECT_NE(drive(1).power(), PowerState::kOperationEnabled);
    EXPECT_NE(arm(), CommandStage::kDone);
  }

  std::optional<component::CommandHandle> home_;
  std::string reason_;

 private:
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;

 protected:
  exec::Application& application() { return *application_; }
};

TEST_P(Homing, AJointThatMustBeHomedIsNotArmedBefore) {
  start();
  EXPECT_NE(arm(), CommandStage::kDone);
  EXPECT_THAT(reason_, HasSubstr("it is not homed, and HomingRequired is set"));
  run_for(2s);
  EXPECT_NEAR(axis(1).position(), 0.0, 1e-6);
  EXPECT_EQ(drive(1).power(), PowerState::kSwitchOnDisabled);
}

TEST_P(Homing, TheDriveHomesByItselfAndTheArmMovesFromItsNewPosition) {
  start();
  EXPECT_EQ(run("Joint1", "home"), CommandStage::kDone) << reason_;
  run_for(300ms);
  EXPECT_NEAR(at("Joint1") - axis(1).position(), kHome - kSwitch, 2e-3);
  EXPECT_NEAR(axis(2).position(), 0.0, 1e-6) << "nobody else moves";
  EXPECT_EQ(drive(1).power(), PowerState::kSwitchOnDisabled) << "disarmed at its end";
  ASSERT_EQ(arm(), CommandStage::kDone) << reason_;
  EXPECT_EQ(drive(1).mode(), drive(2).mode()) << "its cyclic mode";
  ASSERT_EQ(move_to(-1.0, 0.3), CommandStage::kDone);
  run_for(500ms);
  EXPECT_NEAR(at("Joint1"), -1.0, 5e-3);
  EXPECT_NEAR(axis(1).position(), -2.5, 1e-2);
  EXPECT_EQ(application().faults(), 0u);
}

TEST_P(Homing, ItIsHomedAgain) {
  start();
  ASSERT_EQ(run("Joint1", "home"), CommandStage::kDone);
  run_for(500ms);
  ASSERT_EQ(run("Joint1", "home"), CommandStage::kDone) << "at its switch: " << reason_;
  run_for(500ms);
  ASSERT_EQ(arm(), CommandStage::kDone) << reason_;
}

TEST_P(Homing, WhatIsArmedOrHomesIsNotHomed) {
  start({"Joint1.HomingRequired=false"});
  ASSERT_EQ(arm(), CommandStage::kDone);
  EXPECT_EQ(run("Joint1", "home"), CommandStage::kRefused);
  EXPECT_THAT(reason_, HasSubstr("disarm first"));
  ASSERT_TRUE(application().call("Arming", "disarm", {}));
  run_for(500ms);
  begin_homing();
  EXPECT_EQ(run("Joint1", "home"), CommandStage::kRefused);
  EXPECT_LT(axis(1).velocity(), -0.45) << "it goes on";
  EXPECT_EQ(run("Joint2", "home"), CommandStage::kRefused);
  EXPECT_THAT(reason_, HasSubstr("homing_method"));
}

// --- what goes wrong on the way
// -------------------------------------------------------------------

TEST_P(Homing, DisarmStopsItAtOnce) {
  start();
  begin_homing();
  ASSERT_TRUE(application().call("Arming", "disarm", {}));
  run_for(50ms);
  EXPECT_EQ(home_->stage(), CommandStage::kFailed);
  expect_rest_unhomed();
}

TEST_P(Homing, ArmingInTheMiddleOfItStopsIt) {
  start();
  begin_homing();
  EXPECT_NE(arm(), CommandStage::kDone);
  EXPECT_THAT(reason_, HasSubstr("it was homing"));
  run_for(50ms);
  expect_rest_unhomed();
}

TEST_P(Homing, ACancelledCommandStopsIt) {
  start();
  begin_homing();
  home_->cancel();
  run_for(50ms);
  EXPECT_EQ(home_->stage(), CommandStage::kCancelled);
  expect_rest_unhomed();
}

TEST_P(Homing, ADriveThatFailsEndsIt) {
  start();
  begin_homing();
  drive(1).fail(0x2310);
  run_for(200ms);
  EXPECT_THAT(reason_of("Drive1"), HasSubstr("failed with error code 8976"));
  EXPECT_TRUE(home_->ended());
  EXPECT_NE(home_->stage(), CommandStage::kDone);
  expect_rest_unhomed();
}

TEST_P(Homing, ADriveThatRebootsEndsIt) {
  start();
  begin_homing();
  drive(1).reboot(bus().bus().now());
  run_for(300ms);
  EXPECT_TRUE(home_->ended());
  EXPECT_NE(home_->stage(), CommandStage::kDone);
  expect_rest_unhomed();
}

TEST_P(Homing, ADriveThatHearsNoSyncIsStopped) {
  start();
  begin_homing();
  drive(1).set_deaf_to_sync(true);
  run_for(300ms);
  EXPECT_TRUE(home_->ended());
  EXPECT_NE(home_->stage(), CommandStage::kDone);
  expect_rest_unhomed();
}

/// Its component is out of service then: the operator has it prepared, and looks.
TEST_P(Homing, ADriveThatHeardNoSyncIsPreparedAgainAtTheOperatorsWord) {
  start();
  begin_homing();
  drive(1).set_deaf_to_sync(true);
  run_for(300ms);
  EXPECT_EQ(drive(1).device().state(), canopen::NmtState::kStopped);
  drive(1).set_deaf_to_sync(false);
  run_for(100ms);
  EXPECT_NE(drive(1).power(), PowerState::kOperationEnabled);
  ASSERT_TRUE(application().call("Bus", "resetDrive", {types::Value::of(1)}));
  run_for(500ms);
  EXPECT_EQ(drive(1).device().state(), canopen::NmtState::kOperational);
  ASSERT_TRUE(application().call("Bus", "resetDrive", {types::Value::of(1)})) << "its fault";
  run_for(100ms);
  EXPECT_EQ(drive(1).power(), PowerState::kSwitchOnDisabled);
}

TEST_P(Homing, ThatWasStoppedIsNotArmedBeforeItHasHomedOrTheOperatorHasLooked) {
  start({"Joint1.HomingRequired=false"});
  begin_homing();
  ASSERT_TRUE(application().call("Arming", "disarm", {}));
  run_for(1s);
  EXPECT_NE(arm(), CommandStage::kDone);
  EXPECT_THAT(reason_, HasSubstr("it has begun to home, and has not found home"));
  ASSERT_EQ(run("Joint1", "home"), CommandStage::kDone) << reason_;
  run_for(500ms);
  EXPECT_EQ(arm(), CommandStage::kDone) << reason_;
}

TEST_P(Homing, ATimeThatIsOverEndsIt) {
  start({"Joint1.HomingTime=3 s"});
  begin_homing();
  run_for(2s);
  EXPECT_EQ(home_->stage(), CommandStage::kFailed);
  EXPECT_THAT(std::string(home_->reason()), HasSubstr("has not found home within 3 s"));
  expect_rest_unhomed();
}

TEST_P(Homing, ASwitchThatIsNotThereEndsItAtTheLengthOfTheJoint) {
  start({"Joint1.PositionMin=-60 deg", "Generator.lower=[-1.0]"});
  begin_homing();
  run_for(8s);
  EXPECT_TRUE(home_->ended());
  EXPECT_THAT(reason_of("Joint1"), HasSubstr("without finding home, and its range is 2.6"));
  EXPECT_NEAR(axis(1).velocity(), 0.0, 1e-3);
  EXPECT_GT(axis(1).position(), kSwitch + 0.2);
}

TEST_P(Homing, AVelocityAboveItsBoundIsAFault) {
  start({"Drive1.homing_speed=2.5", "Drive1.homing_acceleration=10"});
  auto home = begin("Joint1", "home");
  run_for(2s);
  EXPECT_TRUE(home.ended());
  EXPECT_THAT(reason_of("Joint1"), HasSubstr("(MaxVelocity: 2): braked"));
  EXPECT_NEAR(axis(1).velocity(), 0.0, 1e-3);
}

TEST_P(Homing, ThePositionMayJumpOnceAndNoMore) {
  start();
  begin_homing();
  drive(1).shift_encoder(0.5);
  run_for(20ms);
  EXPECT_EQ(application().find("Joint1")->state(), State::kRunning);
  drive(1).shift_encoder(0.5);
  run_for(100ms);
  EXPECT_THAT(reason_of("Joint1"), HasSubstr("PositionSensor says that it moved by 0."));
  EXPECT_NEAR(axis(1).velocity(), 0.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Cia402, Homing,
                         ::testing::Values("torque.yaml", "velocity.yaml", "position.yaml"),
                         [](const auto& info) {
                           const std::string file = info.param;
                           return file.substr(0, file.find('.'));
                         });

TEST(HomingCheck, AMethodThatCia402DoesNotHaveIsRefused) {
  EXPECT_THAT(load("position.yaml", {"Drive1.homing_method=15"}).diagnostics.to_text(),
              HasSubstr("homing_method is 15, which CiA 402 does not have"));
}

TEST(HomingCheck, ADriveThatWouldMoveOnWithoutItsHostIsRefused) {
  EXPECT_THAT(load("position.yaml", {"Bus.host_heartbeat=0"}).diagnostics.to_text(),
              HasSubstr("homing_method is given, and host_heartbeat of 'Bus' is 0"));
}

TEST(HomingCheck, AnEncoderThatBeginsAnywhereIsSaidToDoSo) {
  const std::vector<std::string> here{"Drive1.homing_method=0", "Joint1.HomingMethod=here",
                                      "Joint1.HomePosition=0.5", "Joint1.HomingRequired=false"};
  EXPECT_EQ(load("position.yaml", here).diagnostics.to_text(), "");
  std::vector<std::string> counting = here;
  counting.emplace_back("Drive1.encoder=counting");
  EXPECT_THAT(load("position.yaml", counting).diagnostics.to_text(),
              HasSubstr("'Drive1' counts from where it was switched on"));
}

TEST(HomingCheck, ADriveThatIsNotAskedForItsModeIsRefused) {
  EXPECT_THAT(load("position.yaml", {"Bus.slow_period=0"}).diagnostics.to_text(),
              HasSubstr("homing_method is given, and slow_period of 'Bus' is 0"));
}

}  // namespace
}  // namespace armature::cia402
