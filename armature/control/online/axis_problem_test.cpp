// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/axis_problem.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include <gtest/gtest.h>

#include "armature/control/internal/switching_search.hpp"
#include "armature/testing/random_motion.hpp"

namespace armature::control {
namespace {

constexpr JerkLimits kUnit{1.0, 1.0, 1.0};

PhasedMotion motion_of(const JerkLimits& limits, const MotionSample& start,
                       const MotionSample& target, double at_least_s = 0.0) {
  const AxisProblem problem(limits, start, target);
  PhasedMotion motion;
  motion.begin(start);
  problem.append_to(motion, problem.first_duration(at_least_s));
  return motion;
}

void expect_at(const MotionSample& found, const MotionSample& wanted, double tolerance) {
  EXPECT_NEAR(found.position, wanted.position, tolerance);
  EXPECT_NEAR(found.velocity, wanted.velocity, tolerance);
  EXPECT_NEAR(found.acceleration, wanted.acceleration, tolerance);
}

/// By which the samples of a motion exceed the limits at most.
double excess(const JerkLimits& limits, const PhasedMotion& motion) {
  double most = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const MotionSample sample = motion.at(motion.duration_s() * i / 100.0);
    most = std::max({most, std::abs(sample.velocity) - limits.velocity,
                     std::abs(sample.acceleration) - limits.acceleration});
  }
  for (std::size_t i = 0; i < motion.phases(); ++i) {
    most = std::max(most, std::abs(motion.jerk_of(i)) - limits.jerk);
  }
  return most;
}

TEST(AxisProblem, ShortMotionsFromRestHaveFourEqualPhases) {
  // 2 J t^3 with t = 0.5 s: no limit but the jerk's is reached.
  const PhasedMotion motion = motion_of(kUnit, {}, {0.25});
  EXPECT_NEAR(motion.duration_s(), 2.0, 1e-12);
  EXPECT_NEAR(motion.at(1.0).velocity, 0.25, 1e-12);
  EXPECT_NEAR(motion.at(0.5).acceleration, 0.5, 1e-12);
  expect_at(motion.end(), {0.25}, 1e-12);
}

TEST(AxisProblem, LongMotionsFromRestCruise) {
  // X / V + V / A + A / J.
  const JerkLimits limits{2.0, 4.0, 40.0};
  const PhasedMotion motion = motion_of(limits, {1.0}, {9.0});
  EXPECT_EQ(motion.phases(), 7u);
  EXPECT_NEAR(motion.duration_s(), 8.0 / 2.0 + 2.0 / 4.0 + 4.0 / 40.0, 1e-12);
  EXPECT_NEAR(motion.at(2.0).velocity, 2.0, 1e-12);
}

TEST(AxisProblem, WhereNothingIsLeftToDoTheDurationIsZero) {
  for (const MotionSample& state :
       {MotionSample{}, MotionSample{2.0, 0.5, 0.5}, MotionSample{-1.0, -0.5, 0.3}}) {
    EXPECT_EQ(AxisProblem(kUnit, state, state).first_duration(0.0), 0.0);
  }
}

TEST(AxisProblem, WhatIsPassedTooFastIsComeBackTo) {
  const PhasedMotion motion = motion_of(kUnit, {0.0, 1.0, 0.0}, {0.0});
  const auto [lowest, highest] = motion.extent();
  EXPECT_NEAR(lowest, 0.0, 1e-9);
  EXPECT_GT(highest, 0.5);
  expect_at(motion.end(), {}, 1e-12);
}

TEST(AxisProblem, DurationsBetweenPossibleOnesMayBeBlocked) {
  // In motion 1 s before a target in motion, it is there in time or has to come back.
  const AxisProblem problem(kUnit, {0.0, 1.0, 0.0}, {1.0, 1.0, 0.0});
  EXPECT_NEAR(problem.first_duration(0.0), 1.0, 1e-9);
  const double next_s = problem.first_duration(4.0);
  EXPECT_NEAR(next_s, problem.first_duration(next_s), 1e-9);
}

TEST(AxisProblem, LongerMotionsFromRestDoNotPassTheirTarget) {
  const PhasedMotion motion = motion_of(kUnit, {0.0, 0.8, 0.1}, {3.0}, 20.0);
  EXPECT_NEAR(motion.duration_s(), 20.0, 1e-9);
  EXPECT_LE(motion.extent().highest, 3.0 + 1e-9);
  EXPECT_GE(motion.extent().lowest, 0.0);
}

TEST(AxisProblem, RandomMotionsArriveWithinTheirLimitsInAnyPossibleDuration) {
  testing::RandomMotion random(4711);
  for (int round = 0; round < 20000; ++round) {
    const JerkLimits limits = random.limits();
    const MotionSample target = random.state(limits);
    const MotionSample start = random.start(limits, target);
    const AxisProblem problem(limits, start, target);
    const double shortest_s = problem.first_duration(0.0);
    for (const double share : {1.0, random.between(1.0, 1.2), random.between(1.0, 8.0)}) {
      const double duration_s = problem.first_duration(share * shortest_s);
      ASSERT_TRUE(std::isfinite(duration_s)) << round;
      ASSERT_GE(duration_s, share * shortest_s * (1.0 - 1e-12)) << round;
      PhasedMotion motion;
      motion.begin(start);
      problem.append_to(motion, duration_s);
      const double scale = 1.0 + limits.velocity * duration_s;
      ASSERT_NEAR(motion.duration_s(), duration_s, 1e-9 * (1.0 + duration_s)) << round;
      ASSERT_NEAR(motion.end().position, target.position, 1e-10 * scale) << round;
      ASSERT_NEAR(motion.end().velocity, target.velocity, 1e-10) << round;
      ASSERT_NEAR(motion.end().acceleration, target.acceleration, 1e-10) << round;
      ASSERT_LE(excess(limits, motion), 1e-9) << round;
    }
  }
}

TEST(AxisProblem, NoSearchOfSwitchingTimesFindsAFasterMotion) {
  testing::RandomMotion random(17);
  int as_fast = 0;
  constexpr int kRounds = 2000;
  for (int round = 0; round < kRounds; ++round) {
    const JerkLimits limits = random.limits();
    const MotionSample target = random.state(limits);
    const MotionSample start = random.start(limits, target);
    const double found_s = AxisProblem(limits, start, target).first_duration(0.0);
    const double searched_s = SwitchingSearch(limits, start, target).duration_s(150);
    ASSERT_LE(found_s, 1.001 * searched_s + 1e-6) << round;
    if (searched_s <= 1.001 * found_s) ++as_fast;
  }
  EXPECT_GT(as_fast, kRounds * 8 / 10) << "the search finds most of them, so it is a test";
}

}  // namespace
}  // namespace armature::control
