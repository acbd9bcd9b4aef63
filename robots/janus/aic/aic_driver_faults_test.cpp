// SPDX-License-Identifier: Apache-2.0
// What the driver makes of everything that goes wrong, in both modes.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/janus/test_driven_bench.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using can::data_frame;

class AicDriverInBothModes : public ::testing::TestWithParam<AicMode> {};

INSTANTIATE_TEST_SUITE_P(, AicDriverInBothModes,
                         ::testing::Values(AicMode::kSequential, AicMode::kSynchronous),
                         [](const auto& instance) {
                           return instance.param == AicMode::kSequential ? "Sequential"
                                                                         : "Synchronous";
                         });

TEST_P(AicDriverInBothModes, ASilentCardCostsItsTimeoutAndTheOthersAreRead) {
  for (const std::size_t silent : {0u, 1u}) {
    Driven bench(GetParam());
    bench.firmware(silent).begin(AicFault::kSilent);
    const base::Time begin = bench.bus.now();
    EXPECT_EQ(bench.read(), AicReading::kIncomplete);
    EXPECT_LT(bench.bus.now() - begin, 1600us);
    EXPECT_FALSE(bench.driver.card(silent).fresh);
    EXPECT_TRUE(bench.driver.card(1 - silent).fresh);
    EXPECT_EQ(bench.driver.card(silent).counters.lost_answers, 1u);
    EXPECT_EQ(bench.driver.card(1 - silent).counters, AicCounters{});
    bench.firmware(silent).end(AicFault::kSilent);
    EXPECT_EQ(bench.read(), AicReading::kComplete);
  }
}

TEST_P(AicDriverInBothModes, ALostRequestLosesNoCounts) {
  Driven bench(GetParam());
  bench.read();
  bench.bus.lose_next(1);
  bench.joint.counts = 5;
  EXPECT_EQ(bench.read(), AicReading::kIncomplete);
  bench.joint.counts += 6;
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  EXPECT_EQ(bench.first().counts, 11);
  EXPECT_TRUE(bench.first().counts_exact);
  EXPECT_EQ(bench.first().counters, (AicCounters{.lost_answers = 1}));
}

TEST_P(AicDriverInBothModes, ALostReportTakesItsCountsWithItAndIsSeen) {
  Driven bench(GetParam());
  bench.read();
  bench.lose_reports(2);
  for (int i = 0; i < 3; ++i) {
    bench.joint.counts = 100;
    bench.read();
  }
  EXPECT_EQ(bench.first().counts, 100) << "200 are gone";
  EXPECT_FALSE(bench.first().counts_exact);
  EXPECT_EQ(bench.first().counters, (AicCounters{.lost_answers = 2, .lost_reports = 2}));
  EXPECT_TRUE(bench.second().counts_exact);
  bench.read();
  EXPECT_FALSE(bench.first().counts_exact) << "until somebody knows where the joint is";
  bench.driver.accept_counts(0, 300);
  EXPECT_TRUE(bench.first().counts_exact);
  bench.joint.counts = 1;
  bench.read();
  EXPECT_EQ(bench.first().counts, 301);
}

TEST_P(AicDriverInBothModes, AReportThatTheCardCouldNotSendLosesNoCounts) {
  Driven bench(GetParam());
  bench.read();
  bench.joint.counts = 5;
  bench.begin();
  bench.advance(120us);
  bench.firmware(0).station().force_bus_off();
  bench.advance(5ms);
  bench.driver.poll(bench.bus.now());
  bench.advance(5ms);
  bench.joint.counts = 6;
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  EXPECT_EQ(bench.first().counts, 11);
  EXPECT_TRUE(bench.first().counts_exact);
}

TEST_P(AicDriverInBothModes, FramesThatWereDestroyedAndSentAgainLoseNothing) {
  Driven bench(GetParam());
  bench.read();
  bench.bus.corrupt_next(3);
  bench.joint.counts = 5;
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  EXPECT_EQ(bench.first().counts, 5);
  EXPECT_EQ(bench.first().counters, AicCounters{});
}

