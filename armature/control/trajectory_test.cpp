// SPDX-License-Identifier: Apache-2.0
#include "armature/control/trajectory.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Two axes at (0, 0), the second one half as fast as the first.
Trajectory make_two() {
  const Trajectory::Axis fast{
      .max_velocity = 1.0, .max_acceleration = 2.0, .lower = -0.5, .upper = 4.5};
  const Trajectory::Axis slow{
      .max_velocity = 0.5, .max_acceleration = 1.0, .lower = -0.5, .upper = 4.5};
  auto trajectory = Trajectory::make({{fast, slow}}).value();
  EXPECT_TRUE(trajectory.hold(std::array{0.0, 0.0}).accepted());
  return trajectory;
}

void finish(Trajectory& trajectory) {
  while (trajectory.under_way()) trajectory.step(1ms);
}

TEST(Trajectory, TakesTheShortestTimeOfItsSlowestAxis) {
  Trajectory trajectory = make_two();
  ASSERT_TRUE(trajectory.move_to(std::array{1.0, 1.0}, 0.0).accepted());
  EXPECT_DOUBLE_EQ(trajectory.duration_s(), 2.5) << "1 rad at 0.5 rad/s and 0.5 s of ramp";
  trajectory.step(1250ms);
  EXPECT_THAT(trajectory.positions(), ElementsAre(0.5, 0.5)) << "half of the time, half of the way";
  EXPECT_DOUBLE_EQ(trajectory.velocities()[1], 0.5);
  EXPECT_DOUBLE_EQ(trajectory.sample(1, 0.25).acceleration, 1.0);
  EXPECT_LT(trajectory.sample(0, 0.25).acceleration, 2.0) << "the fast axis has time";
  trajectory.step(1249ms);
  EXPECT_TRUE(trajectory.under_way());
  trajectory.step(1ms);
  EXPECT_FALSE(trajectory.under_way());
  EXPECT_THAT(trajectory.positions(), ElementsAre(1.0, 1.0));
  EXPECT_THAT(trajectory.velocities(), ElementsAre(0.0, 0.0));
  EXPECT_THAT(trajectory.accelerations(), ElementsAre(0.0, 0.0));
}

TEST(Trajectory, RefusesALessTimeThanTheLimitsAllowAndSaysWhichTheyDo) {
  Trajectory trajectory = make_two();
  const auto answer = trajectory.move_to(std::array{1.0, 1.0}, 2.4);
  EXPECT_EQ(answer.refusal, Refusal::kTooFast);
  EXPECT_DOUBLE_EQ(answer.shortest_s, 2.5);
  EXPECT_FALSE(trajectory.under_way());
  EXPECT_THAT(trajectory.positions(), ElementsAre(0.0, 0.0));
  EXPECT_TRUE(trajectory.move_to(std::array{1.0, 1.0}, answer.shortest_s).accepted());
}

/// Allows 0.25 of the faster velocity.
class Slow final : public MotionLimit {
 public:
  double used(std::span<const double> positions, std::span<const double> velocities) override {
    looks += positions.size() == velocities.size() ? 1 : 0;
    return std::max(std::abs(velocities[0]), std::abs(velocities[1])) / 0.25;
  }
  int looks = 0;
};

TEST(Trajectory, AnotherLimitCountsAlongTheWholeMotion) {
  Trajectory trajectory = make_two();
  Slow slow;
  const auto answer = trajectory.move_to(std::array{1.0, 1.0}, 3.0, &slow);
  EXPECT_EQ(answer.refusal, Refusal::kTooFast);
  EXPECT_NEAR(answer.shortest_s, 6.0, 1e-9) << "0.6 rad/s of the fast one in 2.5 s";
  EXPECT_GT(slow.looks, 10);
  EXPECT_TRUE(trajectory.move_to(std::array{1.0, 1.0}, 0.0, &slow).accepted());
  EXPECT_NEAR(trajectory.duration_s(), 6.0, 1e-9);
}

TEST(Trajectory, ALimitThatAllowsMoreChangesNothing) {
  Trajectory trajectory = make_two();
  Slow slow;
  EXPECT_TRUE(trajectory.move_to(std::array{0.1, 0.1}, 10.0, &slow).accepted());
  EXPECT_DOUBLE_EQ(trajectory.duration_s(), 10.0);
}

