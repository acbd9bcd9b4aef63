// SPDX-License-Identifier: Apache-2.0
// What the cycle sends and understands.
#include "robots/wam/driver/wam_driver.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/wam/driver/test_hosted_bench.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

constexpr double kCount = 2.0 * std::numbers::pi / 4096.0;

/// Torques of the motors for torques of the joints: through gears and differentials.
std::array<double, 7> motor_torques(const std::array<double, 7>& joints) {
  const auto& t = joints;
  return {-t[0] / 42.0,
          t[1] / 56.5 - t[2] * 1.68 / 56.5,
          -t[1] / 56.5 - t[2] * 1.68 / 56.5,
          -t[3] / 18.0,
          (t[4] - t[5]) / 19.4,
          (t[4] + t[5]) / 19.4,
          -t[6] / 14.93};
}

// ---- The cycle

TEST(WamDriver, ACycleIsOneRequestSevenAnswersAndTwoTorqueFrames) {
  Hosted bench;
  bench.start();
  bench.run(20);
  bench.log.clear();
  bench.run(1);
  std::vector<std::string> frames;
  for (const auto& event : bench.log) frames.emplace_back(can::to_text(event.frame).view());
  EXPECT_THAT(frames, ElementsAre("404#30", "423#800000", "443#BF701F", "463#808FE0", "483#BF7088",
                                  "4A3#800000", "4C3#800000", "4E3#800000", "401#AA00000000000000",
                                  "402#AA00000000000000"));
}

TEST(WamDriver, ItRepeatsEveryTwoMilliseconds) {
  Hosted bench;
  bench.start();
  bench.run(10);
  std::vector<base::Time> requests;
  for (const auto& event : bench.log) {
    if (event.frame.id == 0x404) requests.push_back(event.begin);
  }
  ASSERT_THAT(requests, SizeIs(10));
  for (std::size_t i = 1; i < requests.size(); ++i) EXPECT_EQ(requests[i] - requests[i - 1], 2ms);
}

TEST(WamDriver, ACycleTakesTheTimeOfItsFrames) {
  Hosted bench;
  bench.start();
  bench.run(20);
  bench.log.clear();
  const base::Time begin = bench.now();
  bench.run(1);
  base::Duration frames{};
  for (const auto& event : bench.log) frames += event.end - event.begin;
  const double whole = static_cast<double>((bench.log.back().end - begin).count());
  const double waited = 75e3;  // [ns] the pucks' own time
  EXPECT_LE(whole - waited, 1.05 * static_cast<double>(frames.count()));
  EXPECT_LE(bench.log.back().end - begin, 1ms);
}

TEST(WamDriver, AnArmWithFourJointsHasOneTorqueFrame) {
  Hosted bench(4);
  bench.start_active();
  bench.torques = {0.1, -0.1, 0.1, 0.1};
  bench.run(50);
  const auto sent = bench.take_own();
  EXPECT_THAT(sent, Contains(HasSubstr("401#AA")));
  EXPECT_THAT(sent, Not(Contains(HasSubstr("402#"))));
  EXPECT_EQ(bench.driver->motors(), 4u);
}

TEST(WamDriver, PositionsAreThoseOfTheMotorsShafts) {
  Hosted bench;
  bench.start();
  EXPECT_EQ(bench.read(), WamReading::kComplete);
  EXPECT_EQ(bench.driver->motor(1).counts, -36833);
  EXPECT_NEAR(bench.driver->motor(1).position, -56.5, kCount);
  EXPECT_EQ(bench.driver->motor(1).position, (bench.driver->motor(1).counts + 0.5) * kCount);
  EXPECT_NEAR(bench.driver->motor(3).position, -56.34, kCount);
  EXPECT_TRUE(bench.driver->motor(6).fresh);
  EXPECT_LE(bench.now() - bench.driver->motor(0).position_time, 1ms);
  EXPECT_GT(bench.now(), bench.driver->motor(0).position_time);
}

TEST(WamDriver, OldFirmwareIsDrivenByItsOwnNumbers) {
  for (const int version : {55, 64, 120, 130}) {
    Hosted bench(Emulator::standard(4, version));
    bench.start_active();
    bench.torques[0] = 0.5;
    bench.run(2);
    EXPECT_EQ(bench.puck(1).torque(), 1350) << version;
    EXPECT_EQ(bench.driver->reading(), WamReading::kComplete) << version;
  }
}

