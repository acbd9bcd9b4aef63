// SPDX-License-Identifier: Apache-2.0
// Two axes with 2 rad/s, 4 rad/s^2, 40 rad/s^3, -2 to 2 rad, in cycles of 2 ms.
#include "armature/control/taught/taught_player.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using Vector = std::vector<double>;

constexpr double kVelocity = 2.0;
constexpr double kAcceleration = 4.0;

/// Once round from rest to rest, with 1 rad/s and 2 rad/s^2 at most.
TaughtMotion a_circle(double size = 0.5) {
  TaughtSamples samples{2, {}, {}};
  for (double t = 0.0; t <= 6.0; t += 0.01) {
    const double x = t / 6.0;
    const double angle = 2.0 * 3.14159265 * x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
    samples.times_s.push_back(t);
    samples.positions.push_back(size * std::cos(angle));
    samples.positions.push_back(size * std::sin(angle));
  }
  return fit_taught_motion(samples).value();
}

class Played : public ::testing::Test {
 protected:
  void begin(const TaughtMotion& taught, double speed, const Vector& from = {0.0, 0.0},
             MotionLimit* limit = nullptr) {
    motion = taught;
    nearest_s_ = 0.0;
    const auto answer = player.play({from}, motion.points, speed, limit);
    ASSERT_TRUE(answer.accepted()) << to_text(answer.refusal);
  }
  /// Keeps the limits, and goes on without a step; on the path nowhere but on the path.
  void cycle() {
    const Vector before(player.positions().begin(), player.positions().end());
    const Vector slow(player.velocities().begin(), player.velocities().end());
    player.step(2ms);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      EXPECT_LE(std::abs(player.velocities()[axis]), kVelocity + 1e-9);
      EXPECT_LE(std::abs(player.accelerations()[axis]), kAcceleration + 1e-6);
      EXPECT_LE(std::abs(player.velocities()[axis] - slow[axis]), kAcceleration * 0.002 + 1e-6);
      EXPECT_NEAR(player.positions()[axis] - before[axis],
                  0.001 * (slow[axis] + player.velocities()[axis]), 1e-5);
    }
    if (player.on_path()) {
      path_s += 0.002;
      furthest = std::max(furthest, from_path());
    }
  }
  void play_out() {
    for (int i = 0; i < 100000 && player.under_way(); ++i) cycle();
    EXPECT_FALSE(player.under_way());
  }
  /// It never goes back, so that the nearest place is looked for from the last one on.
  double from_path() {
    double nearest = 1e9;
    for (double t = std::max(0.0, nearest_s_ - 0.01), last = t + 0.05; t <= last; t += 0.0005) {
      const Vector there = motion.positions_at(t);
      const double apart =
          std::hypot(there[0] - player.positions()[0], there[1] - player.positions()[1]);
      if (apart < nearest) nearest_s_ = t;
      nearest = std::min(nearest, apart);
    }
    return nearest;
  }

  TaughtPlayer player =
      TaughtPlayer::make(
          {std::vector(2, OnlineTrajectory::Axis{kVelocity, kAcceleration, 40.0, -2.0, 2.0}), 20.0})
          .value();
  TaughtMotion motion;
  double path_s = 0.0;
  double furthest = 0.0;

 private:
  double nearest_s_ = 0.0;
};

TEST_F(Played, AtSpeed1TakesAsLongAsTheTeachingAndIsWhereThatWas) {
  begin(a_circle(), 1.0);
  while (!player.on_path()) cycle();
  EXPECT_NEAR(player.remaining_s(), 6.0, 0.3);
  const double begun_s = path_s;
  play_out();
  EXPECT_NEAR(path_s - begun_s, motion.duration_s(), 0.15) << "it begins and ends at rest";
  EXPECT_FALSE(player.slowed());
  EXPECT_LT(furthest, 1e-3);
}

TEST_F(Played, AtATenthAndThreeTimesTheSpeedThePathIsTheSameWithinTheLimits) {
  for (const double speed : {0.1, 3.0}) {
    path_s = furthest = 0.0;
    begin(a_circle(), speed);
    play_out();
    EXPECT_LT(furthest, 1e-3) << speed;
    EXPECT_GT(path_s, motion.duration_s() / speed) << speed;
    EXPECT_EQ(player.slowed(), speed > 1.0) << "the limits do not allow it three times as fast";
    const Vector end = motion.positions_at(1e9);
    EXPECT_NEAR(player.positions()[0], end[0], 1e-9);
    EXPECT_NEAR(player.positions()[1], end[1], 1e-9);
  }
  EXPECT_LT(path_s, 5.0) << "faster than taught where the limits allow it";
}