TEST_P(AicDriverInBothModes, ALateAnswerStillCountsAndIsNoAnswerToTheNextRequest) {
  Driven bench(GetParam());
  bench.read();
  bench.firmware(0).delay_answers(5ms);
  bench.joint.counts = 5;
  EXPECT_EQ(bench.read(), AicReading::kIncomplete);
  bench.advance(10ms);
  EXPECT_FALSE(bench.first().fresh);
  EXPECT_EQ(bench.first().counts, 5);
  EXPECT_EQ(bench.first().counters, (AicCounters{.lost_answers = 1, .late_answers = 1}));
  bench.firmware(0).delay_answers(0ms);
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  EXPECT_TRUE(bench.first().counts_exact);
}

TEST_P(AicDriverInBothModes, ARepeatedReportCountsOnce) {
  Driven bench(GetParam());
  bench.read();
  bench.joint.counts = 5;
  bench.firmware(0).spoil_next(AicSpoil::kTwice);
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  bench.advance(1ms);
  EXPECT_EQ(bench.first().counts, 5);
  EXPECT_TRUE(bench.first().counts_exact);
  EXPECT_EQ(bench.first().counters, (AicCounters{.repeated = 1}));
}

TEST_P(AicDriverInBothModes, AWrongCounterIsTakenForLostReports) {
  Driven bench(GetParam());
  bench.read();
  bench.firmware(0).spoil_next(AicSpoil::kWrongCounter);
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  EXPECT_FALSE(bench.first().counts_exact);
  EXPECT_EQ(bench.first().counters, (AicCounters{.lost_reports = 5}));
}

TEST_P(AicDriverInBothModes, AWrongLengthIsNoReportAndItsCountsAreMissedNextTime) {
  Driven bench(GetParam());
  bench.read();
  bench.joint.counts = 5;
  bench.firmware(0).spoil_next(AicSpoil::kWrongLength);
  EXPECT_EQ(bench.read(), AicReading::kIncomplete);
  EXPECT_EQ(bench.first().counters, (AicCounters{.lost_answers = 1, .malformed = 1}));
  EXPECT_TRUE(bench.first().counts_exact) << "nobody can know yet";
  bench.read();
  EXPECT_FALSE(bench.first().counts_exact);
  EXPECT_EQ(bench.first().counters.lost_reports, 1u);
}

TEST_P(AicDriverInBothModes, AnIdentifierOfNoCardIsCounted) {
  Driven bench(GetParam());
  bench.read();
  bench.firmware(1).spoil_next(AicSpoil::kWrongIdentifier);  // as card 3
  EXPECT_EQ(bench.read(), AicReading::kIncomplete);
  EXPECT_EQ(bench.driver.bus_counters().unknown_frames, 1u);
  EXPECT_EQ(bench.second().counters.lost_answers, 1u);
}

TEST_P(AicDriverInBothModes, AReportInTheNameOfAnotherCardMakesThatOnesCountsDoubtful) {
  Driven bench(GetParam());
  for (int i = 0; i < 3; ++i) bench.read();
  bench.firmware(0).power_off();
  base::Diagnostics diagnostics;
  ASSERT_TRUE(bench.firmware(0).power_on(diagnostics));
  bench.advance(1ms);
  bench.read();  // card 1 is at counter 0 again, card 2 at 3
  bench.firmware(0).spoil_next(AicSpoil::kWrongIdentifier);
  EXPECT_EQ(bench.read(), AicReading::kIncomplete);
  EXPECT_FALSE(bench.first().fresh);
  EXPECT_FALSE(bench.second().counts_exact);
}

TEST_P(AicDriverInBothModes, ARestartedCardIsSeenAndItsCountsAreDoubtful) {
  for (const bool heartbeat_lost : {false, true}) {
    Driven bench(GetParam());
    bench.read();
    bench.driver.command(0, AicCommand::kActuatorOn);
    bench.advance(99ms);
    bench.firmware(0).power_off();
    base::Diagnostics diagnostics;
    if (heartbeat_lost) bench.bus.lose_next(1, can::Filter{.id = 0x381});
    ASSERT_TRUE(bench.firmware(0).power_on(diagnostics));
    bench.advance(1ms);
    bench.joint.counts = 5;
    EXPECT_EQ(bench.read(), AicReading::kComplete);
    bench.advance(1s);
    EXPECT_EQ(bench.first().counters, (AicCounters{.restarts = 1})) << heartbeat_lost;
    EXPECT_FALSE(bench.first().counts_exact);
    EXPECT_EQ(bench.first().counts, 5) << "since it is back";
    bench.read();
    EXPECT_EQ(bench.first().counters, (AicCounters{.restarts = 1}));
  }
}

