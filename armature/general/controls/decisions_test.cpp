// SPDX-License-Identifier: Apache-2.0
// Controls that decide.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/general/controls/comparator.hpp"
#include "armature/general/controls/logic.hpp"
#include "armature/general/controls/selector.hpp"
#include "armature/general/controls/timer.hpp"
#include "armature/testing/harness.hpp"

namespace armature::general {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using testing::Harness;
using ::testing::HasSubstr;

template <typename Control>
Harness bench(base::Duration period = 1ms) {
  return Harness(std::make_unique<Control>("Control"), period);
}

TEST(Comparator, TellsWhenAValuePassesTheThreshold) {
  auto comparator = bench<Comparator>();
  comparator.set("Threshold", 5.0);
  ASSERT_TRUE(comparator.start());
  const auto& rose = comparator.record<double>("Rose");
  const auto& fell = comparator.record<double>("Fell");
  for (const double value : {4.0, 6.0, 7.0, 4.5}) comparator.write("In", value);
  EXPECT_THAT(rose, ElementsAre(std::tuple(6.0)));
  EXPECT_THAT(fell, ElementsAre(std::tuple(4.5)));
  EXPECT_FALSE(comparator.output<bool>("Above"));
}

TEST(Comparator, WithinTheDeadBandStaysWhereItIs) {
  auto comparator = bench<Comparator>();
  comparator.set("DeadBand", 2.0);
  ASSERT_TRUE(comparator.start());
  const auto& rose = comparator.record<double>("Rose");
  const auto& fell = comparator.record<double>("Fell");
  for (const double value : {0.0, 0.9, 1.1, 0.0, -0.9, 0.9, -1.1}) comparator.write("In", value);
  EXPECT_THAT(rose, ElementsAre(std::tuple(1.1)));
  EXPECT_THAT(fell, ElementsAre(std::tuple(-1.1)));
}

TEST(Comparator, TheFirstValueIsNoChange) {
  auto comparator = bench<Comparator>();
  ASSERT_TRUE(comparator.start());
  const auto& rose = comparator.record<double>("Rose");
  comparator.write("In", 1.0);
  EXPECT_TRUE(comparator.output<bool>("Above"));
  EXPECT_TRUE(rose.empty());
}

TEST(Selector, PassesOnTheInputThatWasSelected) {
  auto selector = bench<Selector>();
  selector.set("Inputs", 3);
  ASSERT_TRUE(selector.start());
  selector.write("In1", 1.0);
  selector.write("In2", 2.0);
  EXPECT_EQ(selector.output<double>("Out"), 1.0);
  ASSERT_TRUE(selector.call("select", 2));
  selector.write("In1", 3.0);
  EXPECT_EQ(selector.output<double>("Out"), 1.0);
  selector.write("In2", 4.0);
  EXPECT_EQ(selector.output<double>("Out"), 4.0);
  EXPECT_THAT(selector.call("select", 4).error(), HasSubstr("no input has this number"));
}

struct Combined {
  const char* gate;
  std::vector<bool> result;  ///< of 00, 01, 10, 11
};
class LogicGate : public ::testing::TestWithParam<Combined> {};
INSTANTIATE_TEST_SUITE_P(Each, LogicGate,
                         ::testing::Values(Combined{"and", {false, false, false, true}},
                                           Combined{"or", {false, true, true, true}},
                                           Combined{"xor", {false, true, true, false}},
                                           Combined{"nor", {true, false, false, false}}),
                         [](const auto& test) { return test.param.gate; });

TEST_P(LogicGate, CombinesItsInputs) {
  auto logic = bench<Logic>();
  logic.set("Gate", GetParam().gate);
  ASSERT_TRUE(logic.start());
  std::vector<bool> result;
  for (const bool first : {false, true}) {
    for (const bool second : {false, true}) {
      logic.write("In1", first);
      logic.write("In2", second);
      result.push_back(logic.output<bool>("Out"));
    }
  }
  EXPECT_EQ(result, GetParam().result);
}

TEST(Logic, TellsWhenItsResultChanges) {
  auto logic = bench<Logic>();
  ASSERT_TRUE(logic.start());
  const auto& became_true = logic.record<>("BecameTrue");
  const auto& became_false = logic.record<>("BecameFalse");
  logic.write("In1", false);
  logic.write("In2", true);
  EXPECT_EQ(became_true.size() + became_false.size(), 0u);
  logic.write("In1", true);
  logic.write("In1", true);
  EXPECT_EQ(became_true.size(), 1u);
  logic.write("In2", false);
  EXPECT_EQ(became_false.size(), 1u);
}

TEST(Timer, RaisesItsEventEachPeriod) {
  auto timer = bench<Timer>(100ms);
  timer.set("Period", 0.5);
  ASSERT_TRUE(timer.start());
  const auto& ticks = timer.record<>("Tick");
  timer.run_cycles(4);
  EXPECT_EQ(ticks.size(), 0u);
  timer.run_cycles(1);
  EXPECT_EQ(ticks.size(), 1u);
  timer.run_cycles(95);
  EXPECT_EQ(ticks.size(), 20u);
  EXPECT_DOUBLE_EQ(timer.output<double>("Time"), 10.0);
}

TEST(Timer, ThatDoesNotRepeatRaisesItOnceUntilItIsRestarted) {
  auto timer = bench<Timer>(100ms);
  timer.set("Period", 0.2);
  timer.set("Repeat", false);
  ASSERT_TRUE(timer.start());
  const auto& ticks = timer.record<>("Tick");
  timer.run_cycles(50);
  EXPECT_EQ(ticks.size(), 1u);
  ASSERT_TRUE(timer.call("restart"));
  timer.run_cycles(50);
  EXPECT_EQ(ticks.size(), 2u);
}

TEST(Timer, ThatWaitsCountsFromRestartUntilStop) {
  auto timer = bench<Timer>(100ms);
  timer.set("Period", 0.2);
  timer.set("Waits", true);
  ASSERT_TRUE(timer.start());
  const auto& ticks = timer.record<>("Tick");
  timer.run_cycles(10);
  EXPECT_EQ(ticks.size(), 0u);
  ASSERT_TRUE(timer.call("restart"));
  timer.run_cycles(5);
  EXPECT_EQ(ticks.size(), 2u);
  ASSERT_TRUE(timer.call("stop"));
  timer.run_cycles(10);
  EXPECT_EQ(ticks.size(), 2u);
}

TEST(Timer, ThatIsRestartedAgainAndAgainNeverRings) {
  auto timer = bench<Timer>(100ms);
  timer.set("Period", 0.3);
  ASSERT_TRUE(timer.start());
  const auto& ticks = timer.record<>("Tick");
  for (int k = 0; k < 20; ++k) {
    timer.run_cycles(2);
    ASSERT_TRUE(timer.call("restart"));
  }
  EXPECT_EQ(ticks.size(), 0u);
  timer.run_cycles(3);
  EXPECT_EQ(ticks.size(), 1u);
}

}  // namespace
}  // namespace armature::general
