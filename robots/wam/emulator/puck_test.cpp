// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/puck.hpp"

#include <chrono>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/wam/emulator/test_bench.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kCount = kTurn / 4096.0;

// ---- Power and the monitor

TEST(Puck, WithoutPowerItIsSilent) {
  Bench bench;
  EXPECT_THAT(bench.tell("001#05"), IsEmpty());
  EXPECT_EQ(bench.puck(1).state(), PuckState::kOff);
}

TEST(Puck, ABootingPuckIsSilentAndThenInReset) {
  Bench bench;
  bench.board().reset();
  bench.board().shift_idle();
  bench.advance(299ms);
  EXPECT_THAT(bench.tell("001#05"), IsEmpty());
  EXPECT_THAT(bench.tell("001#05"), ElementsAre("426#85000000"));
}

TEST(Puck, TheMonitorKnowsItsOwnPropertiesAlone) {
  Bench bench;
  bench.power_up();
  EXPECT_THAT(bench.tell("003#00"), ElementsAre("466#80000C00")) << "its own version";
  EXPECT_THAT(bench.tell("003#01"), ElementsAre("466#81000001"));
  EXPECT_THAT(bench.tell("003#03"), ElementsAre("466#83000300"));
  for (const char* get : {"003#30", "003#0B", "003#44", "404#30"}) {
    EXPECT_THAT(bench.tell(get), IsEmpty()) << get;
  }
}

TEST(Puck, WakingItIsSilentForHalfASecond) {
  Bench bench;
  bench.power_up();
  EXPECT_THAT(bench.tell("002#850002000000"), IsEmpty());
  bench.advance(490ms);
  EXPECT_THAT(bench.tell("002#05"), IsEmpty());
  bench.advance(10ms);
  EXPECT_THAT(bench.tell("002#05"), ElementsAre("446#85000200"));
  EXPECT_THAT(bench.tell("002#00"), ElementsAre("446#8000AF00")) << "the main firmware's version";
  EXPECT_THAT(bench.tell("001#05"), ElementsAre("426#85000000")) << "the others were not woken";
}

TEST(Puck, AFrameToAllWakesThemAll) {
  Bench bench(4);
  bench.power_up();
  bench.tell("400#85000200");
  bench.advance(600ms);
  EXPECT_THAT(bench.tell("400#05"),
              ElementsAre("426#85000200", "446#85000200", "466#85000200", "486#85000200"));
}

TEST(Puck, GoesBackToItsMonitor) {
  Bench bench;
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#850000000000"), IsEmpty());
  EXPECT_THAT(bench.tell("001#05"), ElementsAre("426#85000000"));
  EXPECT_THAT(bench.tell("001#30"), IsEmpty());
}

TEST(Puck, LosesItsPositionWithItsPower) {
  Bench bench;
  bench.rotors.set_state(0, 10.3 * kTurn, 0.0);
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#30"), ElementsAre("423#8004CC")) << "0.3 turns: what MECH says";
  EXPECT_THAT(bench.tell("001#42"), ElementsAre("426#C200CC040000"));
  bench.tell("001#B00000100000");
  EXPECT_EQ(bench.puck(1).counts(), 4096);
  bench.board().estop();
  bench.advance(1ms);
  EXPECT_THAT(bench.tell("001#05"), IsEmpty());
  bench.wake_up();
  EXPECT_EQ(bench.puck(1).counts(), 0x4CC);
}

TEST(Puck, ForgetsWhatItHadToSayWhenPowerGoes) {
  Bench bench;
  bench.wake_up();
  bench.puck(1).delay_replies(5ms);
  bench.tell("001#05");
  bench.board().estop();
  bench.advance(1ms);
  bench.puck(1).delay_replies({});
  bench.wake_up();
  bench.log.clear();
  bench.advance(1s);
  EXPECT_THAT(bench.take_others(), IsEmpty());
}

// ---- Values