TEST_P(AicDriverInBothModes, TheFirstReportOfARestartedCardIsMissedToo) {
  Driven bench(GetParam());
  for (int i = 0; i < 10; ++i) bench.read();
  bench.driver.command(0, AicCommand::kActuatorOn);
  bench.advance(99ms);
  bench.firmware(0).power_off();
  base::Diagnostics diagnostics;
  ASSERT_TRUE(bench.firmware(0).power_on(diagnostics));
  bench.advance(1ms);
  bench.lose_reports(1);
  bench.read();
  bench.read();
  EXPECT_EQ(bench.first().counters,
            (AicCounters{.lost_answers = 1, .lost_reports = 1, .restarts = 1}));
}

TEST_P(AicDriverInBothModes, AnotherHostIsSeen) {
  Driven bench(GetParam());
  can::VirtualStation& other = bench.bus.add_station("other");
  base::Diagnostics diagnostics;
  ASSERT_TRUE(other.open({}, diagnostics));
  other.send(motor_frame(1, 0));
  other.send(command_frame(1, AicCommand::kIdentify));
  other.send(sync_frame(0));
  other.send(data_frame(0x7ff, {}));
  bench.advance(5ms);
  EXPECT_EQ(bench.first().counters.unexpected, 2u);
  EXPECT_EQ(bench.driver.bus_counters().unknown_frames, 2u);
  EXPECT_EQ(bench.first().counters.late_answers, 1u) << "to the other's SYNC";
}

TEST_P(AicDriverInBothModes, AReadingThatIsNotWaitedForIsGivenUpByTheNext) {
  Driven bench(GetParam());
  bench.read();
  bench.joint.counts = 5;
  bench.begin();
  bench.begin();
  bench.advance(3ms);
  EXPECT_EQ(bench.driver.reading(), AicReading::kComplete);
  EXPECT_EQ(bench.first().counts, 5);
  EXPECT_TRUE(bench.first().counts_exact);
  EXPECT_EQ(bench.first().counters.lost_answers, 1u);
}

TEST_P(AicDriverInBothModes, BusOffEndsTheReadingClearsTheMotorsAndComesBack) {
  Driven bench(GetParam());
  bench.driver.set_motor(0, 0.5);
  bench.begin();
  bench.host.force_bus_off();
  EXPECT_EQ(bench.driver.poll(bench.bus.now()), AicReading::kNoBus);
  EXPECT_EQ(bench.driver.bus_state(), can::BusState::kBusOff);
  EXPECT_EQ(bench.driver.send_motors(), can::SendStatus::kBusOff);
  EXPECT_GT(bench.first().counters.not_sent + bench.driver.bus_counters().not_sent, 0u);
  EXPECT_FALSE(bench.first().fresh);
  bench.advance(5ms);
  bench.log.clear();
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  bench.take_sent();
  bench.driver.send_motors();
  bench.advance(1ms);
  EXPECT_THAT(bench.take_sent().front(), ::testing::AnyOf("201#0000", "280#0000000000000000"))
      << "what was to move before does not move now";
  EXPECT_EQ(bench.driver.bus_counters().bus_lost, 1u);
}

TEST_P(AicDriverInBothModes, MotorValuesThatTheBusDidNotTakeAreForgotten) {
  Driven bench(GetParam());
  bench.driver.set_motor(0, 0.5);
  bench.host.force_bus_off();
  EXPECT_EQ(bench.driver.send_motors(), can::SendStatus::kBusOff);
  bench.host.restart();
  bench.advance(5ms);
  bench.log.clear();
  EXPECT_EQ(bench.driver.send_motors(), can::SendStatus::kSent);
  bench.advance(1ms);
  EXPECT_THAT(bench.take_sent().front(), ::testing::AnyOf("201#0000", "280#0000000000000000"));
}

