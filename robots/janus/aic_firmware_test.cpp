// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic_firmware.hpp"

#include <chrono>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/janus/test_bench.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using can::data_frame;
using can::frame_time;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// ---- Heartbeats and answers

TEST(AicFirmware, TellsThatItStartedAndThenEvery100MillisecondsThatItLives) {
  Bench bench;
  bench.advance(98ms);
  EXPECT_THAT(bench.take_answers(), IsEmpty());
  bench.advance(2ms);
  EXPECT_EQ(bench.log.at(0).begin, base::Time(100ms));
  EXPECT_THAT(bench.take_answers(), ElementsAre("381#0000010000", "382#0000010000"));
  bench.advance(900ms);
  EXPECT_EQ(bench.take_answers().back(), "382#0000010100") << "uptime in seconds";
}

TEST(AicFirmware, UptimeStaysAtItsLargestNumber) {
  Bench bench;
  bench.bus.advance_to(base::Time(70'000s));
  bench.card.run_timers();
  bench.advance(1ms);
  EXPECT_EQ(bench.take_answers().front(), "381#000001FFFF");
}

TEST(AicFirmware, AnswersARequest90MicrosecondsAfterItsEnd) {
  Bench bench;
  bench.joint.counts = 0x01020304;
  bench.joint.index = true;
  bench.joint.current = -0.3;
  bench.tell(request_frame(1));
  ASSERT_EQ(bench.log.size(), 2u);
  EXPECT_EQ(bench.log[1].begin - bench.log[0].end, 90us);
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#040302010100D4FE"));
}

TEST(AicFirmware, ReportsCountsSinceTheLastReportAndCountsItsReports) {
  Bench bench;
  bench.joint.counts = 5;
  bench.tell(request_frame(1));
  bench.joint.counts = -3;
  bench.tell(request_frame(1));
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(),
              ElementsAre("181#0500000000000000", "181#FDFFFFFF00010000", "181#0000000000020000"));
  EXPECT_EQ(bench.card.counters().reports, 3u);
}

TEST(AicFirmware, TheCounterLeavesOutZeroWhenItComesRound) {
  Bench bench;
  for (int i = 0; i < 256; ++i) bench.tell(request_frame(1));
  bench.take_answers();
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#0000000000010000"));
}

TEST(AicFirmware, ASyncIsLatchedByAllAtItsEndAndAnsweredBackToBack) {
  Bench bench;
  bench.send(sync_frame(1));
  bench.advance(frame_time(sync_frame(1), kBitRate) - 1ns);
  bench.joints[0].counts = 7;
  bench.joints[1].counts = 8;
  bench.advance(1ns);
  bench.joints[0].counts = 100;  // moves on while the answers are on their way
  bench.advance(1ms);
  ASSERT_EQ(bench.log.size(), 3u);
  EXPECT_EQ(bench.log[1].begin - bench.log[0].end, 90us);
  EXPECT_EQ(bench.log[2].begin, bench.log[1].end);
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#0700000000000000", "182#0800000000000000"));
  bench.tell(sync_frame(2));
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#6400000000010000", "182#0000000000010000"));
}

TEST(AicFirmware, ARequestIsForOneCard) {
  Bench bench;
  bench.tell(request_frame(2));
  EXPECT_THAT(bench.take_answers(), ElementsAre("182#0000000000000000"));
}

TEST(AicFirmware, IdentifyIsAnsweredByAHeartbeat) {
  Bench bench;
  bench.tell(command_frame(2, AicCommand::kIdentify));
  ASSERT_EQ(bench.log.size(), 2u);
  EXPECT_EQ(bench.log[1].begin - bench.log[0].end, 90us);
  EXPECT_THAT(bench.take_answers(), ElementsAre("382#0000010000"));
}

TEST(AicFirmware, ACurrentBeyondTheFieldIsItsLargestNumber) {
  Bench bench;
  bench.joint.current = -100.0;
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#0000000000000180"));
}

// ---- Motor, brake and states

TEST(AicFirmware, AMotorValueIsAppliedOnlyWhenItIsOn) {
  Bench bench;
  bench.tell(motor_frame(1, 32767));
  EXPECT_EQ(bench.joint.motor, FakeWiring::kOff);
  bench.tell(command_frame(1, AicCommand::kActuatorOn));
  EXPECT_EQ(bench.card.state(), AicState::kOn);
  EXPECT_EQ(bench.joint.motor, 0.0) << "what came before it was on is forgotten";
  bench.tell(motor_frame(1, -32768));
  EXPECT_EQ(bench.joint.motor, -1.0);
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#0000000002000000"));
  bench.tell(command_frame(1, AicCommand::kActuatorOff));
  EXPECT_EQ(bench.joint.motor, FakeWiring::kOff);
  EXPECT_EQ(bench.card.state(), AicState::kOff);
}

TEST(AicFirmware, AGroupFrameHasTheValueOfEachCardAtItsPlace) {
  Bench bench;
  bench.tell(command_frame(1, AicCommand::kActuatorOn));
  bench.tell(command_frame(2, AicCommand::kActuatorOn));
  bench.tell(motor_group_frame(0, {32767, -32767, 5, 6}));
  EXPECT_EQ(bench.joints[0].motor, 1.0);
  EXPECT_EQ(bench.joints[1].motor, -1.0);
  bench.tell(motor_group_frame(1, {1, 1, 1, 1}));
  EXPECT_EQ(bench.joints[0].motor, 1.0) << "of cards 5 to 8";
}

TEST(AicFirmware, TheBrakeOutputFollowsItsCommands) {
  Bench bench;
  bench.tell(command_frame(1, AicCommand::kBrakeRelease));
  EXPECT_TRUE(bench.joint.brake_released);
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#0000000004000000"));
  bench.tell(command_frame(1, AicCommand::kBrakeApply));
  EXPECT_FALSE(bench.joint.brake_released);
}

TEST(AicFirmware, SwitchingOffLeavesTheBrakeAsItIs) {
  Bench bench;
  bench.tell(command_frame(1, AicCommand::kActuatorOn));
  bench.tell(command_frame(1, AicCommand::kBrakeRelease));
  bench.tell(command_frame(1, AicCommand::kActuatorOff));
  EXPECT_TRUE(bench.joint.brake_released);
}

// ---- Watchdog

/// A card that is on and whose brake is released, since `since`.
struct Running : Bench {
  Running() {
    send(command_frame(1, AicCommand::kActuatorOn));
    send(command_frame(1, AicCommand::kBrakeRelease));
    send(motor_frame(1, 1000));
    advance(1ms);
    since = log.back().end;
    log.clear();
  }
  void wait_until(base::Time time) { advance(time - bus.now()); }
  base::Time since;
};

TEST(AicFirmware, TheWatchdogSwitchesOffAndBrakesExactlyWhenItsTimeIsOver) {
  Running bench;
  bench.wait_until(bench.since + 100ms - 1ns);
  EXPECT_EQ(bench.card.state(), AicState::kOn);
  bench.log.clear();
  bench.advance(1ns);
  EXPECT_EQ(bench.card.state(), AicState::kWatchdog);
  EXPECT_EQ(bench.joint.motor, FakeWiring::kOff);
  EXPECT_FALSE(bench.joint.brake_released);
  bench.advance(1ms);
  EXPECT_THAT(bench.take_answers(), ElementsAre("001#0203"));
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#0000000010000000"));
  bench.advance(1s);
  EXPECT_EQ(bench.card.counters().emergencies, 1u) << "told once";
}

TEST(AicFirmware, MotorGroupAndSyncFramesFeedTheWatchdogNothingElseDoes) {
  const auto state_after = [](const can::Frame& frame) {
    Running bench;
    for (int i = 0; i < 4; ++i) {
      bench.tell(frame);
      bench.advance(49ms);
    }
    return bench.card.state();
  };
  EXPECT_EQ(state_after(motor_frame(1, 0)), AicState::kOn);
  EXPECT_EQ(state_after(motor_group_frame(0, {})), AicState::kOn);
  EXPECT_EQ(state_after(sync_frame(0)), AicState::kOn);
  EXPECT_EQ(state_after(request_frame(1)), AicState::kWatchdog);
  EXPECT_EQ(state_after(motor_frame(2, 0)), AicState::kWatchdog);
  EXPECT_EQ(state_after(motor_group_frame(1, {})), AicState::kWatchdog);
  EXPECT_EQ(state_after(command_frame(1, AicCommand::kActuatorOn)), AicState::kWatchdog);
  EXPECT_EQ(state_after(data_frame(0x201, {0})), AicState::kWatchdog);
}

TEST(AicFirmware, TheWatchdogWatchesAReleasedBrakeAlone) {
  Bench bench;
  bench.tell(command_frame(1, AicCommand::kBrakeRelease));
  bench.advance(101ms);
  EXPECT_FALSE(bench.joint.brake_released);
  EXPECT_EQ(bench.card.state(), AicState::kWatchdog);
}

TEST(AicFirmware, ACardThatIsOffWithItsBrakeAppliedNeedsNoWatchdog) {
  Bench bench;
  bench.advance(1s);
  EXPECT_EQ(bench.card.state(), AicState::kStarted);
}

TEST(AicFirmware, TheTimeOfTheWatchdogCanBeSetButItCannotBeSwitchedOff) {
  Running bench;
  bench.send(watchdog_frame(1, 20));
  bench.send(watchdog_frame(1, 0));
  bench.wait_until(bench.since + 20ms - 1ns);
  EXPECT_EQ(bench.card.state(), AicState::kOn);
  bench.advance(1ns);
  EXPECT_EQ(bench.card.state(), AicState::kWatchdog);
  EXPECT_EQ(bench.card.counters().refused, 1u);
}

TEST(AicFirmware, AfterTheWatchdogNothingMovesUntilItIsAcknowledged) {
  Running bench;
  bench.advance(150ms);
  bench.tell(command_frame(1, AicCommand::kActuatorOn));
  bench.tell(command_frame(1, AicCommand::kBrakeRelease));
  bench.tell(motor_frame(1, 1000));
  EXPECT_EQ(bench.joint.motor, FakeWiring::kOff);
  EXPECT_FALSE(bench.joint.brake_released);
  EXPECT_EQ(bench.card.counters().refused, 2u);
  bench.tell(command_frame(1, AicCommand::kActuatorOff));
  EXPECT_EQ(bench.card.state(), AicState::kOff);
  bench.tell(command_frame(1, AicCommand::kActuatorOn));
  EXPECT_EQ(bench.card.state(), AicState::kOn);
  EXPECT_EQ(bench.joint.motor, 0.0);
}

// ---- What is not in the table

TEST(AicFirmware, FramesOfAWrongLengthAreIgnoredAndCounted) {
  Running bench;
  bench.advance(1ms);
  bench.log.clear();
  std::uint64_t wrong = 0;
  for (const std::uint32_t id : {0x080u, 0x101u, 0x201u, 0x280u, 0x301u}) {
    for (std::uint8_t size = 0; size <= 8; ++size) {
      const bool right = (id == 0x080u && size == 1) || (id == 0x101u && size == 1) ||
                         (id == 0x201u && size == 2) || (id == 0x280u && size == 8) ||
                         (id == 0x301u && size == 0);
      if (right) continue;
      can::Frame frame = data_frame(id, {2, 0, 0, 0, 0, 0, 0, 0});
      frame.size = size;
      bench.tell(frame);
      ++wrong;
      ASSERT_EQ(bench.card.counters().ignored, wrong) << can::to_text(frame).view();
      ASSERT_EQ(bench.card.state(), AicState::kOn);
      ASSERT_DOUBLE_EQ(bench.joint.motor, motor_share(1000));
    }
  }
  EXPECT_THAT(bench.take_answers(), IsEmpty());
}

TEST(AicFirmware, UnknownCommandsRemoteAndExtendedFramesAreIgnoredAndCounted) {
  Bench bench;
  bench.tell(data_frame(0x101, {0}));
  bench.tell(data_frame(0x101, {7}));
  bench.tell(can::remote_frame(0x301, 0));
  bench.tell(can::extended_frame(0x301, {}));
  bench.tell(data_frame(0x400, {}));
  bench.tell(data_frame(0x181, {0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bench.card.counters().ignored, 6u);
  EXPECT_EQ(bench.cards[1]->counters().ignored, 3u) << "the others are for card 1";
  EXPECT_THAT(bench.take_answers(), IsEmpty());
}

// ---- Faults

TEST(AicFirmware, AFaultThatItNoticesIsToldAndSwitchesOffUntilItIsOverAndAcknowledged) {
  for (const auto& [fault, told] :
       {std::pair{AicFault::kOverCurrent, "001#0104"},
        std::pair{AicFault::kEncoderError, "001#0304"}, std::pair{AicFault::kSupply, "001#0404"}}) {
    Running bench;
    bench.card.begin(fault);
    EXPECT_EQ(bench.joint.motor, FakeWiring::kOff);
    EXPECT_FALSE(bench.joint.brake_released);
    bench.advance(1ms);
    EXPECT_THAT(bench.take_answers(), ElementsAre(told));
    bench.tell(request_frame(1));
    EXPECT_THAT(bench.take_answers(), ElementsAre("181#0000000008000000"));
    bench.tell(command_frame(1, AicCommand::kActuatorOn));
    EXPECT_EQ(bench.card.state(), AicState::kFault);
    bench.tell(command_frame(1, AicCommand::kActuatorOff));
    EXPECT_EQ(bench.card.state(), AicState::kFault) << "it lasts";
    EXPECT_THAT(bench.take_answers(), ElementsAre(told));
    bench.card.end(fault);
    EXPECT_EQ(bench.card.state(), AicState::kFault);
    bench.tell(command_frame(1, AicCommand::kActuatorOff));
    EXPECT_EQ(bench.card.state(), AicState::kOff);
    bench.tell(command_frame(1, AicCommand::kActuatorOn));
    EXPECT_EQ(bench.card.state(), AicState::kOn);
  }
}

TEST(AicFirmware, ASilentCardNeitherHearsNorSpeaksSoItsWatchdogStopsIt) {
  Running bench;
  bench.card.begin(AicFault::kSilent);
  for (int i = 0; i < 50; ++i) {
    bench.tell(motor_frame(1, 500));
    bench.advance(9ms);
  }
  for (const auto& answer : bench.take_answers()) EXPECT_EQ(answer.substr(0, 3), "382");
  EXPECT_EQ(bench.card.state(), AicState::kWatchdog);
  EXPECT_EQ(bench.joint.motor, FakeWiring::kOff);
  bench.card.end(AicFault::kSilent);
  bench.advance(1ms);
  EXPECT_THAT(bench.take_answers(), ElementsAre("001#0203", "381#0200010000"))
      << "the emergency first; of all the heartbeats the one that waited";
}

TEST(AicFirmware, AStuckEncoderCountsNothingAndNobodyNotices) {
  Bench bench;
  bench.joint.counts = 3;
  bench.card.begin(AicFault::kEncoderStuck);
  bench.joint.counts = 1000;
  bench.tell(request_frame(1));
  bench.joint.counts = 1000;
  bench.card.end(AicFault::kEncoderStuck);
  bench.joint.counts = 4;
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#0300000000000000", "181#0400000000010000"));
}

TEST(AicFirmware, APowerCycleForgetsEverything) {
  Running bench;
  bench.tell(watchdog_frame(1, 5000));
  bench.tell(request_frame(1));
  bench.advance(1s);
  bench.log.clear();
  bench.send(request_frame(1));
  bench.advance(120us);
  bench.card.power_off();
  EXPECT_EQ(bench.joint.motor, FakeWiring::kOff);
  EXPECT_FALSE(bench.joint.brake_released);
  EXPECT_EQ(bench.card.next_deadline(), base::Time::max());
  bench.joint.counts = 99;
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(), IsEmpty()) << "the answer that waited is gone, too";
  base::Diagnostics diagnostics;
  ASSERT_TRUE(bench.card.power_on(diagnostics));
  bench.joint.counts += 1;
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(), ElementsAre("381#0000010000", "181#0100000000000000"));
  bench.tell(command_frame(1, AicCommand::kActuatorOn));
  bench.advance(101ms);
  EXPECT_EQ(bench.card.state(), AicState::kWatchdog) << "100 ms again";
}

TEST(AicFirmware, ALastingFaultIsToldAfterPowerUp) {
  Bench bench;
  bench.card.power_off();
  bench.card.begin(AicFault::kSupply);
  base::Diagnostics diagnostics;
  ASSERT_TRUE(bench.card.power_on(diagnostics));
  bench.advance(1ms);
  EXPECT_THAT(bench.take_answers(), ElementsAre("001#0404", "381#0000010000"));
  EXPECT_EQ(bench.card.state(), AicState::kFault);
}

TEST(AicFirmware, SpoiledAnswersAreWrongAsTheyWereToBe) {
  Bench bench;
  for (const auto how : {AicSpoil::kWrongLength, AicSpoil::kWrongIdentifier, AicSpoil::kTwice,
                         AicSpoil::kWrongCounter, AicSpoil::kNone}) {
    bench.joint.counts = 1;
    bench.card.spoil_next(how);
    bench.tell(request_frame(1));
  }
  EXPECT_THAT(bench.take_answers(),
              ElementsAre("181#01000000000000", "182#0100000000010000", "181#0100000000020000",
                          "181#0100000000020000", "181#0100000000080000", "181#0100000000090000"));
}

TEST(AicFirmware, DelayedAnswersComeLaterByThat) {
  Bench bench;
  bench.card.delay_answers(5ms);
  bench.send(request_frame(1));
  bench.advance(10ms);
  ASSERT_EQ(bench.log.size(), 2u);
  EXPECT_EQ(bench.log[1].begin - bench.log[0].end, 90us + 5ms);
}

// ---- What becomes of counts

TEST(AicFirmware, CountsOfAReportThatTheBusThrewAwayAreInTheNextOne) {
  Bench bench;
  bench.joint.counts = 10;
  bench.send(request_frame(1));
  bench.advance(120us);  // its answer waits
  bench.card.station().force_bus_off();
  bench.advance(10ms);
  EXPECT_THAT(bench.take_answers(), IsEmpty());
  EXPECT_EQ(bench.card.station().state(), can::BusState::kActive) << "it comes back by itself";
  bench.joint.counts = 5;
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#0F00000000000000"));
}

TEST(AicFirmware, CountsBeyondTheFieldAreLeftForTheNextReport) {
  Bench bench;
  bench.joint.counts = 0x80000004;
  bench.tell(request_frame(1));
  bench.tell(request_frame(1));
  EXPECT_THAT(bench.take_answers(), ElementsAre("181#FFFFFF7F00000000", "181#0500000000010000"));
}

// ---- Anything

can::Frame random_frame(std::mt19937_64& random) {
  can::Frame frame;
  frame.extended = random() % 16 == 0;
  frame.kind = random() % 16 == 0 ? can::FrameKind::kRemote : can::FrameKind::kData;
  // Mostly frames for the cards, with codes that exist.
  frame.id = static_cast<std::uint32_t>(random() % 8 * 0x80 + random() % 4);
  if (random() % 8 == 0) frame.id = static_cast<std::uint32_t>(random() % 0x800);
  frame.size = static_cast<std::uint8_t>(random() % 4 == 0 ? random() % 9 : random() % 4);
  for (auto& byte : frame.data)
    byte = static_cast<std::uint8_t>(random() % 4 ? random() % 8 : random());
  return frame;
}

TEST(AicFirmware, NoFrameWhateverBringsItDown) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    std::mt19937_64 random(seed);
    Bench bench;
    bench.keeps_log = false;
    can::Arrival arrival;
    for (int i = 0; i < 20'000; ++i) {
      bench.host.send(random_frame(random));
      if (random() % 100 == 0) bench.card.begin(static_cast<AicFault>(random() % kAicFaults));
      for (std::size_t f = 0; f < kAicFaults; ++f) bench.card.end(static_cast<AicFault>(f));
      bench.advance(std::chrono::microseconds(random() % 1000));
      while (bench.host.receive(arrival) == can::ReceiveStatus::kReceived) {
      }
      const bool on = bench.card.state() == AicState::kOn;
      ASSERT_EQ(bench.joint.motor == FakeWiring::kOff, !on);
      ASSERT_EQ(bench.card.brake_released(), bench.joint.brake_released);
    }
    bench.advance(200ms);
    EXPECT_NE(bench.card.state(), AicState::kOn) << "the watchdog is still there";
    bench.tell(request_frame(1));
    EXPECT_GT(bench.card.counters().reports, 100u);
  }
}

TEST(AicFirmware, AllocatesNothing) {
  Bench bench;
  bench.keeps_log = false;
  testing::RealtimeGuard guard;
  const auto violations = guard.watch([&] {
    bench.host.send(command_frame(1, AicCommand::kActuatorOn));
    for (std::uint8_t i = 0; i < 100; ++i) {
      bench.host.send(sync_frame(i));
      bench.host.send(request_frame(1));
      bench.host.send(motor_group_frame(0, {}));
      bench.advance(5ms);
    }
    bench.advance(500ms);
    bench.card.begin(AicFault::kSupply);
    bench.advance(500ms);
  });
  EXPECT_EQ(violations, 0u) << guard.report();
}

}  // namespace
}  // namespace armature::janus