TEST_F(Played, FromAnywhereItMovesToTheBeginFirst) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-2.0, 2.0);
  for (int i = 0; i < 10; ++i) {
    const Vector from{anywhere(random), anywhere(random)};
    begin(a_circle(), 1.0, from);
    EXPECT_NEAR(player.positions()[0], from[0], 1e-12);
    play_out();
  }
  EXPECT_LT(furthest, 1e-3);
}

TEST_F(Played, AMotionThatIsUnderWayGoesOverToTheBegin) {
  auto other = OnlineTrajectory::make({std::vector(2, OnlineTrajectory::Axis{2.0, 4.0, 40.0})});
  const Vector zero(2, 0.0);
  const Vector far{1.5, -1.5};
  ASSERT_TRUE(other.value().hold(zero).accepted() && other.value().move_to({far}).accepted());
  for (int i = 0; i < 250; ++i) other.value().step(2ms);
  ASSERT_GT(other.value().velocities()[0], 0.5);
  motion = a_circle();
  ASSERT_TRUE(player
                  .play({other.value().positions(), other.value().velocities(),
                         other.value().accelerations()},
                        motion.points, 1.0, nullptr)
                  .accepted());
  play_out();
  EXPECT_LT(furthest, 1e-3);
}

TEST_F(Played, RandomMotionsKeepTheLimitsAtEverySpeed) {
  std::mt19937 random(5);
  std::normal_distribution<double> step(0.0, 0.05);
  for (int i = 0; i < 20; ++i) {
    TaughtMotion jagged{2, Vector(2 * 60, 0.0)};
    for (std::size_t k = 2; k < jagged.points.size(); ++k) {
      jagged.points[k] = std::clamp(jagged.points[k - 2] + step(random), -2.0, 2.0);
    }
    furthest = 0.0;
    begin(jagged, 0.1 + 0.4 * i);
    play_out();
    EXPECT_LT(furthest, 5e-3) << i;
  }
}

TEST_F(Played, AStopBrakesOnThePathAndStaysThere) {
  for (const int cycles : {100, 600, 1100, 1800}) {
    begin(a_circle(), 1.0, {0.4, 0.0});
    for (int i = 0; i < cycles; ++i) cycle();
    ASSERT_TRUE(player.under_way());
    furthest = 0.0;
    player.stop();
    int took = 0;
    for (; player.under_way() && took < 1000; ++took) cycle();
    EXPECT_LT(took, 500) << "at most a second";
    EXPECT_LT(furthest, 1e-3);
    EXPECT_EQ(player.velocities()[0], 0.0);
    const double there = player.positions()[0];
    player.step(2ms);
    EXPECT_EQ(player.positions()[0], there);
  }
}

TEST_F(Played, TellsHowLongItStillTakesToATenthOfASecond) {
  begin(a_circle(), 3.0);
  for (int i = 0; i < 100; ++i) cycle();  // the path is planned by then
  const double remaining_s = player.remaining_s();
  double passed_s = 0.0;
  double progress = player.progress();
  for (; player.under_way(); passed_s += 0.002) {
    cycle();
    EXPECT_GE(player.progress(), progress - 1e-9);
    progress = player.progress();
  }
  EXPECT_NEAR(passed_s, remaining_s, 0.1);
  EXPECT_NEAR(progress, 1.0, 1e-6);
  EXPECT_EQ(player.remaining_s(), 0.0);
}

/// As a robot whose tip is to be slow.
struct SlowFirstAxis final : MotionLimit {
  double most = 0.2;
  double used(std::span<const double>, std::span<const double> velocities) override {
    return std::abs(velocities[0]) / most;
  }
};

TEST_F(Played, KeepsTheLimitOfTheWholeRobotOnTheWayAndOnThePath) {
  SlowFirstAxis slow;
  begin(a_circle(), 1.0, {-1.0, 1.0}, &slow);
  while (player.under_way()) {
    cycle();
    EXPECT_LE(std::abs(player.velocities()[0]), 0.2 + 1e-3);
  }
  EXPECT_TRUE(player.slowed());
  EXPECT_GT(path_s, 7.0);
}

