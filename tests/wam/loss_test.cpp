// SPDX-License-Identifier: Apache-2.0
// What becomes of the arm in motion when pucks, its bus, its board or its host are lost.
#include <stdexcept>

#include "tests/wam/in_motion.hpp"

namespace armature::wam {
namespace {

TEST_F(WamInMotion, ASilentPuckIsNamedWithinThreeCyclesAndTheOthersBrake) {
  arm.emulator().puck(2).set_dead(true);
  arm.run_for(4 * Arm::kPeriod);
  for (std::size_t i = 0; i < arm.joints(); ++i) {
    EXPECT_TRUE(i == 2 || arm.emulator().puck(i).mode() == PuckMode::kIdle) << i;
  }
  arm.emulator().puck(2).set_dead(false);
  expect_fault_within(50ms, "puck 3 is silent");
  expect_braked();
  return_to_service();
  expect_moves_only_once_armed();
}

/// Its motor would go on as it was told last, and nobody could tell it otherwise.
TEST_F(WamInMotion, APuckThatStaysSilentHasItsPowerCutAndTheArmHasToBePutAtHome) {
  arm.emulator().puck(2).set_dead(true);
  expect_fault_within(60ms, "puck 3 is silent, and may drive on as it was told last");
  EXPECT_EQ(board().mode(), BoardMode::kEstop);
  expect_braked();
  ASSERT_TRUE(arm.application().reset_component("WAM"));
  EXPECT_FALSE(arm.application().start_component("WAM"));
  arm.emulator().puck(2).set_dead(false);
  ASSERT_TRUE(arm.application().clean_up_component("WAM"));
  ASSERT_TRUE(arm.application().start_component("WAM"));
  start_stopped();
  arm.run_for(1s);
  EXPECT_EQ(arm.safety_state(), "ACTIVATED");
  expect_moves_only_once_armed();
}

/// What tells the pucks that they are idle is lost too, so it is said in every cycle.
TEST_F(WamInMotion, PucksThatMissedThatTheyAreIdleHearItAsSoonAsTheyHear) {
  arm.emulator().bus().lose_next(40);
  expect_fault_within(60ms, "every puck is silent");
  expect_braked();
  EXPECT_NE(board().mode(), BoardMode::kEstop);
  return_to_service();
  expect_moves_only_once_armed();
}

TEST_F(WamInMotion, AnExceptionOfTheHardwareHasThePucksBrakedAtOnce) {
  arm.application().run_in_thread_of(*arm.application().find("WAM"),
                                     [] { throw std::runtime_error("out of order"); });
  expect_braked();
  EXPECT_EQ(board().mode(), BoardMode::kActive) << "its heartbeat is missed later";
  expect_fault_within(10ms, "out of order");
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
  expect_fault_within(2 * Arm::kPeriod,
                      "press E-stop, motors may go on as they were told last; the bus is off");
  EXPECT_TRUE(arm.reason("WAM").starts_with("press E-stop"));
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
  EXPECT_THAT(arm.safety_state(), ::testing::StartsWith("ACTIVATED, said last 0.1"));
  EXPECT_THAT(arm.safety_state(), ::testing::EndsWith("s before it was found silent"));
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

TEST_F(WamInMotion, AHostThatGoesSilentIsStoppedByTheBoard) {
  arm.let_emulator_run(150ms);
  EXPECT_TRUE(arm.pucks_are_idle());
  EXPECT_EQ(board().mode(), BoardMode::kIdle);
}

}  // namespace
}  // namespace armature::wam
