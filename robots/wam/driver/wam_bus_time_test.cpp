// SPDX-License-Identifier: Apache-2.0
// How long a cycle needs the bus, beside the frames that it consists of.
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "robots/wam/driver/test_hosted_bench.hpp"
#include "robots/wam/driver/wire_time.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

constexpr int kCycles = 500;
constexpr double kMost = 1.05;  ///< of the frames' own time

class WamBusTime : public ::testing::TestWithParam<std::size_t> {
 protected:
  /// A second of an active arm at 500 Hz.
  /// @param think  how long each device takes before it answers
  std::vector<CycleOnWire> cycles(base::Duration think) {
    auto config = Emulator::standard(GetParam());
    for (Puck::Config& puck : config.pucks) puck.reply_delay = think;
    config.board.reply_delay = think;
    Hosted bench(config);
    bench.start_active();
    for (std::size_t i = 0; i < GetParam(); ++i) bench.torques[i] = 4e-4;  // a unit of the pucks
    std::vector<base::Time> begins;
    for (int i = 0; i < kCycles; ++i) {
      begins.push_back(bench.now());
      bench.run(1);
    }
    EXPECT_TRUE(bench.driver->active());
    return cycles_on_wire(begins, bench.log, Hosted::kPeriod);
  }
  /// A request, an answer of each puck, and torques; some cycles ask the board, which answers.
  std::size_t frames() const { return GetParam() == 4 ? 6 : 10; }
};

TEST_P(WamBusTime, OfACycleIsThatOfItsFramesIfThePucksAnswerAtOnce) {
  for (const CycleOnWire& cycle : cycles(0us)) {
    EXPECT_LE(cycle.bus, cycle.frames * kMost);
    EXPECT_GE(cycle.bus, cycle.frames);
  }
}

TEST_P(WamBusTime, OfACycleIsThatOfItsFramesAndWhatThePucksTakeToAnswer) {
  constexpr base::Duration kThink = 75us;
  for (const CycleOnWire& cycle : cycles(kThink))
    EXPECT_LE(cycle.bus - kThink, cycle.frames * kMost);
}

TEST_P(WamBusTime, ACycleHasTheFramesThatItNeedsAndTheBoardsQuestionInOneOfTwelve) {
  const auto all = cycles(75us);
  const auto with = [&](std::size_t count) {
    return std::count_if(all.begin(), all.end(),
                         [&](const CycleOnWire& cycle) { return cycle.count == count; });
  };
  EXPECT_EQ(with(frames()) + with(frames() + 2), kCycles);
  EXPECT_LE(with(frames() + 2), kCycles / 12);
  EXPECT_GE(with(frames() + 2), kCycles / 14);
}

INSTANTIATE_TEST_SUITE_P(Arms, WamBusTime, ::testing::Values(4, 7), [](const auto& tested) {
  return "Of" + std::to_string(tested.param) + "Joints";
});

}  // namespace
}  // namespace armature::wam
