// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/safety_board.hpp"

#include <chrono>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/wam/emulator/test_bench.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The cycle of a host, 500 times a second.
void run_cycles(Bench& bench, int cycles) {
  for (int i = 0; i < cycles; ++i) {
    bench.send("404#30");
    bench.advance(1ms);
    bench.send("401#AA00000000000000");
    bench.advance(1ms);
  }
}

/// The motor's velocity that turns joint 1 so that the outstretched tip moves at this speed [m/s].
double motor_speed(double tip_speed) { return -42.0 * tip_speed / 0.9; }

/// The arm stretched out sideways, as the pucks count it, and active.
struct Outstretched : Bench {
  Outstretched() : Bench(4) {
    rotors.set_state(1, 28.25 * std::numbers::pi / 2.0, 0.0);
    rotors.set_state(2, -28.25 * std::numbers::pi / 2.0, 0.0);
    wake_up();
    tell("00A#B70005000000");
    for (const char* set :
         {"001#B00000000000", "002#B00000710000", "003#B000008FFFFF", "004#B00000000000"}) {
      tell(set);
    }
    tell("00A#AA0001000000");
    run_cycles(*this, 10);
    board().shift_activate();
    advance(1ms);
    log.clear();
  }
  Level velocity() { return board().pendant().level(Monitor::kVelocity); }
  void turn(double tip_speed) { rotors.set_state(0, rotors.angle(0), motor_speed(tip_speed)); }
};

// ---- Modes and keys

TEST(SafetyBoard, AnswersInEstopToo) {
  Bench bench;
  EXPECT_THAT(bench.tell("00A#05"), ElementsAre("546#85000200"));
  EXPECT_THAT(bench.tell("00A#08"), ElementsAre("546#88000000"));
  EXPECT_THAT(bench.tell("00A#01"), ElementsAre("546#81000200"));
  EXPECT_THAT(bench.tell("00A#00"), ElementsAre("546#8000C800"));
  EXPECT_THAT(bench.tell("00A#2B"), ElementsAre("546#AB0049127900"));
}

TEST(SafetyBoard, LeavesEstopOnlyWhenTheButtonIsOut) {
  Bench bench;
  bench.board().shift_idle();
  EXPECT_EQ(bench.board().mode(), BoardMode::kEstop);
  bench.board().reset();
  EXPECT_EQ(bench.board().mode(), BoardMode::kEstop);
  bench.board().shift_activate();
  EXPECT_EQ(bench.board().mode(), BoardMode::kEstop);
  bench.board().shift_idle();
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
}

TEST(SafetyBoard, TellsThePucksTheirModes) {
  Bench bench(4);
  bench.wake_up();
  bench.board().shift_activate();
  bench.advance(1ms);
  EXPECT_THAT(bench.take_others(), ElementsAre("540#880002000000"));
  EXPECT_EQ(bench.puck(4).mode(), PuckMode::kTorque);
  bench.board().shift_idle();
  bench.advance(1ms);
  EXPECT_THAT(bench.take_others(), ElementsAre("540#880000000000"));
  EXPECT_EQ(bench.puck(4).mode(), PuckMode::kIdle);
}

TEST(SafetyBoard, ItsBroadcastMayHaveFourBytes) {
  auto config = Emulator::standard(4);
  config.board.broadcasts = Width::kTwo;
  Bench bench(config);
  bench.wake_up();
  bench.board().shift_activate();
  bench.advance(1ms);
  EXPECT_THAT(bench.take_others(), ElementsAre("540#88000200"));
  EXPECT_EQ(bench.puck(1).mode(), PuckMode::kTorque);
}

TEST(SafetyBoard, LetsTheHostLowerItsModeOnly) {
  Bench bench(4);
  bench.wake_up();
  EXPECT_THAT(bench.tell("00A#880002000000"), IsEmpty());
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  bench.board().shift_activate();
  bench.tell("00A#880001000000");
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  EXPECT_EQ(bench.puck(1).mode(), PuckMode::kIdle);
  bench.tell("00A#880000000000");
  EXPECT_EQ(bench.board().mode(), BoardMode::kEstop);
  EXPECT_THAT(bench.tell("001#05"), IsEmpty());
  bench.tell("00A#880001000000");
  EXPECT_EQ(bench.board().mode(), BoardMode::kEstop);
  EXPECT_EQ(bench.board().counters().refused, 2u);
}

