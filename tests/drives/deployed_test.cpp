// SPDX-License-Identifier: Apache-2.0
// Drives by CiA 402 as deployments use them: the arm of examples/12_cia402, with emulated drives.
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "armature/testing/deployed_robot.hpp"
#include "drives/cia402_components/emulated_cia402_bus.hpp"

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using component::State;
using ::testing::HasSubstr;

/// A peer may always say effort 0.
class Meddler final : public component::Component {
 public:
  using Component::Component;

  int taken = 0;
  int refused = 0;

 private:
  void on_update() override {
    const auto answer = set_effort_(1, control::LimitedEffort());
    const bool is_taken = answer.status == component::CallStatus::kDone && answer.value;
    ++(is_taken ? taken : refused);
  }
  component::OperationCaller<bool(int, control::LimitedEffort)> set_effort_{this, "setEffort", ""};
};

/// What turns one joint beside the controller of the others.
class Turner final : public component::Component {
 public:
  using Component::Component;

  double velocity = 0.0;

 private:
  void on_update() override { velocity_.write(velocity); }
  component::OutputPort<double> velocity_{this, "Velocity", "", "rad/s"};
};

/// Files that exist for these tests alone; all are in the folder of the example.
const std::map<std::string, const char*> kOwnFiles = {{"meddled.yaml", R"(
include: position.yaml
components:
  Meddler: {model: Meddler, peers: [Bus], activity: {periodic: 2 ms, priority: 80}}
)"},
                                                      {"mixed.yaml", R"(
include: position.yaml
components:
  Drive2: {override: true, properties: {mode: velocity}}
  Joint2: {override: true, model: VelocityJoint, properties: {MaxPositionError: {remove: true}, MaxVelocityError: 0.5 rad/s}}
  Turner: {model: Turner, activity: {periodic: 2 ms, priority: 40}}
connections:
  - {from: Joint2.PositionActuator, to: Drive2.PositionActuator, remove: true}
  - {from: Actuator.DesiredPosition2, to: Joint2.DesiredPosition, remove: true}
  - Joint2.VelocityActuator -> Drive2.VelocityActuator
  - Turner.Velocity -> Joint2.DesiredVelocity
)"}};

deploy::Deployment load(const std::string& file, std::vector<std::string> overrides = {}) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.models = [](component::Registry& models) {
    models.add<Meddler>("Meddler", "meddles");
    models.add<Turner>("Turner", "turns");
  };
  options.document.overrides = std::move(overrides);
  const auto own = kOwnFiles.find(file);
  const std::string path = EXAMPLES "/12_cia402/" + file;
  if (own == kOwnFiles.end()) return deploy::load_deployment(path, options);
  return deploy::parse_deployment(own->second, path, options);
}

class Arm final : public testing::DeployedRobot {
 public:
  explicit Arm(const std::string& file, std::vector<std::string> overrides = {})
      : DeployedRobot(load(file, std::move(overrides))), started(start()) {
    if (started.empty()) run_for(100ms);
  }

  EmulatedBus& bus() {
    return static_cast<EmulatedCia402Bus*>(application().find("Bus"))->drives();
  }
  EmulatedDrive& drive(unsigned node) { return *bus().find(node); }
  /// What the operator does with all that faulted or was stopped by that.
  void put_back_to_service() {
    for (int round = 0; round < 5; ++round) {
      reset_and_start_everything();
      run_for(50ms);
    }
    EXPECT_EQ(state("Arming"), State::kRunning) << reasons();
    EXPECT_EQ(state("Generator"), State::kRunning) << reasons();
  }
  void begin_motion() {
    ASSERT_EQ(begin_motion_to({1.2, 1.2}), "");
    run_for(500ms);
    ASSERT_GT(drive(1).axis().velocity(), 1.0);
  }
  /// All axes come to rest within `time`, and stay.
  void expect_rest_within(base::Duration time) {
    run_for(time);
    for (unsigned node = 1; node <= 2; ++node) {
      EXPECT_NEAR(drive(node).axis().velocity(), 0.0, 1e-3) << node;
    }
    EXPECT_FALSE(armed());
    const double there = drive(1).axis().position();
    run_for(500ms);
    EXPECT_NEAR(drive(1).axis().position(), there, 1e-3);
  }

  std::string started;  ///< what keeps it from running
};

// --- in each mode --------------------------------------------------------------------------------

class EachMode : public ::testing::TestWithParam<const char*> {};

TEST_P(EachMode, NothingIsPoweredBeforeTheOperatorArms) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.started, "");
  arm.run_for(2s);
  for (unsigned node = 1; node <= 2; ++node) {
    EXPECT_EQ(arm.drive(node).power(), PowerState::kSwitchOnDisabled);
    EXPECT_NEAR(arm.drive(node).axis().position(), 0.0, 1e-6);
  }
}

