// SPDX-License-Identifier: Apache-2.0
// What a card does when something is wrong with it, its bus or the frames.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/janus/test_bench.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// ---- Faults

TEST(AicFirmwareFaults, AFaultThatItNoticesIsToldAndSwitchesOffUntilItIsOverAndAcknowledged) {
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

TEST(AicFirmwareFaults, ASilentCardNeitherHearsNorSpeaksSoItsWatchdogStopsIt) {
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

TEST(AicFirmwareFaults, AStuckEncoderCountsNothingAndNobodyNotices) {
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

TEST(AicFirmwareFaults, APowerCycleForgetsEverything) {
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

TEST(AicFirmwareFaults, ALastingFaultIsToldAfterPowerUp) {
  Bench bench;
  bench.card.power_off();
  bench.card.begin(AicFault::kSupply);
  base::Diagnostics diagnostics;
  ASSERT_TRUE(bench.card.power_on(diagnostics));
  bench.advance(1ms);
  EXPECT_THAT(bench.take_answers(), ElementsAre("001#0404", "381#0000010000"));
  EXPECT_EQ(bench.card.state(), AicState::kFault);
}

TEST(AicFirmwareFaults, SpoiledAnswersAreWrongAsTheyWereToBe) {
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

TEST(AicFirmwareFaults, DelayedAnswersComeLaterByThat) {
  Bench bench;
  bench.card.delay_answers(5ms);
  bench.send(request_frame(1));
  bench.advance(10ms);
  ASSERT_EQ(bench.log.size(), 2u);
  EXPECT_EQ(bench.log[1].begin - bench.log[0].end, 90us + 5ms);
}

// ---- What becomes of counts

TEST(AicFirmwareFaults, CountsOfAReportThatTheBusThrewAwayAreInTheNextOne) {
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

TEST(AicFirmwareFaults, CountsBeyondTheFieldAreLeftForTheNextReport) {
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

TEST(AicFirmwareFaults, NoFrameWhateverBringsItDown) {
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

TEST(AicFirmwareFaults, AllocatesNothing) {
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
