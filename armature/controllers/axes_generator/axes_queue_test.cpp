// SPDX-License-Identifier: Apache-2.0
// Motions that wait for the one under way.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "armature/component/host.hpp"
#include "armature/controllers/internal/test_generator.hpp"
#include "armature/testing/realtime_guard.hpp"

namespace armature::controllers {
namespace {

using component::CommandStage;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(AxesGenerator, ASecondMotionWaitsAndBeginsWhereTheFirstEnds) {
  start_at({0.25, 0.5});
  auto first = generator.send("moveTo", Vector{1.25, 1.0}, 2.0);
  cycle(10);
  auto second = generator.send("moveTo", Vector{0.0, 0.0}, 2.0);
  EXPECT_EQ(second.stage(), CommandStage::kWaiting);
  cycle(189);
  EXPECT_EQ(first.stage(), CommandStage::kAccepted);
  EXPECT_EQ(second.progress(), 0.0);
  cycle();
  EXPECT_EQ(first.stage(), CommandStage::kDone);
  EXPECT_THAT(desired(), ElementsAre(1.25, 1.0));
  EXPECT_EQ(second.stage(), CommandStage::kAccepted);
  double largest_step = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double before = velocity()[0];
    cycle();
    largest_step = std::max(largest_step, std::abs(velocity()[0] - before));
  }
  EXPECT_EQ(second.stage(), CommandStage::kDone);
  EXPECT_THAT(desired(), ElementsAre(0.0, 0.0));
  EXPECT_LE(largest_step, 2.0 * 0.010 + 1e-9);
}

TEST_F(AxesGenerator, EightMotionsWaitAndTheNinthIsRefused) {
  start_at({0.0, 0.0});
  EXPECT_EQ(refusal_of({1.0, 1.0}, 2.0), "accepted");
  for (int i = 0; i < 8; ++i) EXPECT_EQ(refusal_of({0.1 * i, 0.0}, 2.0), "accepted");
  EXPECT_EQ(refusal_of({1.0, 1.0}, 2.0),
            "one command is under way and 8 wait, which is the most: wait until one is done");
  cycle(200 * 9);
  EXPECT_NEAR(desired()[0], 0.7, 1e-9);
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(AxesGenerator, AMotionThatWaitsIsRefusedAtOnceForWhatIsWrongAnywhere) {
  start_at({0.0, 0.0});
  EXPECT_EQ(refusal_of({1.0, 1.0}, 2.0), "accepted");
  EXPECT_EQ(refusal_of({1.0}, 1.0), "expected one number for each axis: expected 2, found 1");
  EXPECT_THAT(refusal_of({1.0, 5.0}, 1.0), HasSubstr("axis 2: a target is outside the limits"));
  EXPECT_EQ(refusal_of({1.0, 1.0}, -1.0), "the time is negative: -1");
}

/// How long a motion takes at least is known only where it begins.
TEST_F(AxesGenerator, AMotionThatWaitedIsRefusedForItsTimeWhenItsTurnComes) {
  start_at({0.0, 0.0});
  EXPECT_EQ(refusal_of({2.0, 0.0}, 3.0), "accepted");
  auto fast = generator.send("moveTo", Vector{0.0, 0.0}, 1.0);
  auto behind = generator.send("moveTo", Vector{1.0, 0.0}, 0.0);
  EXPECT_EQ(fast.stage(), CommandStage::kWaiting);
  cycle(300);
  EXPECT_EQ(fast.stage(), CommandStage::kRefused);
  EXPECT_THAT(std::string(fast.reason()), HasSubstr("it takes 2.5 s at least, found 1 s"));
  EXPECT_EQ(behind.stage(), CommandStage::kCancelled);
  EXPECT_THAT(generator.log(), ElementsAre(HasSubstr("refused when its turn came")));
  cycle(300);
  EXPECT_THAT(desired(), ElementsAre(2.0, 0.0));
}

/// Nothing that waited goes on, also not once the robot is armed again.
TEST_F(OfAnArmedRobot, WhateverEndsAMotionEndsThoseThatWait) {
  const char* const events[] = {"Stop", "Disarm", "Settle"};
  for (const char* event : events) {
    armed = true;
    auto first = generator.send("moveTo", Vector{1.0, 1.0}, 2.0);
    auto second = generator.send("moveTo", Vector{0.0, 0.0}, 2.0);
    ASSERT_EQ(second.stage(), CommandStage::kWaiting) << event;
    cycle(50);
    generator.raise(event);
    EXPECT_EQ(first.stage(), CommandStage::kFailed) << event;
    EXPECT_EQ(second.stage(), CommandStage::kCancelled) << event;
    cycle(100);
    generator.raise("Settle");
    generator.raise("Arm");
    cycle();
    const Vector rest = desired();
    cycle(300);
    EXPECT_EQ(desired(), rest) << event;
  }
}

TEST_F(OfAnArmedRobot, AMotionThatWaitedIsRefusedIfItIsArmedNoMore) {
  armed = true;
  auto first = generator.send("moveTo", Vector{1.0, 1.0}, 2.0);
  auto second = generator.send("moveTo", Vector{0.0, 0.0}, 2.0);
  armed = false;  // and no event came
  cycle(400);
  EXPECT_EQ(first.stage(), CommandStage::kDone);
  EXPECT_EQ(second.stage(), CommandStage::kRefused);
  EXPECT_EQ(second.reason(), "the robot is not armed: arm first");
  EXPECT_THAT(desired(), ElementsAre(1.0, 1.0));
}

TEST_F(AxesGenerator, CancelResetAStopAndAFaultEndThoseThatWait) {
  const std::pair<const char*, std::function<void(component::CommandHandle&)>> ends[] = {
      {"cancel", [this](component::CommandHandle& first) { first.cancel(), cycle(); }},
      {"reset",
       [this](component::CommandHandle&) { static_cast<void>(generator.call("resetPosition")); }},
      {"stop", [this](component::CommandHandle&) { generator.stop(); }},
      {"fault", [this](component::CommandHandle&) { generator.component().fault("lost"); }}};
  for (const auto& [name, end] : ends) {
    if (generator.state() == component::State::kException) {
      static_cast<void>(component::Host::reset(generator.component()));
    }
    generator.stop();
    start_at({0.0, 0.0});
    auto first = generator.send("moveTo", Vector{1.0, 1.0}, 2.0);
    auto second = generator.send("moveTo", Vector{0.5, 0.0}, 2.0);
    ASSERT_EQ(second.stage(), CommandStage::kWaiting) << name;
    cycle(10);
    end(first);
    EXPECT_EQ(second.stage(), CommandStage::kCancelled) << name;
  }
}

TEST_F(AxesGenerator, QueuesWithoutAllocating) {
  start_at({0.0, 0.0});
  auto first = generator.send("moveTo", Vector{1.0, 1.0}, 2.0);
  const testing::RealtimeGuard guard;
  auto second = generator.send("moveTo", Vector{0.5, 0.5}, 2.0);
  cycle(400);
  EXPECT_EQ(second.stage(), CommandStage::kDone);
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
}

}  // namespace
}  // namespace armature::controllers