TEST(Trajectory, TakesTheTimeThatWasAskedForIfThatIsLonger) {
  Trajectory trajectory = make_two();
  ASSERT_TRUE(trajectory.move_to(std::array{1.0, 1.0}, 10.0).accepted());
  EXPECT_EQ(trajectory.duration_s(), 10.0);
  finish(trajectory);
  ASSERT_TRUE(trajectory.move_to(std::array{0.0, 0.0}, 0.0).accepted());
  EXPECT_DOUBLE_EQ(trajectory.duration_s(), 2.5);
}

TEST(Trajectory, AShortMoveNeverReachesItsVelocity) {
  Trajectory trajectory = make_two();
  ASSERT_TRUE(trajectory.move_to(std::array{0.0, 0.01}, 0.0).accepted());
  EXPECT_DOUBLE_EQ(trajectory.duration_s(), 0.2) << "2 sqrt(0.01 / 1)";
  EXPECT_DOUBLE_EQ(trajectory.sample(1, 0.1).velocity, 0.1);
}

TEST(Trajectory, AMoveOfNoLengthIsOverAtOnceOrAfterItsTime) {
  Trajectory trajectory = make_two();
  ASSERT_TRUE(trajectory.move_to(std::array{0.0, 0.0}, 0.0).accepted());
  EXPECT_FALSE(trajectory.under_way());
  ASSERT_TRUE(trajectory.move_to(std::array{0.0, 0.0}, 0.5).accepted());
  EXPECT_TRUE(trajectory.under_way());
  trajectory.step(250ms);
  EXPECT_THAT(trajectory.positions(), ElementsAre(0.0, 0.0));
  EXPECT_THAT(trajectory.accelerations(), ElementsAre(0.0, 0.0));
  trajectory.step(250ms);
  EXPECT_FALSE(trajectory.under_way());
}

struct Refused {
  std::vector<double> positions;
  double time_s;
  Refusal refusal;
  std::size_t axis;
};

TEST(Trajectory, WhatCannotBeDoneIsRefusedWithItsReasonAndNothingMoves) {
  const auto none = Trajectory::kNoAxis;
  const std::vector<Refused> all{
      {{1.0}, 1.0, Refusal::kWrongNumber, none},
      {{1.0, 1.0, 1.0}, 1.0, Refusal::kWrongNumber, none},
      {{1.0, kNan}, 1.0, Refusal::kNotFinite, 1},
      {{-kInfinity, 1.0}, 1.0, Refusal::kNotFinite, 0},
      {{1.0, 1.0}, kNan, Refusal::kNotFinite, none},
      {{1.0, 1.0}, kInfinity, Refusal::kNotFinite, none},
      {{1.0, 4.51}, 1.0, Refusal::kOutsideLimits, 1},
      {{-0.51, 1.0}, 1.0, Refusal::kOutsideLimits, 0},
      {{1.0, 1.0}, -0.1, Refusal::kNegativeTime, none},
      {{1.0, 1.0}, 1e10, Refusal::kTooLong, none},
  };
  Trajectory trajectory = make_two();
  for (const auto& [positions, time_s, refusal, axis] : all) {
    const auto answer = trajectory.move_to(positions, time_s);
    EXPECT_EQ(answer.refusal, refusal) << to_text(answer.refusal);
    EXPECT_EQ(answer.axis, axis) << to_text(refusal);
    EXPECT_FALSE(trajectory.under_way());
    trajectory.step(10ms);
    EXPECT_THAT(trajectory.positions(), ElementsAre(0.0, 0.0));
  }
}

TEST(Trajectory, ASecondMotionIsRefusedAndTheFirstGoesOn) {
  Trajectory trajectory = make_two();
  Trajectory twin = make_two();
  ASSERT_TRUE(trajectory.move_to(std::array{1.0, 1.0}, 0.0).accepted());
  ASSERT_TRUE(twin.move_to(std::array{1.0, 1.0}, 0.0).accepted());
  while (twin.under_way()) {
    EXPECT_EQ(trajectory.move_to(std::array{2.0, 2.0}, 0.0).refusal, Refusal::kUnderWay);
    trajectory.step(10ms);
    twin.step(10ms);
    ASSERT_EQ(trajectory.positions()[0], twin.positions()[0]);
  }
  EXPECT_TRUE(trajectory.move_to(std::array{2.0, 2.0}, 0.0).accepted());
}