TEST(WamDriver, PositionsOfJointEncodersComeAlong) {
  auto config = Emulator::standard(4);
  config.pucks[1].role |= kJointEncoder;
  Hosted bench(config);
  bench.start();
  EXPECT_EQ(bench.read(), WamReading::kComplete);
  EXPECT_EQ(bench.driver->motor(0).joint_counts, std::nullopt);
  EXPECT_EQ(bench.driver->motor(1).joint_counts, 0);
  EXPECT_EQ(bench.driver->motor(1).counts, -36833);
}

TEST(WamDriver, EitherFlagOfPositionsWillDo) {
  auto config = Emulator::standard(4);
  config.pucks[2].position_flags = PositionFlags::kNone;
  Hosted bench(config);
  bench.start();
  EXPECT_EQ(bench.read(), WamReading::kComplete);
  EXPECT_EQ(bench.driver->motor(2).counts, 36832);
}

// ---- Torques

TEST(WamDriver, TorquesInIdleAreZero) {
  Hosted bench;
  bench.start();
  bench.torques = {0.5, 0.5, 0.5, 0.5, 0.1, 0.1, 0.01};
  bench.run(100);
  const auto sent = bench.take_own();
  EXPECT_THAT(sent, Not(Contains(HasSubstr("401#AA0D"))));
  for (const auto& frame : sent) {
    if (frame.find("401#") == 0 || frame.find("402#") == 0) {
      EXPECT_THAT(frame, HasSubstr("#AA00000000000000"));
    }
  }
  EXPECT_EQ(bench.rotors.velocity(0), 0.0);
}

TEST(WamDriver, WhenActivatedItSendsTorquesWithin50Milliseconds) {
  Hosted bench;
  bench.start();
  bench.run(7);
  const auto gravity = motor_torques(
      {0, 17.32646, 0.05494, -4.05392, -0.05643, -0.12624, 0.00005});  // at home, of the 7-DOF arm
  for (std::size_t i = 0; i < 7; ++i) bench.torques[i] = gravity[i];
  bench.board().shift_activate();
  const base::Time begin = bench.now();
  while (!bench.driver->active() && bench.now() - begin < 200ms) bench.run(1);
  EXPECT_LE(bench.now() - begin, 52ms);
  EXPECT_EQ(bench.driver->board_mode(), BoardMode::kActive);
  for (int node = 1; node <= 7; ++node) {
    const auto motor = static_cast<std::size_t>(node - 1);
    const double units = gravity[motor] * bench.puck(node).properties().get(Property::kIpnm);
    EXPECT_EQ(bench.puck(node).torque(), std::floor(units)) << node;
  }
  EXPECT_EQ(bench.puck(2).torque(), 823);
  EXPECT_EQ(bench.puck(3).torque(), -833);
}

TEST(WamDriver, TorquesAreLimitedToThePucksMost) {
  Hosted bench;
  bench.start_active();
  EXPECT_EQ(bench.driver->set_torque(0, 1.8, bench.now()), WamTorque::kTaken);
  EXPECT_EQ(bench.driver->set_torque(3, -5.0, bench.now()), WamTorque::kLimited);
  EXPECT_EQ(bench.driver->set_torque(6, 0.3, bench.now()), WamTorque::kLimited);
  bench.driver->send_torques(bench.now());
  bench.advance(1ms);
  EXPECT_EQ(bench.puck(1).torque(), 4860);
  EXPECT_EQ(bench.puck(4).torque(), -4320);
  EXPECT_EQ(bench.puck(7).torque(), 1600);
  EXPECT_EQ(bench.driver->motor(6).counters.limited, 1u);
  EXPECT_EQ(bench.board().mode(), BoardMode::kActive);
}

TEST(WamDriver, TheFirstTorquesAreRoundedDown) {
  Hosted bench;
  bench.start_active();
  const auto torques = motor_torques({1, 1, 1, 0.99, 1, 1, 1});
  for (std::size_t i = 0; i < 7; ++i) bench.driver->set_torque(i, torques[i], bench.now());
  bench.log.clear();
  bench.driver->send_torques(bench.now());
  bench.advance(1ms);
  const auto sent = bench.take_own();
  ASSERT_THAT(sent, SizeIs(2));
  const auto lower = parse_torques(can::parse_frame(sent[0]).value(), 42);
  EXPECT_EQ(lower, (Torques{-65, -33, -129, -149}));
  EXPECT_EQ(sent[1], "402#AA000029EEDB4000");
}

