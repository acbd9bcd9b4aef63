// SPDX-License-Identifier: Apache-2.0
// The arm in each state of its safety board, and what becomes of its motion when the operator, the
// board or a controller ends it: nobody but the operator lets it move again.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/can/frame.hpp"
#include "armature/component/interface.hpp"
#include "tests/wam/in_motion.hpp"

namespace armature::wam {
namespace {

using ::testing::HasSubstr;

// ---- Until it is armed

TEST(WamSafety, ConfiguresOnlyAnArmThatTheOperatorHasBroughtToIdle) {
  Arm arm("npid7.yaml", {"WAM.emulated_operator=false"});
  const auto started = arm.application().start();
  EXPECT_FALSE(started.ok());
  EXPECT_THAT(started.to_text(), HasSubstr("the safety board is in E-STOP, expected IDLE within 5 "
                                           "s: pull the E-stop button out, press Shift+Idle"));
}

TEST(WamSafety, WhoeverWalksToThePendantIsWaitedForAndToldTheTimeThatIsLeft) {
  Arm arm("npid7.yaml", {"WAM.emulated_operator=false", "WAM.idle_patience=40"});
  EXPECT_EQ(arm.hardware().operators_patience(), 40s) << "it is not taken for one that hangs";
  EXPECT_THAT(arm.application().start().to_text(), HasSubstr("expected IDLE within 40 s"));
  for (const char* left : {"waits 40 s for it", "waits 25 s for it", "waits 10 s for it"}) {
    EXPECT_THAT(arm.log, HasSubstr(left));
  }
}

TEST(WamSafety, PositionsAreWrittenOnlyIfTheOperatorSaysThatTheArmIsAtHome) {
  Arm arm("npid7.yaml", {"WAM.emulated_operator=false"});
  ASSERT_FALSE(arm.application().start().ok());
  arm.emulator().board().reset();
  arm.emulator().board().shift_idle();
  const auto started = arm.application().start();
  EXPECT_THAT(started.to_text(), HasSubstr("put the arm at home (0, -2, 0, 3.13, 0, 0, 0) rad, "
                                           "set WAM.at_home = true"));
  EXPECT_FALSE(arm.emulator().board().zeroed());
}

TEST(WamSafety, ThatTheArmIsAtHomeIsBelievedOnce) {
  Arm arm("npid7.yaml", {"at_home=true"});
  arm.start_active();
  EXPECT_FALSE(arm.value<bool>("WAM", "at_home"))
      << "the start has taken it, though it needed none";
  arm.set("WAM", "emulated_operator", false);
  arm.set("WAM", "at_home", true);  // before what makes it false
  ASSERT_EQ(arm.call("WAM", "estop"), "");
  arm.run_for(50ms);
  exec::Application& application = arm.application();
  ASSERT_TRUE(application.reset_component("WAM"));
  ASSERT_EQ(arm.call("WAM", "releaseEstop"), "") << "while it does not run";
  ASSERT_EQ(arm.call("WAM", "shiftIdle"), "");
  ASSERT_TRUE(application.clean_up_component("WAM"));
  const auto refused = application.start_component("WAM");
  EXPECT_FALSE(refused);
  EXPECT_THAT(std::string(refused.reason()), HasSubstr("set WAM.at_home = true"));
  EXPECT_FALSE(arm.emulator().board().zeroed());
  arm.set("WAM", "at_home", true);
  EXPECT_TRUE(application.start_component("WAM")) << arm.reason("WAM");
  EXPECT_TRUE(arm.emulator().board().zeroed());
  EXPECT_FALSE(arm.value<bool>("WAM", "at_home"));
}

TEST(WamSafety, NoFileSaysThatTheArmIsAtHomeAndNoScriptWithoutAGrant) {
  Arm arm("npid7.yaml");
  arm.start();
  const auto set = arm.application().set_property("WAM", "at_home", types::Value::of(true),
                                                  exec::Caller::kScript);
  EXPECT_THAT(set.error(), HasSubstr("grants: {script: [WAM.at_home]}"));
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  const auto path = std::filesystem::temp_directory_path() / "armature_at_home.yaml";
  std::ofstream(path) << "include: "
                      << std::filesystem::absolute(WAM "/deployments/npid7.yaml").string()
                      << "\nparameters: {at_home: true}\n";
  const deploy::Deployment deployment = deploy::load_deployment(path.string(), options);
  std::filesystem::remove(path);
  EXPECT_THAT(
      deployment.diagnostics.to_text(),
      HasSubstr(
          "'WAM.at_home' is the operator's word, which counts once, so a file cannot give it"));
}

TEST(WamSafety, IdleItIsReadAndSendsTorquesOfZeroInEachCycleUntilItIsActivated) {
  int torque_frames = 0;
  bool others = false;
  Arm arm("npid7.yaml");  // whose bus tells of frames to its end
  arm.start();
  arm.set("WAM", "emulated_operator", false);
  arm.emulator().bus().set_tap([&](const can::WireEvent& event) {
    if (event.frame.id != 0x401 && event.frame.id != 0x402) return;
    ++torque_frames;
    others = others || std::any_of(event.frame.data.begin() + 1, event.frame.data.begin() + 8,
                                   [](auto byte) { return byte != decltype(byte){}; });
  });
  arm.run_for(1s);
  EXPECT_NEAR(torque_frames, 1000, 2);
  EXPECT_FALSE(others);
  EXPECT_EQ(arm.safety_state(), "IDLE");
  EXPECT_THAT(arm.waits_for(), HasSubstr("Shift+Activate"));
  EXPECT_NEAR(arm.value<Vector>("Sensor", "sensor")[1], -2.0, 0.01);
  EXPECT_EQ(arm.call("Arming", "arm"), "");
  arm.run_for(1500ms);
  EXPECT_FALSE(arm.armed());
  EXPECT_THAT(arm.log, HasSubstr("not armed: the arm is not active, it waits for Shift+Activate"));
}

TEST(WamSafety, ActivatedItHoldsItsWeightAndNothingMoves) {
  Arm arm("npid7.yaml");
  arm.start();
  const Vector before = arm.positions();
  double most = 0.0;
  for (int cycle = 0; cycle < 2500; ++cycle) {
    arm.cycle();
    most = std::max(most, largest_apart(arm.positions(), before));
  }
  EXPECT_EQ(arm.safety_state(), "ACTIVATED");
  EXPECT_EQ(arm.waits_for(), "");
  EXPECT_LT(most, 0.002);
  EXPECT_FALSE(arm.armed());
}

/// A puck that obeys torques and is told none lets its joint fall.
TEST(WamSafety, ActivatedItIsHeldWithinThreeCycles) {
  for (int offset = 0; offset < 30; ++offset) {
    Arm arm("npid4.yaml");
    arm.start();
    arm.set("WAM", "emulated_operator", false);
    arm.run_for(20ms + offset * Arm::kPeriod);
    arm.emulator().board().shift_activate();
    arm.run_for(3 * Arm::kPeriod);
    EXPECT_EQ(arm.hardware().torque_path().mode(), TorquePath::Mode::kHolding) << offset;
  }
}

TEST(WamSafety, UnarmedItPassesNoCommand) {
  Arm arm("npid7.yaml");
  arm.start_active();
  EXPECT_THAT(arm.move_to(kTarget, 3.0), HasSubstr("the robot is not armed: arm first"));
  const Vector before = arm.positions();
  arm.run_for(4s);
  EXPECT_LT(largest_apart(arm.positions(), before), 0.002);
}

TEST(WamSafety, ArmingMovesNothingAndMakesNoStep) {
  for (const char* file : {"npid7.yaml", "computed_torque7.yaml"}) {
    Arm arm(file);
    arm.start_active();
    arm.run_for(5s);
    const Vector before = arm.positions();
    Vector torques = arm.motor_torques();
    double step = 0.0;
    arm.call("Arming", "arm");
    for (int cycle = 0; cycle < 1000; ++cycle) {
      arm.cycle();
      step = std::max(step, largest_apart(arm.motor_torques(), torques));
      torques = arm.motor_torques();
    }
    EXPECT_TRUE(arm.armed()) << file;
    EXPECT_LT(largest_apart(arm.positions(), before), 0.003) << file;
    EXPECT_LT(step, 0.05) << file << ": of 1.8 Nm that a motor may have";
  }
}

// ---- In motion

TEST_F(WamInMotion, IdledByTheOperatorItIsDisarmedAndWaitsForTheNextActivation) {
  arm.set("WAM", "emulated_operator", false);
  ASSERT_EQ(arm.call("WAM", "shiftIdle"), "");
  arm.run_for(300ms);
  EXPECT_EQ(arm.state("WAM"), State::kRunning);
  EXPECT_FALSE(arm.armed());
  EXPECT_EQ(arm.safety_state(), "IDLE");
  EXPECT_THAT(arm.waits_for(), HasSubstr("Shift+Activate"));
  for (const double torque : arm.motor_torques()) EXPECT_EQ(torque, 0.0);
  ASSERT_EQ(arm.call("WAM", "shiftActivate"), "");
  arm.run_for(500ms);
  EXPECT_EQ(arm.safety_state(), "ACTIVATED");
  expect_moves_only_once_armed();
}

TEST_F(WamInMotion, EstopIsAFaultAndPositionsAreLostUntilItIsConfiguredAnew) {
  ASSERT_EQ(arm.call("WAM", "estop"), "");
  expect_fault_within(50ms, "E-stop, positions are lost");
  expect_braked();
  exec::Application& application = arm.application();
  ASSERT_TRUE(application.reset_component("WAM"));
  const auto started = application.start_component("WAM");
  EXPECT_FALSE(started);
  EXPECT_THAT(std::string(started.reason()), HasSubstr("put the arm at home"));
  ASSERT_TRUE(application.clean_up_component("WAM"));
  ASSERT_TRUE(application.start_component("WAM"));
  start_stopped();
  arm.run_for(1s);
  EXPECT_EQ(arm.safety_state(), "ACTIVATED");
  EXPECT_NEAR(arm.positions()[1], -2.0, 0.01) << "the operator has carried it home";
  expect_moves_only_once_armed();
}

struct BoardFault {
  Monitor monitor;
  const char* why;
};
class WamBoardFault : public WamInMotion, public ::testing::WithParamInterface<BoardFault> {};
INSTANTIATE_TEST_SUITE_P(Of, WamBoardFault,
                         ::testing::Values(BoardFault{Monitor::kVelocity, "velocity fault"},
                                           BoardFault{Monitor::kTorque, "torque fault"},
                                           BoardFault{Monitor::kVoltage, "voltage fault"},
                                           BoardFault{Monitor::kHeartbeat, "heartbeat fault"},
                                           BoardFault{Monitor::kOther, "does not name"}),
                         [](const auto& tested) {
                           return std::string(to_text(tested.param.monitor));
                         });

TEST_P(WamBoardFault, IsNamedAndTheArmMovesOnlyOnceItIsArmedAgain) {
  board().fail(GetParam().monitor);
  expect_fault_within(200ms, GetParam().why);
  expect_braked();
  return_to_service();
  expect_moves_only_once_armed();
}

TEST_F(WamInMotion, ATorqueReferenceThatStaysAwayDisarmsItAndItIsBrakedSmoothlyAndHeld) {
  const Vector at = arm.positions();
  ASSERT_TRUE(arm.application().stop_component("Controller"));
  EXPECT_LT(largest_step_of(1000), 0.1) << "of 1.8 Nm that a motor may have";
  EXPECT_EQ(arm.state("WAM"), State::kRunning);
  EXPECT_FALSE(arm.armed());
  EXPECT_THAT(arm.log, HasSubstr("torques have stopped coming"));
  EXPECT_LT(largest_apart(arm.positions(), at), 0.05);
  expect_rests();
}

TEST_F(WamInMotion, DisarmingBrakesItSmoothlyToRestWhereItIsHeld) {
  const Vector at = arm.positions();
  ASSERT_EQ(arm.call("Arming", "disarm"), "");
  EXPECT_LT(largest_step_of(1000), 0.1) << "of 1.8 Nm that a motor may have";
  EXPECT_LT(largest_apart(arm.positions(), at), 0.05);
  expect_rests();
}

TEST_F(WamInMotion, ATorqueThatIsNoNumberIsAFaultOfWhoToldItAndTheArmIsBrakedAndHeld) {
  auto& actuator = *arm.application().find("Actuator");
  ASSERT_TRUE(arm.application().run_in_thread_of(actuator, [&] {
    auto* const controller = arm.application().find("Controller");
    for (component::OutputPortBase* port : component::interface_of(*controller).outputs) {
      if (port->name() != "act") continue;
      const Vector torques(7, std::numeric_limits<double>::quiet_NaN());
      static_cast<void>(port->write_from(&torques));
    }
  }));
  arm.run_for(2s);
  EXPECT_EQ(arm.state("Actuator"), State::kException);
  EXPECT_THAT(arm.reason("Actuator"), HasSubstr("the torque for joint 1 is nan"));
  EXPECT_EQ(arm.state("WAM"), State::kRunning);
  EXPECT_FALSE(arm.armed());
  expect_rests();
}

TEST_F(WamInMotion, StopIsASmoothMotionToRestAndTheArmStaysArmed) {
  ASSERT_EQ(arm.call("Arming", "stop"), "");
  arm.run_for(2s);
  expect_rests();
  EXPECT_TRUE(arm.armed());
}

TEST_F(WamInMotion, StoppingTheApplicationIdlesThePucks) {
  EXPECT_TRUE(arm.application().stop().ok());
  arm.let_emulator_run(5ms);
  EXPECT_TRUE(arm.pucks_are_idle());
}

TEST_F(WamInMotion, MovesHomeSlowlyOnCommand) {
  arm.run_for(5s);
  auto motion = arm.application().begin("WAM", "moveHome", {});
  ASSERT_TRUE(motion) << motion.error();
  double fastest = 0.0;
  for (int cycle = 0; cycle < 20000 && !motion.value().ended(); ++cycle) {
    arm.cycle();
    double square = 0.0;
    for (std::size_t i = 0; i < arm.joints(); ++i) {
      square += std::pow(arm.value<Vector>("Generator", "nAxesDesiredVelocity")[i], 2);
    }
    fastest = std::max(fastest, std::sqrt(square));
  }
  EXPECT_EQ(motion.value().stage(), component::CommandStage::kDone) << motion.value().reason();
  EXPECT_LE(fastest, 0.5);
  EXPECT_GT(fastest, 0.25);
  arm.run_for(1s);
  EXPECT_LT(largest_apart(arm.positions(), wam7().home), 0.005);
}

}  // namespace
}  // namespace armature::wam