TEST(Trajectory, NothingMovesBeforeItIsSaidWhereTheAxesAre) {
  auto trajectory = Trajectory::make({{{.max_velocity = 1.0, .max_acceleration = 1.0}}}).value();
  EXPECT_EQ(trajectory.move_to(std::array{1.0}, 0.0).refusal, Refusal::kNoPosition);
  EXPECT_EQ(trajectory.hold(std::array{kNan}).refusal, Refusal::kNotFinite);
  EXPECT_EQ(trajectory.move_to(std::array{1.0}, 0.0).refusal, Refusal::kNoPosition);
  EXPECT_TRUE(trajectory.hold(std::array{0.3}).accepted());
  EXPECT_EQ(trajectory.positions()[0], 0.3);
  EXPECT_TRUE(trajectory.move_to(std::array{1.0}, 0.0).accepted());
}

TEST(Trajectory, HoldingEndsAMotion) {
  Trajectory trajectory = make_two();
  ASSERT_TRUE(trajectory.move_to(std::array{1.0, 1.0}, 0.0).accepted());
  trajectory.step(500ms);
  EXPECT_EQ(trajectory.hold(std::array{0.1}).refusal, Refusal::kWrongNumber);
  EXPECT_TRUE(trajectory.under_way());
  ASSERT_TRUE(trajectory.hold(std::array{5.0, 0.2}).accepted()) << "outside the limits is a fact";
  EXPECT_FALSE(trajectory.under_way());
  trajectory.step(500ms);
  EXPECT_THAT(trajectory.positions(), ElementsAre(5.0, 0.2));
  EXPECT_THAT(trajectory.velocities(), ElementsAre(0.0, 0.0));
}

TEST(Trajectory, AStopEndsAllAxesTogetherAndHoldsThere) {
  Trajectory trajectory = make_two();
  ASSERT_TRUE(trajectory.move_to(std::array{1.0, 4.0}, 0.0).accepted());
  trajectory.step(2s);
  const double slow_velocity = trajectory.velocities()[1];
  const double slow_position = trajectory.positions()[1];
  ASSERT_EQ(slow_velocity, 0.5);
  trajectory.stop();
  EXPECT_DOUBLE_EQ(trajectory.duration_s(), 0.5) << "0.5 rad/s at 1 rad/s^2";
  EXPECT_EQ(trajectory.velocities()[1], slow_velocity) << "a stop does not jump";
  EXPECT_EQ(trajectory.positions()[1], slow_position);
  EXPECT_LT(trajectory.accelerations()[0], 0.0);
  trajectory.step(499ms);
  EXPECT_GT(trajectory.velocities()[0], 0.0) << "the fast axis has time";
  EXPECT_GT(trajectory.velocities()[1], 0.0);
  trajectory.step(1ms);
  EXPECT_FALSE(trajectory.under_way());
  EXPECT_DOUBLE_EQ(trajectory.positions()[1], slow_position + 0.125);
  trajectory.step(10s);
  EXPECT_DOUBLE_EQ(trajectory.positions()[1], slow_position + 0.125);
  EXPECT_TRUE(trajectory.move_to(std::array{1.0, 1.0}, 0.0).accepted());
}

TEST(Trajectory, ASecondStopAndAStopAtRestChangeNothing) {
  Trajectory trajectory = make_two();
  trajectory.stop();
  EXPECT_FALSE(trajectory.under_way());
  ASSERT_TRUE(trajectory.move_to(std::array{1.0, 1.0}, 0.0).accepted());
  trajectory.step(1s);
  trajectory.stop();
  const double duration_s = trajectory.duration_s();
  trajectory.step(100ms);
  trajectory.stop();
  EXPECT_EQ(trajectory.duration_s(), duration_s);
  EXPECT_EQ(trajectory.elapsed_s(), 0.1);
  EXPECT_EQ(trajectory.move_to(std::array{0.0, 0.0}, 0.0).refusal, Refusal::kUnderWay);
}

