// SPDX-License-Identifier: Apache-2.0
// One axis moves while it is held on to, in simulated time: limits of 1 rad/s and 2 rad/s^2, -0.5
// to 4.5 rad, cycles of 10 ms.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/internal/test_generator.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using ::testing::Each;
using ::testing::ElementsAre;

/// A generator at rest, whose axes are jogged.
class Jogged : public AxesGenerator {
 protected:
  Jogged() { start_at({0.25, 0.5}); }

  std::string refusal_of_jog(int axis, double speed) {
    const auto answer = generator.call("jog", axis, speed);
    return answer ? "accepted" : answer.error();
  }
  bool renew(int axis, double speed) {
    return generator.call<bool>("keepJogging", axis, speed).value();
  }
  /// Held for so many cycles, each renewed.
  void hold(int cycles, int axis, double speed) {
    for (int i = 0; i < cycles; ++i) {
      EXPECT_TRUE(renew(axis, speed));
      cycle();
    }
  }
};

TEST_F(Jogged, MovesItsAxisAtTheVelocityAsLongAsItIsRenewed) {
  auto jog = generator.send("jog", 2, -0.2);
  double fastest_change = 0.0;
  double last = 0.0;
  for (int i = 0; i < 200; ++i) {
    if (i % 5 == 0) EXPECT_TRUE(renew(2, -0.2)) << i;
    cycle();
    fastest_change = std::max(fastest_change, std::abs(velocity()[1] - last));
    last = velocity()[1];
    if (i > 12) EXPECT_NEAR(velocity()[1], -0.2, 1e-9) << "it is there after 0.1 s";
  }
  EXPECT_LE(fastest_change, 2.0 * 0.01 + 1e-9);
  EXPECT_EQ(jog.stage(), CommandStage::kAccepted);
  EXPECT_EQ(desired()[0], 0.25);
  EXPECT_NEAR(desired()[1], 0.5 - 0.2 * 2.0 + 0.01, 1e-6) << "less half of the ramp";
}

TEST_F(Jogged, BrakesSmoothly150MsAfterTheLastRenewal) {
  auto jog = generator.send("jog", 1, 0.2);
  hold(30, 1, 0.2);
  EXPECT_NEAR(velocity()[0], 0.2, 1e-9);
  cycle(14);  // 150 ms after the last one, which came before the last cycle of `hold`
  EXPECT_NEAR(velocity()[0], 0.2, 1e-9);
  EXPECT_EQ(jog.stage(), CommandStage::kAccepted);
  cycle();
  EXPECT_LT(acceleration()[0], 0.0) << "it brakes";
  const double there = desired()[0];
  int cycles = 0;
  for (; jog.stage() == CommandStage::kAccepted && cycles < 100; ++cycles) {
    cycle();
    EXPECT_GE(acceleration()[0], -2.0 - 1e-9);
  }
  EXPECT_EQ(jog.stage(), CommandStage::kDone) << "once it has come to rest";
  EXPECT_LE(cycles, 11) << "0.2 rad/s at 2 rad/s^2";
  EXPECT_LE(desired()[0] - there, 0.2 * 0.2 / (2.0 * 2.0) + 1e-9);
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(Jogged, RenewalsThatComeLateMoveNothing) {
  auto jog = generator.send("jog", 1, 0.9);
  hold(60, 1, 0.9);
  cycle(16);
  EXPECT_LT(velocity()[0], 0.9) << "it brakes already";
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(renew(1, 0.9));
  cycle(60);
  EXPECT_EQ(jog.stage(), CommandStage::kDone);
  const Vector rest = desired();
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(renew(1, 0.9));
  cycle(50);
  EXPECT_EQ(desired(), rest);
}

TEST_F(Jogged, ARenewalIsForItsOwnJogOnly) {
  auto jog = generator.send("jog", 1, 0.2);
  for (int i = 0; i < 30; ++i) {
    EXPECT_FALSE(renew(2, 0.2));
    EXPECT_FALSE(renew(1, -0.2));
    cycle();
  }
  EXPECT_EQ(jog.stage(), CommandStage::kDone);
  EXPECT_LT(desired()[0], 0.25 + 0.2 * 0.15 + 0.01);
}

TEST_F(Jogged, CancelledItBrakesSmoothly) {
  auto jog = generator.send("jog", 1, 0.4);
  hold(30, 1, 0.4);
  const double there = desired()[0];
  jog.cancel();
  cycle();
  EXPECT_EQ(jog.stage(), CommandStage::kCancelled);
  EXPECT_GT(velocity()[0], 0.0);
  cycle(30);
  EXPECT_THAT(velocity(), Each(0.0));
  EXPECT_NEAR(desired()[0], there + 0.4 * 0.4 / (2.0 * 2.0), 0.005);
}

TEST_F(Jogged, EndsAtTheLimitOfItsAxis) {
  auto jog = generator.send("jog", 1, -1.0);
  for (int i = 0; i < 200 && jog.stage() == CommandStage::kAccepted; ++i) {
    renew(1, -1.0);
    cycle();
    EXPECT_GE(desired()[0], -0.5);
  }
  EXPECT_EQ(jog.stage(), CommandStage::kDone);
  EXPECT_EQ(desired()[0], -0.5);
  EXPECT_EQ(refusal_of_jog(1, -0.1), "axis 1: the axis is at its limit");
  EXPECT_EQ(refusal_of_jog(1, 0.1), "accepted");
}

TEST_F(Jogged, RefusesWhatCannotBeWithTheReason) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal_of_jog(0, 0.1), "axis 0: expected 1 to 2");
  EXPECT_EQ(refusal_of_jog(3, 0.1), "axis 3: expected 1 to 2");
  EXPECT_EQ(
      refusal_of_jog(1, 1.1),
      "axis 1: the motion is faster than the limits allow: 1.1 rad/s, expected at most 1 rad/s");
  EXPECT_EQ(refusal_of_jog(1, kNan), "axis 1: a number is not finite: nan");
  EXPECT_EQ(refusal_of_jog(2, 0.0), "axis 2: the velocity is 0");
  EXPECT_FALSE(renew(1, 1.1));
  cycle(10);
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5));
}