TEST(Puck, AnswersTellWhatItIs) {
  Bench bench;
  bench.wake_up();
  EXPECT_THAT(bench.tell("007#56"), ElementsAre("4E6#D6004244")) << "IPNM 17474";
  EXPECT_THAT(bench.tell("007#5A"), ElementsAre("4E6#DA000600")) << "POLES of the wrist";
  EXPECT_THAT(bench.tell("006#46"), ElementsAre("4C6#C6000200")) << "PIDX";
  EXPECT_THAT(bench.tell("001#44"), ElementsAre("426#C40000100000")) << "CTS, 32 bits";
  EXPECT_THAT(bench.tell("005#2B"), ElementsAre("4A6#AB003C0F")) << "MT 3900";
  EXPECT_THAT(bench.tell("005#1B"), ElementsAre("4A6#9B000200")) << "GRPB";
}

TEST(Puck, ASetOfEitherWidthIsStoredAndNotAcknowledged) {
  Bench bench;
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#AB00E803"), IsEmpty());
  EXPECT_THAT(bench.tell("001#2B"), ElementsAre("426#AB00E803"));
  EXPECT_THAT(bench.tell("001#AB0018FCFFFF"), IsEmpty());
  EXPECT_THAT(bench.tell("001#2B"), ElementsAre("426#AB0018FC"));
}

TEST(Puck, UnknownPropertiesAndBrokenFramesAreIgnored) {
  Bench bench;
  bench.wake_up();
  for (const char* wrong : {"001#7F", "001#FF000100", "001#0500", "001#8500", "001#850100020000",
                            "001#", "009#05", "405#05"}) {
    EXPECT_THAT(bench.tell(wrong), IsEmpty()) << wrong;
  }
  EXPECT_EQ(bench.puck(1).counters().ignored, 6u);
  EXPECT_EQ(bench.puck(1).state(), PuckState::kReady);
}

TEST(Puck, WhatTheMakerWritesIsLeftAlone) {
  Bench bench;
  bench.wake_up();
  bench.tell("001#800001000000");
  bench.tell("001#83000500");
  EXPECT_THAT(bench.tell("001#00"), ElementsAre("426#8000AF00"));
  EXPECT_THAT(bench.tell("001#03"), ElementsAre("426#83000100"));
}

TEST(Puck, MemoryDefaultsAndEepromAreThreeThings) {
  Bench bench;
  bench.wake_up();
  bench.tell("001#AB00E803");      // MT 1000
  bench.tell("001#9E002B000000");  // SAVE MT
  bench.tell("001#AB000100");      // MT 1
  bench.tell("001#9F002B000000");  // LOAD MT
  EXPECT_THAT(bench.tell("001#2B"), ElementsAre("426#AB00E803"));
  bench.tell("001#A0002B000000");  // DEF MT
  EXPECT_THAT(bench.tell("001#2B"), ElementsAre("426#AB00FC12"));
  bench.board().estop();
  bench.advance(1ms);
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#2B"), ElementsAre("426#AB00E803")) << "from the EEPROM";
}

TEST(Puck, OldFirmwareHasOtherNumbers) {
  Bench bench(Emulator::standard(4, 55));
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#1E"), ElementsAre("426#9E0000100000")) << "CTS is 30";
  EXPECT_THAT(bench.tell("404#1A"),
              ElementsAre("423#800000", "443#800000", "463#800000", "483#800000"))
      << "P is 26";
  EXPECT_THAT(bench.tell("001#00"), ElementsAre("426#80003700"));
}

TEST(Puck, MayHaveSixBytesForEveryAnswer) {
  auto config = Emulator::standard(4);
  config.pucks[0].replies = ReplyWidth::kAlwaysSix;
  Bench bench(config);
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#05"), ElementsAre("426#850002000000"));
  EXPECT_THAT(bench.tell("001#30"), ElementsAre("423#800000")) << "positions are as they are";
}

TEST(Puck, MayTellAnotherVersionThanItHas) {
  auto config = Emulator::standard(4);
  config.pucks[0].told_version = 55;
  Bench bench(config);
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#00"), ElementsAre("426#80003700"));
  EXPECT_THAT(bench.tell("001#44"), ElementsAre("426#C40000100000"));
}