TEST(WamDriver, TheMeanOfThePucksTorquesIsWhatWasSet) {
  Hosted bench;
  bench.start_active();
  const auto torques = motor_torques({1, 1, 1, 0.99, 0.1, 0.2, 0.5});
  for (std::size_t i = 0; i < 7; ++i) bench.torques[i] = torques[i];
  std::array<double, 7> sums{};
  constexpr int kCycles = 16;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    bench.run(1);
    for (std::size_t i = 0; i < 7; ++i) sums[i] += bench.puck(static_cast<int>(i) + 1).torque();
  }
  EXPECT_TRUE(bench.driver->active());
  for (std::size_t i = 0; i < 7; ++i) {
    const double units = bench.puck(static_cast<int>(i) + 1).properties().get(Property::kIpnm);
    EXPECT_NEAR(sums[i], kCycles * torques[i] * units, 1.0) << "motor " << i;
  }
}

TEST(WamDriver, AfterAStartTheFirstTorqueIsRoundedDownAgain) {
  Hosted bench;
  bench.start_active();
  bench.torques[0] = 0.1001;  // 270.27 units
  bench.run(3);
  for (int start = 0; start < 5; ++start) {
    bench.driver->start(bench.now());
    bench.torques[0].reset();
    bench.run(50);
    bench.torques[0] = 0.1001;
    bench.run(1);
    EXPECT_EQ(bench.puck(1).torque(), 270);
  }
}

TEST(WamDriver, WhatIsNoNumberIsSentAsZeroAndCounted) {
  Hosted bench;
  bench.start_active();
  bench.torques[0] = 0.1;
  bench.run(1);
  EXPECT_EQ(bench.puck(1).torque(), 270);
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(bench.driver->set_torque(0, wrong, bench.now()), WamTorque::kNotFinite);
  }
  bench.driver->send_torques(bench.now());
  bench.advance(1ms);
  EXPECT_EQ(bench.puck(1).torque(), 0);
  EXPECT_EQ(bench.driver->motor(0).counters.not_finite, 3u);
}

TEST(WamDriver, ATorqueThatIsNotSetAnewIsZeroAfter10Milliseconds) {
  Hosted bench;
  bench.start_active();
  bench.torques[0] = 0.1;
  bench.run(1);
  bench.torques[0].reset();
  bench.run(4);
  EXPECT_EQ(bench.puck(1).torque(), 270);
  EXPECT_EQ(bench.driver->motor(0).counters.stale, 0u);
  bench.run(2);
  EXPECT_EQ(bench.puck(1).torque(), 0);
  EXPECT_EQ(bench.driver->motor(0).counters.stale, 1u);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNone);
}

TEST(WamDriver, SendIdleBrakesAllMotorsAtOnce) {
  Hosted bench;
  bench.start_active();
  bench.torques[0] = 0.1;
  bench.run(1);
  bench.log.clear();
  bench.driver->send_idle();
  bench.advance(1ms);
  EXPECT_THAT(bench.take_own(), ElementsAre("401#880000000000", "402#880000000000"));
  for (int node = 1; node <= 7; ++node) EXPECT_EQ(bench.puck(node).mode(), PuckMode::kIdle);
  EXPECT_TRUE(bench.rotors.braked(0));
}

// ---- The safety board

TEST(WamDriver, AsksTheBoardAtMostTwentyTimesASecond) {
  Hosted bench;
  bench.start_active();
  bench.run(500);
  int modes = 0;
  int pendants = 0;
  for (const auto& frame : bench.take_own()) {
    modes += frame == "00A#08";
    pendants += frame == "00A#2B";
  }
  EXPECT_EQ(modes, 20);
  EXPECT_EQ(pendants, 20);
  EXPECT_TRUE(bench.driver->pendant().value().activate_lamp);
}

TEST(WamDriver, NeverAsksForMoreThanTheBoardAllows) {
  Hosted bench;
  bench.start();
  bench.run(100);
  EXPECT_THAT(bench.tell("00A#880002000000"), Each(Not(HasSubstr("546#"))));
  bench.run(100);
  EXPECT_EQ(bench.driver->board_mode(), BoardMode::kIdle);
  EXPECT_EQ(bench.board().counters().refused, 1u) << "that of this test";
}