TEST_P(AicDriverInBothModes, ABusThatWasOffAndIsBackIsToldOnce) {
  Driven bench(GetParam());
  bench.driver.set_motor(0, 0.5);
  bench.host.force_bus_off();
  bench.host.restart();
  bench.advance(5ms);
  EXPECT_EQ(bench.driver.bus_state(), can::BusState::kActive);
  EXPECT_EQ(bench.begin(), AicReading::kNoBus);
  EXPECT_EQ(bench.read(), AicReading::kComplete);
}

TEST_P(AicDriverInBothModes, AClosedBusIsNoBus) {
  Driven bench(GetParam());
  bench.host.close();
  EXPECT_EQ(bench.begin(), AicReading::kNoBus);
  EXPECT_EQ(bench.driver.poll(bench.bus.now()), AicReading::kNoBus);
  EXPECT_EQ(bench.driver.command(0, AicCommand::kActuatorOn), can::SendStatus::kDown);
}

TEST_P(AicDriverInBothModes, AFullQueueIsCounted) {
  Driven bench(GetParam());
  can::Frame frame = data_frame(0x7f0, {});
  while (bench.host.send(frame) == can::SendStatus::kSent) {
  }
  EXPECT_EQ(bench.begin(), AicReading::kIncomplete);
  EXPECT_EQ(bench.first().counters.lost_answers, 1u);
  EXPECT_EQ(bench.driver.send_motors(), can::SendStatus::kQueueFull);
  EXPECT_GT(bench.first().counters.not_sent + bench.driver.bus_counters().not_sent, 0u);
}

TEST_P(AicDriverInBothModes, NoFrameWhateverBringsItDown) {
  for (const std::uint64_t seed : {4u, 5u, 6u}) {
    std::mt19937_64 random(seed);
    Driven bench(GetParam());
    bench.keeps_log = false;
    can::VirtualStation& other = bench.bus.add_station("other");
    base::Diagnostics diagnostics;
    ASSERT_TRUE(other.open({}, diagnostics));
    for (int i = 0; i < 10'000; ++i) {
      can::Frame frame;
      frame.extended = random() % 16 == 0;
      frame.kind = random() % 16 == 0 ? can::FrameKind::kRemote : can::FrameKind::kData;
      frame.id = static_cast<std::uint32_t>(random() % 16 * 0x80 + random() % 4);
      frame.size = static_cast<std::uint8_t>(random() % 2 == 0 ? 8 : random() % 9);
      for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(random());
      other.send(frame);
      if (random() % 16 == 0) bench.begin();
      bench.advance(std::chrono::microseconds(random() % 500));
      bench.driver.poll(bench.bus.now());
    }
    bench.advance(200ms);
    EXPECT_EQ(bench.read(), AicReading::kComplete);
    EXPECT_GT(bench.first().counters.malformed, 100u);
    EXPECT_GT(bench.first().counters.lost_reports, 100u);
    EXPECT_GT(bench.driver.bus_counters().unknown_frames, 100u);
  }
}

TEST_P(AicDriverInBothModes, AllocatesNothing) {
  Driven bench(GetParam());
  bench.keeps_log = false;
  testing::RealtimeGuard guard;
  const auto violations = guard.watch([&] {
    bench.driver.start(bench.bus.now());
    for (int i = 0; i < 50; ++i) {
      bench.driver.command(0, AicCommand::kActuatorOn);
      bench.driver.set_watchdog(0, 100ms);
      if (i == 20) bench.firmware(1).begin(AicFault::kSilent);
      if (i == 40) bench.host.force_bus_off();
      bench.read();
      bench.driver.set_motor(0, 0.1);
      bench.driver.send_motors();
      bench.driver.silent(1, bench.bus.now());
      bench.advance(10ms);
    }
  });
  EXPECT_EQ(violations, 0u) << guard.report();
}

}  // namespace
}  // namespace armature::janus