TEST_F(Jogged, OneMotionAtATime) {
  auto jog = generator.send("jog", 1, 0.1);
  EXPECT_EQ(refusal_of({1.0, 1.0}, 0.0), "a motion is under way");
  EXPECT_NE(refusal_of_jog(2, 0.1), "accepted");
  cycle(60);
  EXPECT_EQ(jog.stage(), CommandStage::kDone);
  auto motion = generator.send("moveTo", Vector{1.0, 1.0}, 0.0);
  EXPECT_EQ(refusal_of_jog(1, 0.1), "a motion is under way");
  cycle(500);
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
}

TEST_F(Jogged, StopAndDisarmEndIt) {
  auto jog = generator.send("jog", 1, 0.5);
  hold(30, 1, 0.5);
  generator.raise("Stop");
  cycle();
  EXPECT_EQ(jog.stage(), CommandStage::kFailed);
  cycle(60);
  EXPECT_THAT(velocity(), Each(0.0));
  auto other = generator.send("jog", 1, 0.5);
  hold(10, 1, 0.5);
  generator.raise("Disarm");
  cycle();
  EXPECT_EQ(other.stage(), CommandStage::kFailed);
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5)) << "what is measured";
}

TEST_F(OfAnArmedRobot, AJogIsRefusedUntilItIsArmed) {
  const auto answer = generator.call("jog", 1, 0.1);
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error(), "the robot is not armed: arm first");
  EXPECT_FALSE(generator.call<bool>("keepJogging", 1, 0.1).value());
  armed = true;
  EXPECT_TRUE(generator.call("jog", 1, 0.1));
}

TEST(AxesGeneratorTip, AJogIsNoFasterThanAPeersLimitAllows) {
  testing::Harness generator(std::make_unique<AxesGeneratorPos>("Generator"), 10ms);
  generator.set("num_axes", 1);
  generator.set("max_vel", "[1.0]");
  generator.set("max_acc", "[2.0]");
  generator.set("lower", "[-4]");
  generator.set("upper", "[4]");
  generator.serve<double(const Vector&, const Vector&)>(
      "motionLimitUsed",
      [](const Vector&, const Vector& velocities) { return std::abs(velocities[0]) / 0.5; });
  ASSERT_TRUE(generator.start()) << generator.reason();
  generator.write("nAxesSensorPosition", Vector{0.0});
  generator.run_cycles();
  const auto answer = generator.call("jog", 1, 0.8);
  ASSERT_FALSE(answer);
  EXPECT_EQ(
      answer.error(),
      "axis 1: the motion is faster than the limits allow: 0.8 rad/s, expected at most 0.5 rad/s");
  EXPECT_TRUE(generator.call("jog", 1, 0.5));
}

}  // namespace
}  // namespace armature::controllers
