// SPDX-License-Identifier: Apache-2.0
// Temperatures and currents of the pucks, and what asking for them takes of the bus.
#include "robots/wam/driver/puck_watch.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "robots/wam/driver/test_hosted_bench.hpp"
#include "robots/wam/driver/wire_time.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

constexpr auto kEach = {PuckReading::kTemperature, PuckReading::kMotorTemperature,
                        PuckReading::kCurrent};

class PuckWatchTest : public ::testing::TestWithParam<std::size_t> {
 protected:
  PuckWatchTest() {
    bench.start_active();
    bench.driver->watch_pucks(bench.now(), {.period = 50ms});
  }
  /// Cycles of 2 ms that ask behind their torques, as the hardware does.
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      const base::Time next = bench.now() + Hosted::kPeriod;
      begins.push_back(bench.now());
      bench.read();
      for (std::size_t motor = 0; motor < GetParam(); ++motor) {
        bench.driver->set_torque(motor, 4e-4, bench.now());
      }
      bench.driver->send_torques(bench.now());
      bench.driver->ask_puck(bench.now());
      bench.emulator->advance_to(next);
    }
  }
  const PuckWatch& pucks() const { return bench.driver->pucks(); }

  Hosted bench{GetParam()};
  std::vector<base::Time> begins;
};
INSTANTIATE_TEST_SUITE_P(Arms, PuckWatchTest, ::testing::Values(4, 7), [](const auto& tested) {
  return "Of" + std::to_string(tested.param) + "Joints";
});

TEST_P(PuckWatchTest, EachPuckIsAskedForEachReadingInTurn) {
  const auto motors = static_cast<int>(GetParam());
  for (int motor = 0; motor < motors; ++motor) {
    bench.emulator->puck(static_cast<std::size_t>(motor)).set_temperatures(40 + motor, 50 + motor);
  }
  run(25 * motors * 3 + 5);  // 50 ms for each question
  for (const PuckReading reading : kEach) EXPECT_EQ(pucks().rounds(reading), 1u);
  for (std::size_t motor = 0; motor < GetParam(); ++motor) {
    EXPECT_EQ(pucks().values(PuckReading::kTemperature)[motor], 40 + static_cast<int>(motor));
    EXPECT_EQ(pucks().values(PuckReading::kMotorTemperature)[motor], 50 + static_cast<int>(motor));
    EXPECT_NEAR(pucks().values(PuckReading::kCurrent)[motor], bench.emulator->puck(motor).torque(),
                1);
  }
  EXPECT_EQ(pucks().counters().missed, 0u);
  EXPECT_EQ(bench.driver->bus_counters().unknown_frames, 0u);
}

TEST_P(PuckWatchTest, FortyFramesASecondMakeNoCycleLonger) {
  run(10);
  bench.log.clear();
  begins.clear();
  run(500);
  const auto all = cycles_on_wire(begins, bench.log, Hosted::kPeriod);
  const std::size_t frames = GetParam() == 4 ? 6 : 10;  // without questions
  std::size_t more = 0;
  for (const CycleOnWire& cycle : all) more += cycle.count - frames;
  EXPECT_NEAR(static_cast<double>(more), 40.0 + 80.0, 6.0) << "those to the board are 80";
  // Behind the torques: the next request for positions finds the bus free.
  for (const CycleOnWire& cycle : all) EXPECT_LT(cycle.bus, Hosted::kPeriod);
  EXPECT_EQ(bench.driver->reading(), WamReading::kComplete);
  for (std::size_t motor = 0; motor < GetParam(); ++motor) {
    EXPECT_EQ(bench.driver->motor(motor).counters.missed, 0u);
    EXPECT_EQ(bench.driver->motor(motor).counters.late, 0u);
  }
}

TEST_P(PuckWatchTest, ARoundInWhichAPuckDoesNotAnswerTellsNothingAndIsCounted) {
  PuckWatch watch(bench.driver->arm());
  base::Time now = bench.now();
  watch.start(now, {.period = 20ms});
  for (std::size_t i = 0; i < 4 * 3 * GetParam(); ++i, now += 10ms) {
    const auto question = watch.question(now);
    if (!question || address_of(*question)->to == 2) continue;  // puck 2 does not answer
    const int node = address_of(*question)->to;
    const int number = parse_message(*question)->number;
    EXPECT_TRUE(watch.take(node, reply_frame(node, number, 7, Width::kTwo)));
  }
  for (const PuckReading reading : kEach) EXPECT_EQ(watch.rounds(reading), 0u);
  EXPECT_GE(watch.counters().missed, 3u);
}

TEST_P(PuckWatchTest, AnAnswerThatNobodyWaitsForIsNotTaken) {
  PuckWatch other(bench.driver->arm());
  other.start(bench.now(), {.period = 50ms});
  EXPECT_FALSE(other.take(1, reply_frame(1, 9, 7, Width::kTwo))) << "nothing was asked";
  ASSERT_TRUE(other.question(bench.now()));
  EXPECT_FALSE(other.take(2, reply_frame(2, 9, 7, Width::kTwo))) << "another puck";
  EXPECT_FALSE(other.take(1, reply_frame(1, 10, 7, Width::kTwo))) << "another property";
  EXPECT_TRUE(other.take(1, reply_frame(1, 9, 7, Width::kTwo)));
  EXPECT_EQ(other.counters().unexpected, 3u);
}

TEST_P(PuckWatchTest, WithoutAPeriodNothingIsAsked) {
  bench.driver->watch_pucks(bench.now(), {.period = 0ms});
  const std::uint64_t asked = pucks().counters().asked;
  run(100);
  EXPECT_EQ(pucks().counters().asked, asked);
}

}  // namespace
}  // namespace armature::wam