// ---- Positions

TEST(Puck, CountsAreRoundedDown) {
  Bench bench;
  bench.wake_up();
  bench.rotors.set_state(0, 0.5 * kCount, 0.0);
  EXPECT_THAT(bench.tell("001#30"), ElementsAre("423#800000"));
  bench.rotors.set_state(0, -0.5 * kCount, 0.0);
  EXPECT_THAT(bench.tell("001#30"), ElementsAre("423#BFFFFF"));
  EXPECT_THAT(bench.tell("001#42"), ElementsAre("426#C200FF0F0000")) << "MECH stays in its turn";
}

TEST(Puck, FlagsOfPositionsAreASetting) {
  auto config = Emulator::standard(4);
  config.pucks[1].position_flags = PositionFlags::kNone;
  Bench bench(config);
  bench.wake_up();
  EXPECT_THAT(bench.tell("404#30"),
              ElementsAre("423#800000", "443#000000", "463#800000", "483#800000"));
}

TEST(Puck, AJointEncoderMakesPositionsLonger) {
  auto config = Emulator::standard(4);
  config.pucks[0].role |= kJointEncoder;
  Bench bench(config);
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#30"), ElementsAre("423#800000800000"));
  EXPECT_THAT(bench.tell("001#60"), ElementsAre("427#800000"));
  EXPECT_THAT(bench.tell("002#60"), ElementsAre("446#E00000000000")) << "has none";
}

TEST(Puck, AnswersBegin75MicrosecondsAfterTheRequest) {
  Bench bench;
  bench.wake_up();
  bench.send("001#30");
  bench.advance(2ms);
  ASSERT_EQ(bench.log.size(), 2u);
  EXPECT_EQ(bench.log[1].begin - bench.log[0].end, 75us);
}

// ---- Torques

TEST(Puck, TorquesAreIgnoredUnlessItIsInTorqueMode) {
  Bench bench;
  bench.wake_up();
  bench.tell("401#AA0193F3804B3E70");
  EXPECT_EQ(bench.rotors.torque(0), 0.0);
  EXPECT_TRUE(bench.rotors.braked(0));
  bench.tell("400#88000200");
  EXPECT_FALSE(bench.rotors.braked(0));
  EXPECT_EQ(bench.rotors.torque(0), 0.0) << "nothing drives before a torque comes";
  bench.tell("401#AA0193F3804B3E70");
  EXPECT_DOUBLE_EQ(bench.rotors.torque(0), 100.0 / 2700.0);
  EXPECT_DOUBLE_EQ(bench.rotors.torque(1), -200.0 / 2700.0);
  EXPECT_DOUBLE_EQ(bench.rotors.torque(2), 300.0 / 2700.0);
  EXPECT_DOUBLE_EQ(bench.rotors.torque(3), -400.0 / 2700.0);
  EXPECT_EQ(bench.rotors.torque(4), 0.0);
  bench.tell("402#AAFFFC002FFF4000");
  EXPECT_DOUBLE_EQ(bench.rotors.torque(4), -1.0 / 6500.0);
  EXPECT_DOUBLE_EQ(bench.rotors.torque(5), 2.0 / 6500.0);
  EXPECT_DOUBLE_EQ(bench.rotors.torque(6), -3.0 / 17474.0);
}

TEST(Puck, LimitsTorquesToItsOwnMost) {
  Bench bench;
  bench.wake_up();
  bench.tell("400#88000200");
  bench.tell("401#AA7FFE0017FFE001");
  EXPECT_EQ(bench.puck(1).torque(), 4860);
  EXPECT_EQ(bench.puck(4).torque(), -4320);
}

TEST(Puck, ObeysASingleTorqueAndForgetsItWhenIdle) {
  Bench bench;
  bench.wake_up();
  bench.tell("001#88000200");
  bench.tell("001#AA00E803");
  EXPECT_THAT(bench.tell("001#2A"), ElementsAre("426#AA00E803"));
  bench.tell("001#88000000");
  EXPECT_TRUE(bench.rotors.braked(0));
  EXPECT_EQ(bench.rotors.torque(0), 0.0);
  bench.tell("001#88000200");
  EXPECT_EQ(bench.puck(1).torque(), 0);
}