TEST_P(EachMode, TheArmIsArmedMovesAndIsSwitchedOffAgain) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.started, "");
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  EXPECT_LT(std::abs(arm.drive(1).axis().position()), 0.01);
  EXPECT_EQ(arm.drive(1).power(), PowerState::kOperationEnabled);
  EXPECT_EQ(arm.move_to({1.0, -1.0}), CommandStage::kDone);
  arm.run_for(500ms);
  EXPECT_NEAR(arm.at(1), 1.0, 5e-3);
  EXPECT_NEAR(arm.at(2), -1.0, 5e-3);
  EXPECT_NEAR(arm.drive(1).axis().position(), arm.at(1), 5e-3);
  ASSERT_TRUE(arm.application().call("Arming", "disarm", {}));
  arm.run_for(500ms);
  EXPECT_EQ(arm.drive(1).power(), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(arm.application().faults(), 0u);
}

TEST_P(EachMode, ADriveThatFailsStopsTheArm) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  arm.begin_motion();
  arm.drive(2).fail(0x2310);
  arm.expect_rest_within(500ms);
  EXPECT_EQ(arm.state("Drive2"), State::kException);
  EXPECT_THAT(arm.reason("Drive2"), HasSubstr("the drive failed with error code 8976"));
  EXPECT_EQ(arm.drive(2).power(), PowerState::kFault) << "the operator alone resets it";
}

/// Nobody reads a drive any more whose component is out of service; its host speaks to it still.
TEST_P(EachMode, ADriveThatFailedIsResetByTheOperatorAndMovesAgain) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  arm.begin_motion();
  arm.drive(2).fail(0x2310);
  arm.expect_rest_within(500ms);
  EXPECT_EQ(arm.drive(1).power(), PowerState::kSwitchOnDisabled) << "told to, not for want of SYNC";
  ASSERT_TRUE(arm.application().call("Bus", "resetDrive", {types::Value::of(2)}));
  arm.run_for(20ms);
  EXPECT_EQ(arm.drive(2).power(), PowerState::kSwitchOnDisabled);
  for (int round = 0; round < 2; ++round) {
    arm.reset_and_start_everything();
    arm.run_for(20ms);
  }
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  EXPECT_EQ(arm.move_to({0.2, -0.2}), CommandStage::kDone);
}

TEST_P(EachMode, ADriveWhoseValuesAreFrozenStopsTheArm) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  arm.begin_motion();
  arm.drive(2).set_frozen(true);
  arm.run_for(500ms);
  EXPECT_FALSE(arm.armed());
  for (unsigned node = 1; node <= 2; ++node) {
    EXPECT_NEAR(arm.drive(node).axis().velocity(), 0.0, 1e-3) << node;
    EXPECT_LT(std::abs(arm.drive(node).axis().position()), 1.5708) << node;
  }
}

TEST_P(EachMode, ADriveThatRebootsStopsTheArm) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  arm.begin_motion();
  arm.drive(1).reboot(arm.bus().bus().now());
  arm.run_for(200ms);
  EXPECT_EQ(arm.state("Drive1"), State::kException);
  EXPECT_FALSE(arm.armed());
  EXPECT_NEAR(arm.drive(2).axis().velocity(), 0.0, 1e-3);
  EXPECT_NE(arm.drive(1).power(), PowerState::kOperationEnabled);
}

TEST_P(EachMode, ADriveThatDoesNotSwitchOnIsNotArmed) {
  Arm arm(GetParam());
  arm.drive(2).set_without_mains(true);
  EXPECT_NE(arm.arm(), CommandStage::kDone);
  EXPECT_THAT(arm.reason("Drive2"),
              HasSubstr("the drive does not switch on: it is ready to switch on"));
  EXPECT_FALSE(arm.armed());
  arm.run_for(500ms);
  for (unsigned node = 1; node <= 2; ++node) {
    EXPECT_EQ(arm.drive(node).power(), PowerState::kSwitchOnDisabled) << node;
    EXPECT_NEAR(arm.drive(node).axis().position(), 0.0, 1e-6) << node;
  }
}

TEST_P(EachMode, ADriveThatHearsNoSyncStopsTheArm) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  arm.begin_motion();
  arm.drive(1).set_deaf_to_sync(true);
  arm.expect_rest_within(500ms);
  EXPECT_EQ(arm.state("Drive1"), State::kException);
}

/// Where the operator finds it, and says so: its encoder may have lost its place.
TEST_P(EachMode, ADriveThatRebootedIsPreparedAgainAtTheOperatorsWord) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  arm.drive(1).reboot(arm.bus().bus().now());
  arm.run_for(200ms);
  ASSERT_EQ(arm.reason("Drive1"),
            "the drive rebooted: call resetDrive of its bus, which prepares it again");
  ASSERT_TRUE(arm.application().call("Bus", "resetDrive", {types::Value::of(1)}));
  arm.run_for(500ms);
  EXPECT_EQ(arm.drive(1).device().state(), canopen::NmtState::kOperational);
  arm.put_back_to_service();
  EXPECT_NE(arm.arm(), CommandStage::kDone) << "nobody has looked where it is";
  ASSERT_TRUE(
      arm.application().set_property("Drive1", "position_confirmed", types::Value::of(true)));
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  EXPECT_EQ(arm.move_to({0.5, 0.5}), CommandStage::kDone);
  arm.run_for(500ms);
  EXPECT_NEAR(arm.at(1), 0.5, 5e-3);
}

