// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_firmware.hpp"

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace armature::janus