TEST(SafetyBoard, OldFirmwareRefusesModesOfTheHost) {
  auto config = Emulator::standard(4);
  config.board.version = 196;
  Bench bench(config);
  bench.wake_up();
  bench.tell("00A#880000000000");
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
}

TEST(SafetyBoard, ThePendantShowsKeysAndLamps) {
  Bench bench(4);
  bench.wake_up();
  EXPECT_THAT(bench.tell("00A#2B"), ElementsAre("546#AB0049123F0D"));
  bench.board().shift_activate();
  EXPECT_EQ(bench.board().pendant().key, PendantKey::kActivate);
  EXPECT_TRUE(bench.board().pendant().activate_lamp);
  EXPECT_FALSE(bench.board().pendant().idle_lamp);
  run_cycles(bench, 60);
  EXPECT_EQ(bench.board().pendant().key, PendantKey::kNone);
}

// ---- What is supervised

TEST(SafetyBoard, ATorqueBeyondItsLimitIsAFaultWhenActive) {
  Bench bench(4);
  bench.wake_up();
  bench.send("401#AA7FFE0017FFE001");
  bench.advance(1ms);
  EXPECT_EQ(bench.board().pendant().level(Monitor::kTorque), Level::kSafe) << "not in idle";
  bench.board().shift_activate();
  bench.send(
      std::string(can::to_text(torque_frame(Group::kLowerArm, 42, {0, -4800, 0, 0})).view()));
  bench.advance(1ms);
  EXPECT_EQ(bench.board().pendant().level(Monitor::kTorque), Level::kWarning);
  bench.send(std::string(can::to_text(torque_frame(Group::kLowerArm, 42, {0, 0, 5204, 0})).view()));
  bench.advance(1ms);
  EXPECT_EQ(bench.board().mode(), BoardMode::kActive) << "at the limit";
  bench.send(std::string(can::to_text(torque_frame(Group::kWrist, 42, {0, 0, -5205, 0})).view()));
  bench.advance(1ms);
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  EXPECT_EQ(bench.board().pendant().level(Monitor::kTorque), Level::kFault);
}

TEST(SafetyBoard, AFaultStaysUntilShiftIdle) {
  Bench bench(4);
  bench.activate();
  bench.tell("00A#AA0001000000");
  bench.board().fail(Monitor::kOther);
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  bench.board().shift_activate();
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  bench.board().shift_idle();
  EXPECT_EQ(bench.board().pendant().level(Monitor::kOther), Level::kSafe);
  bench.board().shift_activate();
  EXPECT_EQ(bench.board().mode(), BoardMode::kActive);
  EXPECT_TRUE(bench.board().zeroed());
}

TEST(SafetyBoard, ASilentHostIsAFaultOnceTheArmWasActive) {
  Bench bench(4);
  bench.wake_up();
  bench.advance(1s);
  EXPECT_EQ(bench.board().pendant().level(Monitor::kHeartbeat), Level::kSafe);
  bench.board().shift_activate();
  bench.advance(99ms);
  EXPECT_EQ(bench.board().mode(), BoardMode::kActive);
  bench.advance(1ms);
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  EXPECT_EQ(bench.board().pendant().level(Monitor::kHeartbeat), Level::kFault);
}

TEST(SafetyBoard, PositionsOrTorquesAloneAreAHeartbeat) {
  for (const char* beat : {"404#30", "401#AA00000000000000"}) {
    Bench bench(4);
    bench.activate();
    for (int i = 0; i < 100; ++i) {
      bench.send(beat);
      bench.advance(10ms);
    }
    EXPECT_EQ(bench.board().mode(), BoardMode::kActive) << beat;
  }
}

TEST(SafetyBoard, TheTipIsSupervised) {
  Outstretched bench;
  bench.turn(0.45);
  run_cycles(bench, 5);
  EXPECT_EQ(bench.velocity(), Level::kSafe);
  bench.turn(0.8);
  run_cycles(bench, 5);
  EXPECT_EQ(bench.velocity(), Level::kWarning);
  bench.turn(0.0);
  run_cycles(bench, 5);
  EXPECT_EQ(bench.velocity(), Level::kSafe);
  bench.turn(1.1);
  run_cycles(bench, 5);
  EXPECT_EQ(bench.velocity(), Level::kFault);
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  EXPECT_TRUE(bench.board().zeroed());
  EXPECT_EQ(bench.board().pendant().display, '0');
}

