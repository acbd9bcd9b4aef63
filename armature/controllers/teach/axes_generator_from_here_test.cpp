// SPDX-License-Identifier: Apache-2.0
// Paths that begin where the axes rest, and those that somebody holds on to: two axes with 1 rad/s,
// 2 rad/s^2, -0.5 to 4.5 rad, in simulated cycles of 10 ms.
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/internal/test_generator.hpp"
#include "armature/controllers/teach/axes_generator_taught.hpp"

namespace armature::controllers {
namespace {

using component::CommandStage;
using ::testing::Each;
using ::testing::HasSubstr;

/// From (1, 2) on at 0.1 rad/s, for 20 s.
Vector a_line() {
  Vector points;
  for (int k = 0; k < 500; ++k) {
    points.push_back(1.0 + 0.1 * control::kKnotSpacing_s * (k - 1));
    points.push_back(2.0);
  }
  return points;
}

class FromHere : public AxesGenerator {
 protected:
  FromHere() : AxesGenerator(std::make_unique<AxesGeneratorTaught>("Generator")) {
    start_at({1.0, 2.0});
  }
  void cycle(int count = 1) override {
    for (int i = 0; i < count; ++i) {
      generator.write("nAxesSensorPosition", measured);
      generator.run_cycles();
      if (generator.writes("nAxesDesiredPosition") == 0u) return;
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_LE(std::abs(velocity()[k]), 1.0 + 1e-9);
        EXPECT_LE(std::abs(acceleration()[k]), 2.0 + 1e-6);
      }
    }
  }
  std::string refusal_to(const char* command, double speed = 1.0) {
    const auto answer = generator.call(command, a_line(), speed);
    return answer ? "accepted" : answer.error();
  }
  bool renew() { return generator.call<bool>("keepJoggingPath").value(); }
  void hold(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      EXPECT_TRUE(renew());
      cycle();
    }
  }
};

TEST_F(FromHere, ItPlaysAtOnceAndToTheEnd) {
  auto motion = generator.send("playFromHere", a_line(), 5.0);
  cycle(80);  // 64 places of the path are timed in each
  EXPECT_GT(velocity()[0], 0.05);
  cycle(500);
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
  EXPECT_NEAR(desired()[0], 1.0 + 0.1 * 497 * control::kKnotSpacing_s, 1e-6);
}

TEST_F(FromHere, ElsewhereOrInMotionItIsRefusedAndNothingChanges) {
  for (const char* command : {"playFromHere", "jogPath"}) {
    auto other = generator.send("moveTo", Vector{1.5, 2.0}, 0.0);
    cycle(20);
    EXPECT_EQ(refusal_to(command), "a motion is under way: cancel it first");
    cycle(300);
    ASSERT_EQ(other.stage(), CommandStage::kDone);
    const Vector there = desired();
    EXPECT_EQ(refusal_to(command), "axis 1: the axes do not rest where the motion begins: at 1.5");
    cycle(50);
    EXPECT_EQ(desired(), there);
    auto back = generator.send("moveTo", Vector{1.0, 2.0}, 0.0);
    cycle(300);
    ASSERT_EQ(back.stage(), CommandStage::kDone);
    auto playing = generator.send("playFromHere", a_line(), 5.0);
    cycle(50);
    EXPECT_EQ(refusal_to("jogPath"), "a motion is under way: cancel it first");
    EXPECT_EQ(refusal_to("playPath"), "a motion is under way: cancel it first");
    EXPECT_EQ(refusal_of({1.0, 2.0}, 0.0), "a taught motion is under way: cancel it first");
    EXPECT_FALSE(renew());
    playing.cancel();
    cycle(2);
    ASSERT_GT(velocity()[0], 0.1);
    EXPECT_EQ(refusal_to(command), "the axes still brake: wait until they rest");
    cycle(100);
    EXPECT_THAT(velocity(), Each(0.0));
    auto again = generator.send("moveTo", Vector{1.0, 2.0}, 0.0);
    cycle(300);
    ASSERT_EQ(again.stage(), CommandStage::kDone);
  }
}

TEST_F(FromHere, AJogGoesOnAsLongAsItIsRenewed) {
  auto jog = generator.send("jogPath", a_line(), 3.0);
  hold(300);
  EXPECT_NEAR(velocity()[0], 0.3, 1e-6);
  EXPECT_EQ(jog.stage(), CommandStage::kAccepted);
  jog.cancel();
  cycle(60);
  EXPECT_EQ(jog.stage(), CommandStage::kCancelled);
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(FromHere, AJogBrakes150MsAfterTheLastRenewal) {
  auto jog = generator.send("jogPath", a_line(), 3.0);
  hold(100);
  cycle(14);  // the last renewal came before the last cycle of `hold`
  EXPECT_NEAR(velocity()[0], 0.3, 1e-6);
  cycle(2);
  EXPECT_LT(acceleration()[0], 0.0) << "it brakes";
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(renew()) << "what comes late";
    cycle();
  }
  cycle(60);
  EXPECT_EQ(jog.stage(), CommandStage::kDone);
  EXPECT_THAT(velocity(), Each(0.0));
  EXPECT_FALSE(renew());
  const Vector there = desired();
  cycle(100);
  EXPECT_EQ(desired(), there);
}

TEST_F(FromHere, AJogThatNobodyRenewsHardlyBegins) {
  auto jog = generator.send("jogPath", a_line(), 3.0);
  cycle(100);
  EXPECT_EQ(jog.stage(), CommandStage::kDone);
  EXPECT_LT(desired()[0], 1.0 + 0.3 * 0.15 + 0.02);
}

TEST_F(FromHere, StopAndDisarmEndAJogAndNothingGoesOn) {
  for (const char* event : {"Stop", "Disarm"}) {
    auto jog = generator.send("jogPath", a_line(), 3.0);
    hold(50);
    measured = desired();
    generator.raise(event);
    cycle(1);
    EXPECT_EQ(jog.stage(), CommandStage::kFailed);
    EXPECT_FALSE(renew());
    cycle(100);
    EXPECT_THAT(velocity(), Each(0.0));
    auto back = generator.send("moveTo", Vector{1.0, 2.0}, 0.0);
    cycle(300);
    ASSERT_EQ(back.stage(), CommandStage::kDone);
  }
}

TEST(FromHereUnarmed, NothingIsPlayed) {
  testing::Harness generator(std::make_unique<AxesGeneratorTaught>("Generator"),
                             std::chrono::milliseconds(10));
  generator.set("num_axes", 2);
  for (const char* name : {"max_vel", "max_acc"}) generator.set(name, "[1.0]");
  generator.set("lower", "[-0.5]");
  generator.set("upper", "[4.5]");
  generator.serve<bool()>("isArmed", [] { return false; });
  ASSERT_TRUE(generator.start()) << generator.reason();
  generator.write("nAxesSensorPosition", Vector{1.0, 2.0});
  generator.run_cycles();
  for (const char* command : {"playFromHere", "jogPath"}) {
    EXPECT_EQ(generator.call(command, a_line(), 1.0).error(), "the robot is not armed: arm first");
  }
}

}  // namespace
}  // namespace armature::controllers