TEST_F(Played, AnImpossibleLimitIsToldAndNothingIsPlayed) {
  struct Impossible final : MotionLimit {
    double used(std::span<const double> positions, std::span<const double>) override {
      return positions[0] < 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
    }
  } impossible;
  begin(a_circle(), 1.0, {0.1, 0.0}, &impossible);
  play_out();
  EXPECT_FALSE(player.possible());
  EXPECT_EQ(path_s, 0.0);
}

TEST_F(Played, RefusesWhatCannotBePlayedAndNothingMoves) {
  const Vector from{0.0, 0.0};
  const Vector good = a_circle().points;
  const auto refusal = [&](const Vector& points, double speed) {
    return player.play({from}, points, speed, nullptr);
  };
  EXPECT_EQ(refusal({}, 1.0).refusal, PlayRefusal::kWrongNumber);
  EXPECT_EQ(refusal(Vector(9, 0.0), 1.0).refusal, PlayRefusal::kWrongNumber);
  EXPECT_EQ(refusal(Vector(100000, 0.0), 1.0).refusal, PlayRefusal::kTooLong);
  for (const double speed : {0.0, -1.0, 11.0, std::nan("")}) {
    EXPECT_EQ(refusal(good, speed).refusal, PlayRefusal::kSpeed);
  }
  Vector wrong = good;
  wrong[11] = std::nan("");
  EXPECT_EQ(refusal(wrong, 1.0).refusal, PlayRefusal::kNotFinite);
  const auto outside = refusal(a_circle(2.5).points, 1.0);
  EXPECT_EQ(outside.refusal, PlayRefusal::kOutsideLimits);
  EXPECT_EQ(outside.axis, 0u);
  EXPECT_GT(outside.found, 2.0);
  const Vector nowhere{std::nan(""), 0.0};
  EXPECT_EQ(player.play({nowhere}, good, 1.0, nullptr).refusal, PlayRefusal::kNoPosition);
  EXPECT_FALSE(player.under_way());
}

/// From `from` on at an even speed, from its begin to its end, as a jog is.
Vector even_points(double from, double speed, int count = 40) {
  Vector points;
  for (int k = 0; k < count; ++k) {
    points.push_back(from + (k - 1) * kKnotSpacing_s * speed);
    points.push_back(0.0);
  }
  return points;
}

TEST_F(Played, APathMayEndAndBeginAtALimit) {
  EXPECT_TRUE(player.check(even_points(-2.0, 1.0), 1.0).accepted())
      << "a control point lies before its begin";
  const double length = 37 * kKnotSpacing_s;
  EXPECT_TRUE(player.check(even_points(1.999999 - length, 1.0), 1.0).accepted());
  EXPECT_EQ(player.check(even_points(2.01 - length, 1.0), 1.0).refusal,
            PlayRefusal::kOutsideLimits);
}

TEST_F(Played, FromHereItBeginsAtOnceAndOnlyAtRestAtTheBegin) {
  const Vector points = even_points(0.5, 0.5);
  const Vector here{0.5, 0.0};
  const auto refusal = [&](const Vector& at, const Vector& velocities = {}) {
    return player.play_from_here({at, velocities}, points, 1.0, nullptr);
  };
  EXPECT_EQ(refusal({0.51, 0.0}).refusal, PlayRefusal::kElsewhere);
  EXPECT_EQ(refusal({0.5, 0.01}).axis, 1u);
  EXPECT_EQ(refusal(here, {0.0, 0.1}).refusal, PlayRefusal::kElsewhere) << "it moves";
  EXPECT_EQ(refusal({std::nan(""), 0.0}).refusal, PlayRefusal::kElsewhere);
  EXPECT_FALSE(player.under_way());
  ASSERT_TRUE(refusal(here).accepted());
  motion = {.axes = 2, .points = points, .largest_deviation = 0.0};
  for (int i = 0; i < 20; ++i) cycle();
  EXPECT_TRUE(player.on_path());
  play_out();
  EXPECT_LT(furthest, 2e-4) << "and the nearest place is looked for in steps";
}

}  // namespace
}  // namespace armature::control