TEST(Trajectory, AStopFromAMeasuredStateKeepsToTheLimitsWhereItCan) {
  Trajectory trajectory = make_two();
  // Together would be 0.5 s and 0.2 rad for the fast axis, which has 0.18 rad left; it needs 0.16.
  ASSERT_TRUE(trajectory.stop_from(std::array{4.32, 1.0}, std::array{0.8, 0.5}).accepted());
  EXPECT_DOUBLE_EQ(trajectory.sample(0, 0.0).velocity, 0.8);
  finish(trajectory);
  EXPECT_NEAR(trajectory.positions()[0], 4.5, 1e-12);
  EXPECT_NEAR(trajectory.positions()[1], 1.125, 1e-12);
  // No room at all: as hard as is allowed.
  ASSERT_TRUE(trajectory.stop_from(std::array{-0.5, 1.0}, std::array{-0.8, 0.5}).accepted());
  EXPECT_DOUBLE_EQ(trajectory.accelerations()[0], 2.0);
  EXPECT_EQ(trajectory.stop_from(std::array{0.0, 0.0}, std::array{kNan, 0.0}).refusal,
            Refusal::kNotFinite);
  EXPECT_EQ(trajectory.stop_from(std::array{0.0, 0.0}, std::array{1e300, 0.0}).refusal,
            Refusal::kTooLong);
  EXPECT_DOUBLE_EQ(trajectory.accelerations()[0], 2.0) << "what is refused changes nothing";
}

TEST(Trajectory, ARefusedConfigurationNamesEveryFieldThatIsWrong) {
  EXPECT_EQ(Trajectory::make({}).error(),
            "Trajectory: the number of axes is 0, expected at least 1");
  const auto text =
      Trajectory::make(
          {{{.max_velocity = 1.0, .max_acceleration = 1.0},
            {.max_velocity = 0.0, .max_acceleration = kInfinity, .lower = 1.0, .upper = -1.0}}})
          .error();
  EXPECT_THAT(text, HasSubstr("axes[1].max_velocity is 0, expected a finite number above 0"));
  EXPECT_THAT(text, HasSubstr("axes[1].max_acceleration is inf"));
  EXPECT_THAT(text, HasSubstr("axes[1].upper is -1, expected a number above lower"));
}

/// Robots with one to seven axes of random limits, moved to random targets.
class RandomMotions {
 public:
  explicit RandomMotions(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::vector<Trajectory::Axis> axes() {
    std::vector<Trajectory::Axis> axes(1 + random_() % 7);
    for (auto& axis : axes) {
      axis = {std::pow(10.0, between(-2.0, 1.0)), std::pow(10.0, between(-2.0, 1.0)),
              between(-3.0, -1.0), between(1.0, 3.0)};
    }
    return axes;
  }
  std::vector<double> target(const std::vector<Trajectory::Axis>& axes) {
    std::vector<double> target;
    for (const auto& axis : axes) {
      target.push_back(random_() % 4 == 0 ? (random_() % 2 == 0 ? axis.lower : axis.upper)
                                          : between(axis.lower, axis.upper));
    }
    return target;
  }

 private:
  std::mt19937_64 random_;
};

constexpr double kTolerance = 1e-9;

void expect_within_limits(const Trajectory& trajectory, const std::vector<Trajectory::Axis>& axes) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    ASSERT_GE(trajectory.positions()[i], axes[i].lower - kTolerance);
    ASSERT_LE(trajectory.positions()[i], axes[i].upper + kTolerance);
    ASSERT_LE(std::abs(trajectory.velocities()[i]), axes[i].max_velocity * (1.0 + kTolerance));
    ASSERT_LE(std::abs(trajectory.accelerations()[i]),
              axes[i].max_acceleration * (1.0 + kTolerance));
  }
}

/// Some axis uses all it has: a shorter motion would not be allowed.
bool uses_all_it_has(const Trajectory& trajectory, const std::vector<Trajectory::Axis>& axes) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double acceleration = std::abs(trajectory.sample(i, 0.0).acceleration);
    if (acceleration > axes[i].max_acceleration * (1.0 - kTolerance)) return true;
  }
  return false;
}

