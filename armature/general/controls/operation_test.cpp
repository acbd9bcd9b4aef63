// SPDX-License-Identifier: Apache-2.0
// Controls that somebody operates.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/general/controls/button.hpp"
#include "armature/general/controls/latch.hpp"
#include "armature/general/controls/slider.hpp"
#include "armature/general/controls/switch.hpp"
#include "armature/testing/harness.hpp"

namespace armature::general {
namespace {

using namespace std::chrono_literals;
using testing::Harness;
using ::testing::HasSubstr;

template <typename Control>
Harness bench() {
  return Harness(std::make_unique<Control>("Control"), 10ms);
}

TEST(Button, RaisesItsEventWhenItIsPressed) {
  auto button = bench<Button>();
  ASSERT_TRUE(button.start());
  const auto& pressed = button.record<>("Pressed");
  ASSERT_TRUE(button.call("press"));
  ASSERT_TRUE(button.call("press"));
  EXPECT_EQ(pressed.size(), 2u);
}

TEST(Switch, IsAsItWasTurnedLast) {
  auto toggle = bench<Switch>();
  ASSERT_TRUE(toggle.start());
  const auto& on = toggle.record<>("TurnedOn");
  const auto& off = toggle.record<>("TurnedOff");
  toggle.run_cycles(1);
  EXPECT_FALSE(toggle.output<bool>("On"));
  ASSERT_TRUE(toggle.call("turn", true));
  ASSERT_TRUE(toggle.call("turn", true));
  EXPECT_TRUE(toggle.output<bool>("On"));
  EXPECT_EQ(on.size(), 1u);
  ASSERT_TRUE(toggle.call("turn", false));
  EXPECT_EQ(off.size(), 1u);
}

TEST(Switch, BeginsAsTheDeploymentSays) {
  auto toggle = bench<Switch>();
  toggle.set("Initially", true);
  ASSERT_TRUE(toggle.start());
  toggle.run_cycles(1);
  EXPECT_TRUE(toggle.output<bool>("On"));
  ASSERT_TRUE(toggle.call("turn", false));
  toggle.stop();
  ASSERT_TRUE(toggle.start());
  toggle.run_cycles(1);
  EXPECT_TRUE(toggle.output<bool>("On"));
}

TEST(Slider, StaysWhereItWasMovedWithinItsBounds) {
  auto slider = bench<Slider>();
  ASSERT_TRUE(slider.start());
  ASSERT_TRUE(slider.call("move", 0.25));
  slider.run_cycles(1000);
  EXPECT_EQ(slider.output<double>("Out"), 0.25);
  ASSERT_TRUE(slider.call("move", 7.0));
  EXPECT_EQ(slider.output<double>("Out"), 1.0);
}

TEST(Slider, IsMovedToNumbersOnly) {
  auto slider = bench<Slider>();
  ASSERT_TRUE(slider.start());
  EXPECT_THAT(slider.call("move", std::numeric_limits<double>::quiet_NaN()).error(),
              HasSubstr("not to NaN"));
}

TEST(Slider, ThatIsHeldGoesBackWhenNobodyMovesItAnyMore) {
  auto slider = bench<Slider>();
  slider.set("Hold", true);
  slider.set("Low", -1.0);
  slider.set("Release", 0.15);
  ASSERT_TRUE(slider.start());
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(slider.call("move", -0.5));
    slider.run_cycles(5);
    EXPECT_EQ(slider.output<double>("Out"), -0.5) << "it is moved every 50 ms";
  }
  slider.run_cycles(10);
  EXPECT_EQ(slider.output<double>("Out"), -0.5) << "for 150 ms";
  slider.run_cycles(2);
  EXPECT_EQ(slider.output<double>("Out"), 0.0);
}

TEST(Slider, AfterARestartIsAtRest) {
  auto slider = bench<Slider>();
  slider.set("Rest", 0.5);
  ASSERT_TRUE(slider.start());
  ASSERT_TRUE(slider.call("move", 1.0));
  slider.stop();
  ASSERT_TRUE(slider.start());
  slider.run_cycles(1);
  EXPECT_EQ(slider.output<double>("Out"), 0.5);
}

TEST(Latch, PassesOnTheLastNumberThatItWasToldOnce) {
  auto latch = bench<Latch>();
  ASSERT_TRUE(latch.start());
  latch.run_cycles(3);
  EXPECT_EQ(latch.writes("Out"), 0u);
  ASSERT_TRUE(latch.call("set", 2.5));
  EXPECT_EQ(latch.output<double>("Out"), 2.5);
  latch.run_cycles(3);
  EXPECT_EQ(latch.writes("Out"), 1u) << "its reader sees how old the number is";
}

TEST(Latch, IsToldNumbersOnly) {
  auto latch = bench<Latch>();
  ASSERT_TRUE(latch.start());
  EXPECT_FALSE(latch.call("set", std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(latch.writes("Out"), 0u);
}

}  // namespace
}  // namespace armature::general
