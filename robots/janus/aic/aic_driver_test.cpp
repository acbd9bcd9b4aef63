// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_driver.hpp"

#include <chrono>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/janus/test_driven_bench.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// ---- What it sends

TEST(AicDriver, SequentiallyItAsksOneCardAfterTheOther) {
  Driven bench;
  EXPECT_EQ(bench.begin(), AicReading::kWaiting);
  bench.advance(120us);
  EXPECT_THAT(bench.take_sent(), ElementsAre("301#"));
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  EXPECT_THAT(bench.take_sent(), ElementsAre("301#", "302#"));
}

TEST(AicDriver, SynchronouslyItAsksAllAtOnce) {
  Driven bench(AicMode::kSynchronous);
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  EXPECT_THAT(bench.take_sent(), ElementsAre("080#00", "080#01"));
}

TEST(AicDriver, MotorValuesGoOutAsTheModeHasIt) {
  Driven sequential;
  sequential.driver.set_motor(0, 1.0);
  sequential.driver.set_motor(1, -0.5);
  EXPECT_EQ(sequential.driver.send_motors(), can::SendStatus::kSent);
  sequential.advance(1ms);
  EXPECT_THAT(sequential.take_sent(), ElementsAre("201#FF7F", "202#00C0"));

  Driven synchronous({{6, 1, 2}, AicMode::kSynchronous});
  synchronous.driver.set_motor(0, 0.25);
  synchronous.driver.set_motor(1, 1.0);
  synchronous.driver.set_motor(2, -1.0);
  EXPECT_EQ(synchronous.driver.send_motors(), can::SendStatus::kSent);
  synchronous.advance(1ms);
  EXPECT_THAT(synchronous.take_sent(), ElementsAre("280#FF7F018000000000", "281#0000002000000000"));
}

TEST(AicDriver, CommandsAreTheseFrames) {
  Driven bench;
  bench.driver.command(0, AicCommand::kActuatorOn);
  bench.driver.command(1, AicCommand::kActuatorOff);
  bench.driver.command(0, AicCommand::kBrakeApply);
  bench.driver.command(1, AicCommand::kBrakeRelease);
  bench.driver.command(1, AicCommand::kIdentify);
  bench.driver.set_watchdog(0, 500ms);
  bench.advance(1ms);
  EXPECT_THAT(bench.take_sent(),
              ElementsAre("101#01", "102#02", "101#03", "102#04", "102#06", "101#05F401"));
}

