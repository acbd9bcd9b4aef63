// SPDX-License-Identifier: Apache-2.0
// Two axes with 1 rad/s, 2 rad/s^2, 20 rad/s^3, -0.5 to 4.5 rad, in simulated cycles of 10 ms.
#include "armature/controllers/teach/axes_generator_taught.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/base/fixed_text.hpp"
#include "armature/controllers/internal/test_generator.hpp"

namespace armature::controllers {
namespace {

using component::CommandStage;
using control::TaughtMotion;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// From (1, 2) by `size` there and back, in 4 s, at rest at both ends.
TaughtMotion a_swing(double size = 1.0) {
  control::TaughtSamples samples{2, {}, {}};
  for (double t = 0.0; t <= 4.0; t += 0.01) {
    const double share = 0.5 - 0.5 * std::cos(1.5707963 * t);
    samples.times_s.push_back(t);
    samples.positions.push_back(1.0 + size * 0.5 * share);
    samples.positions.push_back(2.0 - size * 0.3 * share * share);
  }
  return control::fit_taught_motion(samples).value();
}

class TaughtGenerator : public AxesGenerator {
 protected:
  TaughtGenerator() : AxesGenerator(std::make_unique<AxesGeneratorTaught>("Generator")) {}
  /// At each of which the limits are looked at.
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
  component::CommandHandle play(double speed = 1.0) {
    return generator.send("playPath", a_swing().points, speed);
  }
  std::string refusal_to_play(const Vector& points, double speed = 1.0) {
    const auto answer = generator.call("playPath", points, speed);
    return answer ? "accepted" : answer.error();
  }
  /// From the start at (0.25, 0.5) until the path has begun by a second.
  component::CommandHandle play_for_a_second() {
    start_at({1.0, 2.0});
    auto motion = play();
    cycle(100);
    EXPECT_GT(velocity()[0], 0.2);
    return motion;
  }
};

TEST_F(TaughtGenerator, MovesToTheBeginAndPlaysThePathToItsEnd) {
  start_at({0.25, 0.5});
  auto motion = play();
  const TaughtMotion taught = a_swing();
  double nearest = 1e9;
  int cycles = 0;
  for (; !motion.ended() && cycles < 2000; ++cycles) {
    cycle();
    nearest = std::min(nearest, std::hypot(desired()[0] - taught.positions_at(2.0)[0],
                                           desired()[1] - taught.positions_at(2.0)[1]));
  }
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
  EXPECT_LT(nearest, 0.01) << "through the middle of the swing";
  EXPECT_NEAR(desired()[0], 1.0, 1e-3);
  EXPECT_NEAR(desired()[1], 2.0, 1e-3);
  EXPECT_THAT(velocity(), Each(0.0));
  EXPECT_NEAR(cycles * 0.01, 2.1 + 0.5 + 4.1, 0.1) << "to the begin, rest, and as long as taught";
  cycle(10);
  EXPECT_THAT(velocity(), Each(0.0));
  EXPECT_EQ(refusal_of({1.0, 1.0}, 0.0), "accepted") << "the next motion begins there";
}

TEST_F(TaughtGenerator, TellsProgressAndRemainingTime) {
  start_at({1.0, 2.0});
  auto motion = play();
  cycle(200);
  EXPECT_NEAR(generator.get<double>("remaining_time"), 0.5 + 4.1 - 2.0, 0.1);
  EXPECT_NEAR(generator.get<double>("progress"), 2.0 / 4.6, 0.02);
  EXPECT_EQ(motion.progress(), generator.get<double>("progress"));
  cycle(300);
  EXPECT_EQ(generator.get<double>("remaining_time"), 0.0);
  EXPECT_EQ(generator.get<double>("progress"), 1.0);
}

TEST_F(TaughtGenerator, IsAsSlowAsTheLimitsAskAndSaysSo) {
  start_at({1.0, 2.0});
  auto motion = play(5.0);
  cycle(400);
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
  EXPECT_THAT(generator.log(), ::testing::Contains(HasSubstr("slower than 5 times its teaching")));
}

TEST_F(TaughtGenerator, CancelAndStopBrakeOnThePathAndHoldThere) {
  auto motion = play_for_a_second();
  motion.cancel();
  cycle(100);
  EXPECT_EQ(motion.stage(), CommandStage::kCancelled);
  EXPECT_THAT(velocity(), Each(0.0));
  auto again = play();
  cycle(200);
  generator.raise("Stop");
  cycle(1);
  EXPECT_EQ(again.stage(), CommandStage::kFailed);
  EXPECT_GT(std::abs(velocity()[0]), 0.1) << "smoothly";
  cycle(100);
  EXPECT_THAT(velocity(), Each(0.0));
  const Vector there = desired();
  cycle(300);
  EXPECT_EQ(desired(), there) << "nothing goes on";
  EXPECT_EQ(refusal_of({1.0, 1.0}, 0.0), "accepted");
}

TEST_F(TaughtGenerator, DisarmingEndsItAndNothingGoesOnAfterArming) {
  bool armed = true;
  generator.serve<bool()>("isArmed", [&armed] { return armed; });
  auto motion = play_for_a_second();
  measured = {1.2, 1.9};
  armed = false;
  generator.write("nAxesSensorPosition", measured);
  generator.raise("Disarm");
  cycle(1);
  EXPECT_EQ(motion.stage(), CommandStage::kFailed);
  EXPECT_THAT(desired(), ElementsAre(1.2, 1.9)) << "as measured";
  EXPECT_EQ(refusal_to_play(a_swing().points), "the robot is not armed: arm first");
  armed = true;
  cycle(300);
  EXPECT_THAT(desired(), ElementsAre(1.2, 1.9));
}

TEST_F(TaughtGenerator, ResetPositionBrakesFromTheMeasuredPosition) {
  auto motion = play_for_a_second();
  measured = desired();
  measured[0] += 0.02;
  generator.write("nAxesSensorPosition", measured);
  EXPECT_TRUE(generator.call("resetPosition"));
  EXPECT_EQ(motion.stage(), CommandStage::kFailed);
  cycle(100);
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(TaughtGenerator, TheNextMotionMayBeginWhileItBrakes) {
  auto motion = play_for_a_second();
  motion.cancel();
  cycle(3);
  EXPECT_GT(std::abs(velocity()[0]), 0.1);
  const double before = velocity()[0];
  while (!motion.ended()) cycle();
  EXPECT_EQ(refusal_of({3.0, 3.0}, 0.0), "accepted");
  cycle(1);
  EXPECT_LT(std::abs(velocity()[0] - before), 0.5);
  cycle(600);
  EXPECT_THAT(desired(), ElementsAre(3.0, 3.0));
}

TEST_F(TaughtGenerator, RefusesWhatCannotBePlayedAndNothingMoves) {
  start_at({0.25, 0.5});
  Vector wrong = a_swing().points;
  EXPECT_THAT(refusal_to_play({}), HasSubstr("another number of joints, or is empty"));
  EXPECT_THAT(refusal_to_play(Vector(21, 1.0)), HasSubstr("another number of joints"));
  EXPECT_THAT(refusal_to_play(wrong, 0.0), HasSubstr("speed must be from 0.01 to 10"));
  EXPECT_THAT(refusal_to_play(a_swing(20.0).points),
              HasSubstr("the motion leaves the limits of an axis: "));
  EXPECT_THAT(refusal_to_play(Vector(20000, 1.0)), HasSubstr("longer than max_duration"));
  wrong[9] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal_to_play(wrong), HasSubstr("axis 2: the motion has a number that is not"));
  const Vector there = desired();
  cycle(100);
  EXPECT_EQ(desired(), there);
}

TEST_F(TaughtGenerator, OneMotionAtATime) {
  start_at({1.0, 2.0});
  auto other = generator.send("moveTo", Vector{3.0, 3.0}, 0.0);
  cycle(20);
  EXPECT_EQ(refusal_to_play(a_swing().points), "a motion is under way: cancel it first");
  cycle(600);
  auto motion = play();
  cycle(20);
  EXPECT_EQ(refusal_of({1.0, 1.0}, 0.0), "a taught motion is under way: cancel it first");
}

TEST_F(TaughtGenerator, APeersLimitSlowsThePath) {
  generator.serve<double(const Vector&, const Vector&)>(
      "motionLimitUsed",
      [](const Vector&, const Vector& velocities) { return std::abs(velocities[0]) / 0.1; });
  start_at({1.0, 2.0});
  auto motion = play();
  int cycles = 0;
  for (; !motion.ended() && cycles < 3000; ++cycles) {
    cycle();
    EXPECT_LE(std::abs(velocity()[0]), 0.1);
  }
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
  EXPECT_GT(cycles, 1000);
}

TEST_F(TaughtGenerator, TheReferenceIsTheHandsWhileItLeads) {
  start_at({1.0, 2.0});
  generator.raise("Switched", base::FixedText<63>("weightless"));
  for (int i = 0; i < 50; ++i) {
    measured = {1.0 + 0.01 * i, 2.0};
    cycle();
    EXPECT_EQ(desired(), measured);
    EXPECT_THAT(velocity(), Each(0.0));
  }
  EXPECT_TRUE(generator.get<bool>("led_by_hand"));
  EXPECT_THAT(refusal_to_play(a_swing().points), HasSubstr("a hand leads the robot in the mode"));
  EXPECT_THAT(refusal_of({1.0, 1.0}, 0.0), HasSubstr("'weightless': switch to another mode"));
  generator.raise("Switched", base::FixedText<63>("npid"));
  measured = {0.0, 0.0};
  cycle(10);
  EXPECT_THAT(desired(), ElementsAre(1.49, 2.0)) << "where the hand left it";
  EXPECT_EQ(refusal_to_play(a_swing().points), "accepted");
}

TEST_F(TaughtGenerator, AMotionEndsWhenAHandBeginsToLead) {
  auto motion = play_for_a_second();
  generator.raise("Switched", base::FixedText<63>("weightless"));
  cycle(1);
  EXPECT_EQ(motion.stage(), CommandStage::kFailed);
  EXPECT_EQ(motion.reason(), "a hand leads the robot");
}

}  // namespace
}  // namespace armature::controllers