TEST(Puck, ModesThatDoNotExistAreIgnored) {
  Bench bench;
  bench.wake_up();
  bench.tell("001#88000600");
  bench.tell("001#8800FFFF");
  EXPECT_EQ(bench.puck(1).mode(), PuckMode::kIdle);
}

// ---- Faults on demand

TEST(Puck, LosesAsManyAnswersAsWanted) {
  Bench bench;
  bench.wake_up();
  bench.puck(2).lose_replies(2);
  EXPECT_THAT(bench.tell("002#30"), IsEmpty());
  EXPECT_THAT(bench.tell("002#05"), IsEmpty());
  EXPECT_THAT(bench.tell("002#05"), ElementsAre("446#85000200"));
  EXPECT_EQ(bench.puck(2).counters().lost, 2u);
}

TEST(Puck, SpoilsAnswersAsWanted) {
  Bench bench;
  bench.wake_up();
  bench.puck(2).spoil_replies(ReplySpoil::kWrongProperty);
  EXPECT_THAT(bench.tell("002#05"), ElementsAre("446#86000200"));
  bench.puck(2).spoil_replies(ReplySpoil::kWrongLength);
  EXPECT_THAT(bench.tell("002#05"), ElementsAre("446#850002"));
  bench.puck(2).spoil_replies(ReplySpoil::kSecondByte);
  EXPECT_THAT(bench.tell("002#05"), ElementsAre("446#85010200"));
  bench.puck(2).spoil_replies(ReplySpoil::kTwice, 1);
  EXPECT_THAT(bench.tell("002#05"), ElementsAre("446#85000200", "446#85000200"));
  EXPECT_THAT(bench.tell("002#05"), ElementsAre("446#85000200"));
}

TEST(Puck, AnswersLaterIfWanted) {
  Bench bench;
  bench.wake_up();
  bench.puck(2).delay_replies(3ms);
  bench.send("002#30");
  bench.advance(3ms);
  EXPECT_THAT(bench.take_others(), IsEmpty());
  bench.advance(1ms);
  EXPECT_THAT(bench.take_others(), ElementsAre("443#800000"));
}

TEST(Puck, ADeadOneIsSilentAndItsMotorGoesOn) {
  Bench bench;
  bench.activate();
  bench.tell("401#AA0193F3804B3E70");
  bench.puck(1).set_dead(true);
  EXPECT_THAT(bench.tell("001#05"), IsEmpty());
  EXPECT_DOUBLE_EQ(bench.rotors.torque(0), 100.0 / 2700.0);
  bench.puck(1).set_dead(false);
  EXPECT_THAT(bench.tell("001#05"), ElementsAre("426#85000200"));
}

TEST(Puck, ComesBackFromBusOffByItself) {
  Bench bench;
  bench.wake_up();
  bench.puck(1).station().force_bus_off();
  EXPECT_THAT(bench.tell("001#05"), IsEmpty());
  bench.advance(10ms);
  EXPECT_THAT(bench.tell("001#05"), ElementsAre("426#85000200"));
}

// ---- Real time

TEST(Puck, ACycleAllocatesNothing) {
  Bench bench;
  bench.activate();
  bench.keeps_log = false;
  testing::RealtimeGuard guard;
  const auto cycle = [&] {
    bench.host.send(can::data_frame(0x404, {0x30}));
    bench.advance(1ms);
    bench.host.send(torque_frame(Group::kLowerArm, 42, {100, -200, 300, -400}));
    bench.host.send(torque_frame(Group::kWrist, 42, {1, 2, 3, 0}));
    bench.advance(1ms);
    can::Arrival arrival;
    while (bench.host.receive(arrival) == can::ReceiveStatus::kReceived) {
    }
  };
  for (int i = 0; i < 20; ++i) EXPECT_EQ(guard.watch(cycle), 0u) << guard.report();
}

}  // namespace
}  // namespace armature::wam