TEST(AicDriver, AWatchdogTimeThatNoCardKnowsIsNotSent) {
  Driven bench;
  for (const base::Duration time : {base::Duration(0), base::Duration(1500us),
                                    base::Duration(65'536ms), base::Duration(-1ms)}) {
    EXPECT_EQ(bench.driver.set_watchdog(0, time), can::SendStatus::kInvalid);
  }
  EXPECT_EQ(bench.driver.command(0, AicCommand::kWatchdog), can::SendStatus::kInvalid);
  bench.advance(1ms);
  EXPECT_THAT(bench.take_sent(), IsEmpty());
}

TEST(AicDriver, WhatIsNoNumberIsSentAsZeroAndCounted) {
  Driven bench;
  bench.driver.set_motor(0, 0.5);
  bench.driver.set_motor(0, std::nan(""));
  bench.driver.set_motor(1, std::numeric_limits<double>::infinity());
  bench.driver.send_motors();
  bench.advance(1ms);
  EXPECT_THAT(bench.take_sent(), ElementsAre("201#0000", "202#0000"));
  EXPECT_EQ(bench.first().counters.not_finite, 1u);
  EXPECT_EQ(bench.second().counters.not_finite, 1u);
}

// ---- What it understands

TEST(AicDriver, ReadsWhatASensorFrameSays) {
  Driven bench;
  bench.host.close();  // scripted from here on
  can::VirtualStation& scripted = bench.bus.add_station("scripted");
  base::Diagnostics diagnostics;
  ASSERT_TRUE(bench.host.open({}, diagnostics) && scripted.open({}, diagnostics));
  scripted.send(can::parse_frame("181#0000000000050000").value());
  scripted.send(can::parse_frame("181#FEFFFFFF1506D4FE").value());
  bench.advance(1ms);
  bench.driver.poll(bench.bus.now());
  const AicCard& card = bench.first();
  EXPECT_EQ(card.counts, -2);
  EXPECT_TRUE(card.counts_exact);
  EXPECT_EQ(card.report, (SensorReport{.counts = -2,
                                       .index = true,
                                       .actuator_on = false,
                                       .brake_released = true,
                                       .fault = false,
                                       .watchdog_tripped = true,
                                       .counter = 6,
                                       .current_ma = -300}));
  EXPECT_EQ(card.report_time, bench.log.back().end);
}

TEST(AicDriver, CountsBeginWithTheFirstReport) {
  Driven bench;
  EXPECT_FALSE(bench.first().counts_exact);
  bench.joint.counts = 1000;  // moved by whoever came before
  bench.read();
  EXPECT_EQ(bench.first().counts, 0);
  EXPECT_TRUE(bench.first().counts_exact);
  bench.joint.counts = 7;
  bench.read();
  bench.joint.counts = -10;
  bench.read();
  EXPECT_EQ(bench.first().counts, -3);
  EXPECT_EQ(bench.first().counters, AicCounters{});
}

TEST(AicDriver, HeartbeatsAndEmergenciesAreTold) {
  Driven bench;
  bench.advance(100ms);
  ASSERT_TRUE(bench.first().heartbeat);
  EXPECT_EQ(*bench.first().heartbeat, (Heartbeat{AicState::kStarted, kFirmwareVersion, 0}));
  bench.firmware(0).begin(AicFault::kSupply);
  bench.advance(1ms);
  ASSERT_TRUE(bench.first().emergency);
  EXPECT_EQ(*bench.first().emergency, (Emergency{AicEmergency::kSupply, AicState::kFault}));
  EXPECT_EQ(bench.first().counters.emergencies, 1u);
  EXPECT_FALSE(bench.second().emergency);
  bench.driver.forget_emergency(0);
  EXPECT_FALSE(bench.first().emergency);
}

TEST(AicDriver, ACardThatIsNotHeardIsSilent) {
  Driven bench;
  bench.advance(240ms);
  bench.firmware(1).begin(AicFault::kSilent);
  bench.advance(200ms);
  EXPECT_FALSE(bench.driver.silent(0, bench.bus.now()));
  EXPECT_FALSE(bench.driver.silent(1, bench.bus.now()));
  bench.advance(100ms);
  EXPECT_FALSE(bench.driver.silent(0, bench.bus.now()));
  EXPECT_TRUE(bench.driver.silent(1, bench.bus.now()));
  bench.firmware(1).end(AicFault::kSilent);
  bench.advance(101ms);
  EXPECT_FALSE(bench.driver.silent(1, bench.bus.now()));
}

TEST(AicDriver, SynchronouslyItWaitsForAnAnswerFromTheOneBeforeItOn) {
  Driven bench(AicMode::kSynchronous);
  bench.firmware(1).delay_answers(950us);
  const base::Time begin = bench.bus.now();
  EXPECT_EQ(bench.read(), AicReading::kComplete);
  EXPECT_GT(bench.bus.now() - begin, 1ms);
}

// ---- How it is made

TEST(AicDriver, AWrongConfigurationIsNamedWithItsBus) {
  Bench bench;
  const auto error = [&](const AicDriver::Config& config) {
    return AicDriver::make(bench.host, config).error();
  };
  EXPECT_EQ(error({}), "AicDriver on bus 'can0.host': no cards, expected at least one");
  EXPECT_THAT(error({.cards = {1, 128}}), HasSubstr("card 128, expected 1 to 127"));
  EXPECT_THAT(error({.cards = {1, 0}}), HasSubstr("card 0, expected 1 to 127"));
  EXPECT_THAT(error({.cards = {3, 4, 3}}), HasSubstr("card 3 twice"));
  EXPECT_THAT(error({.cards = {1}, .answer_timeout = 0ms}), HasSubstr("answer_timeout"));
  EXPECT_THAT(error({.cards = {1}, .silence_timeout = 100ms}), HasSubstr("silence_timeout"));
}

TEST(AicDriver, ItsFiltersLetThroughItsOwnCardsOnly) {
  Bench bench;
  const AicDriver::Config config{.cards = {2}};
  can::VirtualStation& station = bench.bus.add_station("second");
  base::Diagnostics diagnostics;
  ASSERT_TRUE(station.open(AicDriver::bus_options(config), diagnostics));
  auto driver = AicDriver::make(station, config).value();
  driver.start(bench.bus.now());
  bench.advance(200ms);
  driver.begin_reading(bench.bus.now());
  bench.advance(500us);
  EXPECT_EQ(driver.poll(bench.bus.now()), AicReading::kComplete);
  EXPECT_TRUE(driver.card(0).heartbeat);
  EXPECT_EQ(driver.bus_counters(), AicBusCounters{});
}

}  // namespace
}  // namespace armature::janus