TEST(SafetyBoard, WithoutLimitNoVelocityIsTooHigh) {
  Outstretched bench;
  bench.tell("00A#AE0000000000");
  bench.turn(5.0);
  run_cycles(bench, 5);
  EXPECT_EQ(bench.board().mode(), BoardMode::kActive);
}

TEST(SafetyBoard, AVelocityThatStaysTooHighLeadsToEstop) {
  Outstretched bench;
  bench.turn(1.5);
  for (int i = 0; i < 240; ++i) {
    bench.turn(1.5);  // somebody pushes
    run_cycles(bench, 1);
  }
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  for (int i = 0; i < 20; ++i) {
    bench.turn(1.5);
    run_cycles(bench, 1);
  }
  EXPECT_EQ(bench.board().mode(), BoardMode::kEstop);
  EXPECT_FALSE(bench.board().zeroed());
}

TEST(SafetyBoard, AVelocityThatGoesDownLeadsToNothingMore) {
  Outstretched bench;
  bench.turn(1.5);
  run_cycles(bench, 5);
  bench.turn(0.0);
  run_cycles(bench, 500);
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
}

TEST(SafetyBoard, AStepOfPositionsIsAVelocityUnlessItIsToldToIgnoreIt) {
  for (const bool told : {false, true}) {
    Bench bench(4);
    bench.wake_up();
    run_cycles(bench, 5);
    if (told) bench.tell("00A#B70005000000");
    bench.tell("002#B0001F70FFFF");
    run_cycles(bench, 5);
    EXPECT_EQ(bench.board().pendant().level(Monitor::kVelocity),
              told ? Level::kSafe : Level::kFault);
  }
}

TEST(SafetyBoard, TheSupplyIsSupervised) {
  Bench bench(4);
  bench.activate();
  bench.board().set_supply(35.0);
  EXPECT_EQ(bench.board().pendant().level(Monitor::kVoltage), Level::kWarning);
  bench.board().set_supply(29.0);
  EXPECT_EQ(bench.board().pendant().level(Monitor::kVoltage), Level::kFault);
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle);
  bench.board().shift_idle();
  bench.board().shift_activate();
  EXPECT_EQ(bench.board().mode(), BoardMode::kIdle) << "the fault is still there";
  bench.board().set_supply(48.0);
  bench.board().shift_idle();
  bench.board().shift_activate();
  EXPECT_EQ(bench.board().mode(), BoardMode::kActive);
}

TEST(SafetyBoard, LimitsGoBackToTheirDefaults) {
  Bench bench;
  bench.tell("00A#AE000020");
  EXPECT_THAT(bench.tell("00A#2E"), ElementsAre("546#AE000020"));
  bench.tell("00A#A0002E000000");
  bench.tell("00A#9F002E000000");
  EXPECT_THAT(bench.tell("00A#2E"), ElementsAre("546#AE000010"));
  EXPECT_THAT(bench.tell("00A#2D"), ElementsAre("546#AD000008"));
  EXPECT_THAT(bench.tell("00A#2F"), ElementsAre("546#AF007B12"));
  EXPECT_THAT(bench.tell("00A#30"), ElementsAre("546#B0005414"));
}

// ---- Faults on demand

TEST(SafetyBoard, LosesAndDelaysAnswersAsWanted) {
  Bench bench;
  bench.board().lose_replies(1);
  EXPECT_THAT(bench.tell("00A#08"), IsEmpty());
  bench.board().delay_replies(5ms);
  EXPECT_THAT(bench.tell("00A#08"), IsEmpty());
  bench.advance(4ms);
  EXPECT_THAT(bench.take_others(), ElementsAre("546#88000000"));
}

TEST(SafetyBoard, MayBeDead) {
  Bench bench;
  bench.power_up();
  bench.board().set_dead(true);
  EXPECT_THAT(bench.tell("00A#05"), IsEmpty());
}

TEST(SafetyBoard, MayHaveSixBytesForEveryAnswer) {
  auto config = Emulator::standard(4);
  config.board.replies = ReplyWidth::kAlwaysSix;
  Bench bench(config);
  EXPECT_THAT(bench.tell("00A#08"), ElementsAre("546#880000000000"));
}

}  // namespace
}  // namespace armature::wam