TEST(Trajectory, AJogGoesToTheLimitOfItsAxisAtItsVelocityAndRefusesTheRest) {
  Trajectory trajectory = make_two();
  EXPECT_EQ(trajectory.jog(0, kNan).refusal, Refusal::kNotFinite);
  EXPECT_EQ(trajectory.jog(0, 0.0).refusal, Refusal::kZeroVelocity);
  const auto too_fast = trajectory.jog(1, -0.6);
  EXPECT_EQ(too_fast.refusal, Refusal::kTooFast);
  EXPECT_DOUBLE_EQ(too_fast.fastest, 0.5);
  ASSERT_TRUE(trajectory.jog(0, 0.5).accepted());
  EXPECT_EQ(trajectory.jog(1, 0.1).refusal, Refusal::kUnderWay);
  EXPECT_DOUBLE_EQ(trajectory.sample(0, 0.25).velocity, 0.5) << "0.25 s of ramp";
  EXPECT_DOUBLE_EQ(trajectory.duration_s(), 4.5 / 0.5 + 0.25);
  finish(trajectory);
  EXPECT_THAT(trajectory.positions(), ElementsAre(4.5, 0.0));
  EXPECT_EQ(trajectory.jog(0, 0.5).refusal, Refusal::kAtLimit);
  const Trajectory::Axis endless{.max_velocity = 1.0, .max_acceleration = 2.0};
  auto without_limits = Trajectory::make({{endless}}).value();
  EXPECT_EQ(without_limits.jog(0, 1.0).refusal, Refusal::kNoPosition);
  ASSERT_TRUE(without_limits.hold(std::array{0.0}).accepted());
  EXPECT_EQ(without_limits.jog(0, 1.0).refusal, Refusal::kTooLong);
}

TEST(Trajectory, NoMotionLeavesALimitOrJumpsOrTakesLongerThanItMust) {
  RandomMotions random(4711);
  for (int round = 0; round < 300; ++round) {
    const auto axes = random.axes();
    auto trajectory = Trajectory::make({axes}).value();
    ASSERT_TRUE(trajectory.hold(std::vector<double>(axes.size(), 0.0)).accepted());
    const auto target = random.target(axes);
    ASSERT_TRUE(trajectory.move_to(target, 0.0).accepted());
    ASSERT_TRUE(uses_all_it_has(trajectory, axes));
    const base::Duration period(1 + static_cast<std::int64_t>(trajectory.duration_s() * 1e9) / 200);
    std::vector<double> velocities(axes.size(), 0.0);
    while (trajectory.under_way()) {
      trajectory.step(period);
      expect_within_limits(trajectory, axes);
      for (std::size_t i = 0; i < axes.size(); ++i) {
        const double most =
            axes[i].max_acceleration * std::chrono::duration<double>(period).count();
        ASSERT_LE(std::abs(trajectory.velocities()[i] - velocities[i]), most * (1.0 + 1e-6));
        velocities[i] = trajectory.velocities()[i];
      }
    }
    ASSERT_THAT(trajectory.positions(), ::testing::ElementsAreArray(target));
  }
}

TEST(Trajectory, AStopPassesNoLimitAndNoTargetWheneverItComesAndEndsTogether) {
  RandomMotions random(815);
  for (int round = 0; round < 1000; ++round) {
    const auto axes = random.axes();
    auto trajectory = Trajectory::make({axes}).value();
    ASSERT_TRUE(trajectory.hold(random.target(axes)).accepted());
    const std::vector<double> start(trajectory.positions().begin(), trajectory.positions().end());
    const auto target = random.target(axes);
    ASSERT_TRUE(trajectory.move_to(target, 0.0).accepted());
    const double moment_s = random.between(0.0, 1.0) * trajectory.duration_s();
    trajectory.step(base::Duration(static_cast<std::int64_t>(moment_s * 1e9)));
    const std::vector<double> velocities(trajectory.velocities().begin(),
                                         trajectory.velocities().end());
    trajectory.stop();
    for (std::size_t i = 0; i < axes.size(); ++i) {
      ASSERT_NEAR(trajectory.velocities()[i], velocities[i], kTolerance);
      if (velocities[i] == 0.0) continue;
      const double near_end_s = trajectory.duration_s() * (1.0 - 1e-6);
      ASSERT_NE(trajectory.sample(i, near_end_s).velocity, 0.0) << "all end together";
    }
    const base::Duration period(1 + static_cast<std::int64_t>(trajectory.duration_s() * 1e9) / 50);
    while (trajectory.under_way()) {
      expect_within_limits(trajectory, axes);
      trajectory.step(period);
    }
    for (std::size_t i = 0; i < axes.size(); ++i) {
      ASSERT_EQ(trajectory.velocities()[i], 0.0);
      ASSERT_GE(trajectory.positions()[i], std::min(start[i], target[i]) - kTolerance);
      ASSERT_LE(trajectory.positions()[i], std::max(start[i], target[i]) + kTolerance);
    }
  }
}

}  // namespace
}  // namespace armature::control