TEST(WamDriver, WhatTheBoardTellsThePucksHasItAskedForItsModeAtOnce) {
  Hosted bench;
  bench.start();
  for (int offset = 0; offset < 30; ++offset) {
    bench.run(10 + offset);
    bench.board().shift_activate();
    bench.run(3);
    EXPECT_TRUE(bench.driver->active()) << offset;
    bench.run(60);
    bench.board().shift_idle();
    bench.run(3);
    EXPECT_EQ(bench.driver->board_mode(), BoardMode::kIdle) << offset;
    EXPECT_TRUE(bench.driver->acknowledge());
    bench.run(60);
  }
}

/// These frames are inferred, so the board's answer alone is believed.
TEST(WamDriver, WhatSaysThatItTellsThePucksIsNotBelievedAndAskedAboutOnceInAPeriod) {
  Hosted bench;
  bench.start();
  bench.run(60);
  can::VirtualStation& other = bench.emulator->bus().add_station("other");
  base::Diagnostics diagnostics;
  ASSERT_TRUE(other.open({}, diagnostics));
  bench.take_own();
  for (int i = 0; i < 500; ++i) {
    other.send(can::data_frame(0x540, {0x88, 0, 2, 0, 0, 0}));
    bench.run(1);
    EXPECT_FALSE(bench.driver->active());
  }
  int modes = 0;
  for (const auto& frame : bench.take_own()) modes += frame == "00A#08";
  EXPECT_LE(modes, 40) << "in a second";
}

TEST(WamDriver, AFloodOfBroadcastsIsIgnored) {
  Hosted bench;
  bench.start_active();
  can::VirtualStation& other = bench.emulator->bus().add_station("other");
  base::Diagnostics diagnostics;
  ASSERT_TRUE(other.open({}, diagnostics));
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 6; ++k) other.send(can::data_frame(0x540, {0x85, 0, 2, 0, 0, 0}));
    bench.run(1);
    EXPECT_EQ(bench.driver->reading(), WamReading::kComplete);
  }
  EXPECT_EQ(bench.driver->bus_counters().unknown_frames, 0u);
  EXPECT_TRUE(bench.driver->active());
}

// ---- Configuration and real time

TEST(WamDriver, RefusesWhatItCannotDrive) {
  Hosted bench;
  bench.power_up();
  EXPECT_EQ(WamDriver::make(bench.host, {}, {}).error(),
            "WamDriver on bus 'can0.host': 0 motors, expected 4 or 7");
  WamRecord record;
  record.motors = 7;
  EXPECT_THAT(WamDriver::make(bench.host, record, {}).error(),
              HasSubstr("nothing is known of puck 1"));
  ASSERT_EQ(bench.connect(), WamProgress::kDone);
  record = bench.startup->record();
  EXPECT_THAT(WamDriver::make(bench.host, record, {.watch_period = 49ms}).error(),
              HasSubstr("watch_period is below 50 ms"));
  EXPECT_THAT(WamDriver::make(bench.host, record, {.reply_timeout = {}}).error(),
              HasSubstr("reply_timeout is not above 0"));
  EXPECT_THAT(WamDriver::make(bench.host, record, {.torque_timeout = {}}).error(),
              HasSubstr("torque_timeout is not above 0"));
  EXPECT_THAT(WamDriver::make(bench.host, record, {.most_without = 0}).error(),
              HasSubstr("most_without is not above 0"));
}

TEST(WamDriver, ACycleAllocatesNothing) {
  Hosted bench;
  bench.start_active();
  bench.torques = {0.01, -0.01, 0.01, 0.01, 0.001, 0.001, 0.001};
  bench.keeps_log = false;
  testing::RealtimeGuard guard;
  for (int i = 0; i < 60; ++i) EXPECT_EQ(guard.watch([&] { bench.run(1); }), 0u) << guard.report();
  bench.puck(3).lose_replies(1);
  EXPECT_EQ(guard.watch([&] { bench.run(3); }), 0u) << guard.report();
  bench.board().fail(Monitor::kVelocity);
  EXPECT_EQ(guard.watch([&] { bench.run(60); }), 0u) << guard.report();
  bench.puck(3).set_dead(true);
  EXPECT_EQ(guard.watch([&] {
    bench.driver->acknowledge();
    bench.run(6);
    EXPECT_TRUE(bench.driver->needs_power_cut());
    bench.driver->cut_power(bench.now());
  }),
            0u)
      << guard.report();
  EXPECT_EQ(guard.watch([&] {
    bench.driver->acknowledge();
    bench.driver->send_idle();
    bench.driver->start(bench.now());
    bench.run(1);
  }),
            0u)
      << guard.report();
}

}  // namespace
}  // namespace armature::wam
