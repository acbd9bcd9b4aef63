// SPDX-License-Identifier: Apache-2.0
// The arm in each state of its safety board, and what becomes of it in motion when something
// breaks: each loss is found in time and named, and nobody but the operator lets it move again.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/can/frame.hpp"
#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using component::State;
using ::testing::HasSubstr;
using ::testing::Not;

const Vector kTarget{0.6, -1.0, 0.4, 2.0, -0.5, 0.4, 0.5};

// ---- Until it is armed

TEST(WamSafety, ConfiguresOnlyAnArmThatTheOperatorHasBroughtToIdle) {
  Arm arm("npid7.yaml", {"WAM.emulated_operator=false"});
  const auto started = arm.application().start();
  EXPECT_FALSE(started.ok());
  EXPECT_THAT(started.to_text(), HasSubstr("the safety board is in E-STOP, expected IDLE within 5 "
                                           "s: pull the E-stop button out, press Shift+Idle"));
}

TEST(WamSafety, PositionsAreWrittenOnlyIfTheOperatorSaysThatTheArmIsAtHome) {
  Arm arm("npid7.yaml", {"WAM.emulated_operator=false"});
  ASSERT_FALSE(arm.application().start().ok());
  arm.emulator().board().reset();
  arm.emulator().board().shift_idle();
  const auto started = arm.application().start();
  EXPECT_THAT(started.to_text(), HasSubstr("put the arm at home (0, -2, 0, 3.13, 0, 0, 0) rad, "
                                           "then set at_home: true"));
  EXPECT_FALSE(arm.emulator().board().zeroed());
}