/// As at an orderly stop of the application: nobody speaks to the drives any more.
TEST_P(EachMode, AStopInMotionIsQuickAndSwitchesOff) {
  Arm arm(GetParam());
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  arm.begin_motion();
  const double there = arm.drive(1).axis().position();
  ASSERT_TRUE(arm.application().stop_component("Bus"));
  const base::Time stopped = arm.bus().bus().now();
  for (base::Duration passed{}; passed < 200ms; passed += 50us) {
    arm.bus().advance_to(stopped + passed);
  }
  for (unsigned node = 1; node <= 2; ++node) {
    EXPECT_EQ(arm.drive(node).power(), PowerState::kSwitchOnDisabled);
    EXPECT_NEAR(arm.drive(node).axis().velocity(), 0.0, 1e-3);
  }
  EXPECT_LT(arm.drive(1).axis().position() - there, 0.05) << "1.5 rad/s, 50 rad/s^2";
}

INSTANTIATE_TEST_SUITE_P(Cia402, EachMode,
                         ::testing::Values("torque.yaml", "velocity.yaml", "position.yaml"),
                         [](const auto& info) {
                           const std::string file = info.param;
                           return file.substr(0, file.find('.'));
                         });

/// To a drive that follows positions 0 would be a place to go to.
TEST(Cia402Mode, AnEffortIsNoPosition) {
  Arm arm("meddled.yaml");
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  ASSERT_EQ(arm.move_to({1.0, 1.0}), CommandStage::kDone);
  arm.run_for(200ms);
  EXPECT_NEAR(arm.at(1), 1.0, 5e-3);
  const auto& meddler = *static_cast<const Meddler*>(arm.application().find("Meddler"));
  EXPECT_EQ(meddler.taken, 0);
  EXPECT_GT(meddler.refused, 100);
}

/// One joint follows positions, the other velocities, on one bus.
TEST(Cia402Mode, DrivesOfOneBusCanHaveTheirOwn) {
  Arm arm("mixed.yaml");
  ASSERT_EQ(arm.started, "");
  EXPECT_EQ(arm.drive(1).mode(), Mode::kCyclicPosition);
  EXPECT_EQ(arm.drive(2).mode(), Mode::kCyclicVelocity);
  ASSERT_EQ(arm.arm(), CommandStage::kDone) << arm.reason("Arming");
  static_cast<Turner*>(arm.application().find("Turner"))->velocity = 0.2;
  arm.run_for(1s);
  EXPECT_NEAR(arm.drive(1).axis().position(), 0.0, 1e-3);
  EXPECT_NEAR(arm.drive(2).axis().velocity(), 0.2, 0.01);
  EXPECT_EQ(arm.application().faults(), 0u);
}

TEST(Cia402Values, CurrentTemperatureAndStatusAreOnPorts) {
  Arm arm("torque.yaml", {"Drive1.temperature=0x2001:00", "Drive1.temperature_scale=0.1"});
  ASSERT_EQ(arm.started, "");
  EXPECT_NEAR(arm.value<double>("Drive1", "Temperature"), 298.15, 0.1);
  ASSERT_EQ(arm.arm(), CommandStage::kDone);
  const auto status = arm.value<DriveStatus>("Drive1", "Status");
  EXPECT_TRUE(status.operation_enabled);
  EXPECT_TRUE(status.follows);
  EXPECT_FALSE(status.fault || status.quick_stop || status.switch_on_disabled);
  arm.begin_motion();
  EXPECT_NE(arm.value<double>("Drive1", "Current"), 0.0);
}

TEST(Cia402Values, ATemperatureThatIsNoAddressIsRefused) {
  EXPECT_THAT(load("torque.yaml", {"Drive1.temperature=hot"}).diagnostics.to_text(),
              HasSubstr("'Drive1': temperature is 'hot' (write index and subindex"));
}

// --- what is refused before anything moves -------------------------------------------------------

TEST(Cia402Check, ModeAndKindOfJointHaveToFit) {
  EXPECT_THAT(load("position.yaml", {"mode=velocity"}).diagnostics.to_text(),
              HasSubstr("its input PositionActuator has a writer, and the mode of 'Bus' needs "
                        "VelocityActuator"));
  EXPECT_THAT(load("position.yaml", {"Drive2.mode=torque"}).diagnostics.to_text(),
              HasSubstr("'Drive2': its input PositionActuator has a writer, and its mode needs "
                        "TorqueActuator"));
}

TEST(Cia402Check, ADriveHasToBeOnItsBus) {
  EXPECT_THAT(load("position.yaml", {"Drive2.node=5"}).diagnostics.to_text(),
              HasSubstr("'Drive2': node 5 is not among the nodes of 'Bus'"));
}

}  // namespace
}  // namespace armature::cia402