TEST(WamSafety, IdleItIsReadAndSendsTorquesOfZeroInEachCycleUntilItIsActivated) {
  Arm arm("npid7.yaml");
  arm.start();
  arm.set("WAM", "emulated_operator", false);
  int torque_frames = 0;
  bool others = false;
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

TEST(WamSafety, UnarmedItPassesNoCommand) {
  Arm arm("npid7.yaml");
  arm.start_active();
  ASSERT_EQ(arm.move_to(kTarget, 3.0), "");
  const Vector before = arm.positions();
  arm.run_for(4s);
  EXPECT_LT(largest_apart(arm.positions(), before), 0.002);
}

/// Also where the controller desired something else before.
TEST(WamSafety, ArmingMovesNothingAndMakesNoStep) {
  for (const char* file : {"npid7.yaml", "computed_torque7.yaml"}) {
    Arm arm(file);
    arm.start_active();
    ASSERT_EQ(arm.move_to(kTarget, 1.0), "");
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

class WamInMotion : public ::testing::Test {
 protected:
  WamInMotion() : arm("npid7.yaml") {
    arm.start_armed();
    EXPECT_EQ(arm.move_to(kTarget, 5.0), "");
    arm.run_for(2500ms);
  }
  SafetyBoard& board() { return arm.emulator().board(); }
  /// Out of service within that time, with a reason.
  void expect_fault_within(base::Duration time, const std::string& why) {
    arm.run_for(time);
    EXPECT_EQ(arm.state("WAM"), State::kException);
    EXPECT_THAT(arm.reason("WAM"), HasSubstr(why));
    arm.run_for(20ms);
    EXPECT_FALSE(arm.armed());
  }
  void expect_braked() {
    arm.let_emulator_run(2ms);
    for (std::size_t i = 0; i < arm.joints(); ++i) {
      const Puck& puck = arm.emulator().puck(i);
      EXPECT_TRUE(puck.state() == PuckState::kOff || puck.mode() == PuckMode::kIdle) << i;
    }
  }
  void expect_rests() {
    const Vector rest = arm.positions();
    arm.run_for(5s);
    EXPECT_LT(largest_apart(arm.positions(), rest), 0.002);
  }
  /// Of a motor's torque from cycle to cycle [Nm].
  double largest_step_of(int cycles) {
    Vector torques = arm.motor_torques();
    double step = 0.0;
    for (int cycle = 0; cycle < cycles; ++cycle) {
      arm.cycle();
      step = std::max(step, largest_apart(arm.motor_torques(), torques));
      torques = arm.motor_torques();
    }
    return step;
  }
  void return_to_service() {
    ASSERT_TRUE(arm.application().reset_component("WAM")) << arm.reason("WAM");
    ASSERT_TRUE(arm.application().start_component("WAM")) << arm.reason("WAM");
    start_stopped();
    arm.run_for(1s);
    ASSERT_EQ(arm.safety_state(), "ACTIVATED") << arm.waits_for() << arm.log;
  }
  /// Those that a reaction stopped with it, writers first.
  void start_stopped() {
    for (const char* name : {"Sensor", "BridgeRef", "Reference", "Generator", "Controller"})
      start(name);
    for (int i = 1; i <= 7; ++i) start("PID" + std::to_string(i));
    for (const char* name : {"Actuator", "Arming"}) start(name);
  }
  void start(const std::string& name) {
    if (arm.state(name.c_str()) != State::kStopped) return;
    EXPECT_TRUE(arm.application().start_component(name)) << name;
  }
  /// Nothing moves until it is armed; then a motion is made as if nothing had happened.
  void expect_moves_only_once_armed() {
    const Vector rest = arm.positions();
    arm.run_for(2s);
    EXPECT_LT(largest_apart(arm.positions(), rest), 0.003) << "nothing goes on by itself";
    EXPECT_FALSE(arm.armed());
    arm.arm();
    arm.run_for(1s);
    EXPECT_LT(largest_apart(arm.positions(), rest), 0.005) << "arming moves nothing";
    ASSERT_EQ(arm.move_to(kTarget, 5.0), "");
    arm.run_for(7s);
    EXPECT_LT(largest_apart(arm.positions(), kTarget), 0.01);
    EXPECT_TRUE(arm.armed());
  }

  Arm arm;
};

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

TEST_F(WamInMotion, ASilentPuckIsNamedWithinThreeCyclesAndTheOthersBrake) {
  arm.emulator().puck(2).set_dead(true);
  arm.run_for(4 * Arm::kPeriod);
  for (std::size_t i = 0; i < arm.joints(); ++i) {
    EXPECT_TRUE(i == 2 || arm.emulator().puck(i).mode() == PuckMode::kIdle) << i;
  }
  expect_fault_within(50ms, "puck 3 is silent");
  arm.emulator().puck(2).set_dead(false);
  return_to_service();
  expect_moves_only_once_armed();
}

TEST_F(WamInMotion, ALostAnswerIsCountedAndTheMotionGoesOn) {
  arm.emulator().puck(3).lose_replies(1);
  arm.run_for(5s);
  EXPECT_GE(arm.value<int>("WAM", "lost_answers"), 1);
  EXPECT_TRUE(arm.armed());
  EXPECT_LT(largest_apart(arm.positions(), kTarget), 0.01);
}

TEST_F(WamInMotion, BusOffIsFoundInTheCycleAndNamed) {
  arm.hardware().emulated()->station().force_bus_off();
  expect_fault_within(2 * Arm::kPeriod, "the bus is off or unplugged");
  arm.let_emulator_run(150ms);
  expect_braked();
  return_to_service();
  expect_moves_only_once_armed();
}

TEST_F(WamInMotion, AnUnpluggedBusIsFoundAndTheBoardMissesItsHeartbeat) {
  arm.emulator().bus().set_cut(true);
  arm.run_for(100ms);
  EXPECT_EQ(arm.state("WAM"), State::kException);
  EXPECT_FALSE(arm.armed());
  arm.let_emulator_run(200ms);
  EXPECT_EQ(board().mode(), BoardMode::kIdle);
}

TEST_F(WamInMotion, ASilentSafetyBoardIsNamed) {
  board().set_dead(true);
  expect_fault_within(300ms, "the safety board is silent");
}

TEST_F(WamInMotion, ATorqueReferenceThatStaysAwayDisarmsItAndItIsBrakedSmoothlyAndHeld) {
  const Vector at = arm.positions();
  ASSERT_TRUE(arm.application().stop_component("Controller"));
  EXPECT_LT(largest_step_of(1000), 0.1) << "of 1.8 Nm that a motor may have";
  EXPECT_EQ(arm.state("WAM"), State::kRunning);
  EXPECT_FALSE(arm.armed());
  EXPECT_THAT(arm.log, HasSubstr("no torques come any more"));
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
    for (component::OutputPortBase* port : controller->interface().outputs) {
      if (port->name() != "act") continue;
      const Vector torques(7, std::numeric_limits<double>::quiet_NaN());
      static_cast<void>(static_cast<component::OutputPort<Vector>*>(port)->write(torques));
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

TEST_F(WamInMotion, AHostThatGoesSilentIsStoppedByTheBoard) {
  arm.let_emulator_run(150ms);
  EXPECT_TRUE(arm.pucks_are_idle());
  EXPECT_EQ(board().mode(), BoardMode::kIdle);
}

TEST_F(WamInMotion, APuckThatHasLostItsZeroIsNamedAndTheArmHasToBePutAtHome) {
  const int number = arm.hardware().driver().arm().position_number;
  arm.hardware().emulated()->station().send(set_frame(to_node(6), number, 20000));
  expect_fault_within(5 * Arm::kPeriod, "puck 6 told a position that cannot be");
  expect_braked();
  ASSERT_TRUE(arm.application().reset_component("WAM"));
  EXPECT_FALSE(arm.application().start_component("WAM"));
  arm.let_emulator_run(2ms);
  EXPECT_FALSE(board().zeroed()) << "whoever asks it next has to write the home position again";
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

TEST(WamHome, IsRefusedUnarmed) {
  Arm arm("npid4.yaml");
  arm.start_active();
  EXPECT_THAT(arm.call("WAM", "moveHome"), HasSubstr("the arm is not armed"));
}

TEST(WamTwice, TwoRunsAreTheSameToTheBit) {
  const auto run = [] {
    Arm arm("npid7.yaml");
    arm.start_armed();
    EXPECT_EQ(arm.move_to(kTarget, 5.0), "");
    arm.run_for(3s);
    return arm.positions();
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace armature::wam
