// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/online_trajectory.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/random_motion.hpp"

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Vector = std::vector<double>;

constexpr OnlineTrajectory::Axis kAxis{1.0, 2.0, 20.0, -0.5, 4.5};

OnlineTrajectory make(std::size_t axes, const OnlineTrajectory::Axis& axis = kAxis) {
  return OnlineTrajectory::make({std::vector(axes, axis)}).value();
}

OnlineTrajectory resting_at(const Vector& positions) {
  OnlineTrajectory trajectory = make(positions.size());
  EXPECT_TRUE(trajectory.hold(positions).accepted());
  return trajectory;
}

/// Steps of 1 ms, at each of which the limits of `kAxis` are looked at.
void run(OnlineTrajectory& trajectory, int steps) {
  for (int i = 0; i < steps; ++i) {
    const Vector before(trajectory.accelerations().begin(), trajectory.accelerations().end());
    trajectory.step(1ms);
    for (std::size_t k = 0; k < trajectory.axes(); ++k) {
      ASSERT_LE(std::abs(trajectory.velocities()[k]), 1.0 + 1e-9);
      ASSERT_LE(std::abs(trajectory.accelerations()[k]), 2.0 + 1e-9);
      ASSERT_LE(std::abs(trajectory.accelerations()[k] - before[k]), 20.0 * 1e-3 + 1e-9);
      ASSERT_GE(trajectory.positions()[k], -0.5 - 1e-9);
      ASSERT_LE(trajectory.positions()[k], 4.5 + 1e-9);
    }
  }
}

TEST(OnlineTrajectory, AllAxesArriveTogether) {
  OnlineTrajectory trajectory = resting_at({0.0, 1.0, 2.0});
  ASSERT_TRUE(trajectory.move_to({Vector{2.0, 1.5, 2.0}}).accepted());
  EXPECT_NEAR(trajectory.duration_s(), 2.0 / 1.0 + 1.0 / 2.0 + 2.0 / 20.0, 1e-9);
  run(trajectory, 2599);
  EXPECT_TRUE(trajectory.under_way());
  EXPECT_LT(trajectory.positions()[0], 2.0);
  EXPECT_LT(trajectory.positions()[1], 1.5);
  EXPECT_EQ(trajectory.positions()[2], 2.0);
  run(trajectory, 2);
  EXPECT_FALSE(trajectory.under_way());
  EXPECT_THAT(trajectory.positions(), ElementsAre(2.0, 1.5, 2.0));
  EXPECT_THAT(trajectory.velocities(), Each(0.0));
}

TEST(OnlineTrajectory, ANewTargetOnTheWayChangesNothingAbruptly) {
  OnlineTrajectory trajectory = resting_at({0.0, 1.0});
  ASSERT_TRUE(trajectory.move_to({Vector{4.0, 0.0}}).accepted());
  run(trajectory, 700);
  ASSERT_TRUE(trajectory.move_to({Vector{-0.4, 4.0}}).accepted());
  run(trajectory, 150);
  ASSERT_TRUE(trajectory.move_to({Vector{1.0, 1.0}}).accepted());
  run(trajectory, 8000);
  EXPECT_THAT(trajectory.positions(), ElementsAre(1.0, 1.0));
}

TEST(OnlineTrajectory, TheTargetThatItGoesToAlreadyChangesNothing) {
  OnlineTrajectory trajectory = resting_at({0.0});
  ASSERT_TRUE(trajectory.move_to({Vector{1.0}}).accepted());
  run(trajectory, 300);
  ASSERT_TRUE(trajectory.move_to({Vector{1.0}}).accepted());
  EXPECT_NEAR(trajectory.elapsed_s(), 0.3, 1e-12);
}

TEST(OnlineTrajectory, AskedForATimeItTakesThat) {
  OnlineTrajectory trajectory = resting_at({0.0});
  const Vector target{2.0};
  const auto answer = trajectory.move_to({target}, 2.5);
  EXPECT_EQ(answer.refusal, TargetRefusal::kTooFast);
  EXPECT_NEAR(answer.shortest_s, 2.6, 1e-9);
  ASSERT_TRUE(trajectory.move_to({target}, 5.0).accepted());
  EXPECT_NEAR(trajectory.duration_s(), 5.0, 1e-9);
  EXPECT_NEAR(trajectory.remaining_s(), 5.0, 1e-9);
}

TEST(OnlineTrajectory, StopsAsFastAsTheLimitsAllow) {
  OnlineTrajectory trajectory = resting_at({0.0, 1.0});
  ASSERT_TRUE(trajectory.move_to({Vector{4.0, 1.2}}).accepted());
  run(trajectory, 1500);
  trajectory.stop();
  EXPECT_NEAR(trajectory.duration_s(), 1.0 / 2.0 + 2.0 / 20.0, 1e-9);
  run(trajectory, 300);
  trajectory.stop();  // which it does already
  EXPECT_NEAR(trajectory.elapsed_s(), 0.3, 1e-12);
  run(trajectory, 301);
  EXPECT_THAT(trajectory.velocities(), Each(0.0));
  EXPECT_FALSE(trajectory.under_way());
}

TEST(OnlineTrajectory, ArrivesInMotionAndBrakesUnlessATargetFollows) {
  OnlineTrajectory trajectory = resting_at({0.0});
  const Vector velocity{0.5};
  ASSERT_TRUE(trajectory.move_to({Vector{1.0}, velocity}).accepted());
  const int steps = static_cast<int>(trajectory.duration_s() * 1e3);
  run(trajectory, steps);
  EXPECT_NEAR(trajectory.positions()[0], 1.0, 0.5e-3);
  EXPECT_NEAR(trajectory.velocities()[0], 0.5, 0.5e-3);
  run(trajectory, 1000);
  EXPECT_FALSE(trajectory.under_way());
  EXPECT_EQ(trajectory.velocities()[0], 0.0);
  EXPECT_GT(trajectory.positions()[0], 1.05);
}

TEST(OnlineTrajectory, ComesCloserAndCloserToATargetThatMovesOn) {
  OnlineTrajectory trajectory = resting_at({0.0});
  const Vector velocity{0.5};
  double lag = 0.0;
  double lag_before = 1.0;
  for (int i = 0; i < 6000; ++i) {
    trajectory.step(1ms);
    const Vector reference{0.2 + 0.5e-3 * i};
    ASSERT_TRUE(trajectory.move_to({reference, velocity}).accepted());
    if (i == 3000) lag_before = reference[0] - trajectory.positions()[0];
    lag = reference[0] - trajectory.positions()[0];
  }
  EXPECT_LT(lag_before, 0.1);
  EXPECT_LT(lag, 0.5 * lag_before);
  EXPECT_GE(lag, -1e-3);
  EXPECT_NEAR(trajectory.velocities()[0], 0.5, 0.01);
}

TEST(OnlineTrajectory, RefusesTargetsThatAreNotAdmissibleAndMovesOn) {
  OnlineTrajectory unknown = make(1);
  EXPECT_EQ(unknown.move_to({Vector{1.0}}).refusal, TargetRefusal::kNoPosition);
  OnlineTrajectory trajectory = resting_at({0.0, 0.0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vector inside{1.0, 1.0};
  const auto refusal = [&](const Vector& p, const Vector& v, const Vector& a, double time_s = 0.0) {
    return trajectory.move_to({p, v, a}, time_s).refusal;
  };
  EXPECT_EQ(refusal({1.0}, {}, {}), TargetRefusal::kWrongNumber);
  EXPECT_EQ(refusal(inside, {0.0}, {}), TargetRefusal::kWrongNumber);
  EXPECT_EQ(refusal({1.0, nan}, {}, {}), TargetRefusal::kNotFinite);
  EXPECT_EQ(refusal(inside, {}, {0.0, nan}), TargetRefusal::kNotFinite);
  EXPECT_EQ(refusal(inside, {}, {}, nan), TargetRefusal::kNotFinite);
  EXPECT_EQ(refusal(inside, {}, {}, -1.0), TargetRefusal::kNegativeTime);
  EXPECT_EQ(refusal({1.0, 4.6}, {}, {}), TargetRefusal::kOutsideLimits);
  EXPECT_EQ(refusal(inside, {1.1, 0.0}, {}), TargetRefusal::kVelocityTooHigh);
  EXPECT_EQ(refusal(inside, {}, {2.1, 0.0}), TargetRefusal::kAccelerationTooHigh);
  EXPECT_EQ(refusal(inside, {0.99, 0.0}, {2.0, 0.0}), TargetRefusal::kAccelerationTooHigh);
  EXPECT_EQ(refusal({4.5, 1.0}, {1.0, 0.0}, {}), TargetRefusal::kLeavesLimits)
      << "it cannot stop before the limit";
  EXPECT_FALSE(trajectory.under_way());
}

TEST(OnlineTrajectory, RefusesLimitsThatAreNotFiniteNumbersAboveZero) {
  const double inf = std::numeric_limits<double>::infinity();
  const auto made = OnlineTrajectory::make({{{1.0, inf, 0.0, 1.0, 0.0}}});
  ASSERT_FALSE(made);
  for (const char* field : {"max_acceleration", "max_jerk", "upper"}) {
    EXPECT_THAT(made.error(), HasSubstr(field));
  }
  EXPECT_THAT(made.error(), ::testing::Not(HasSubstr("max_velocity")));
}

TEST(OnlineTrajectory, BeyondItsLimitsAnAxisIsBroughtBackAsFastAsTheJerkAllows) {
  OnlineTrajectory trajectory = make(1, {1.0, 2.0, 20.0});
  ASSERT_TRUE(trajectory.begin_at({Vector{0.0}, Vector{3.0}, Vector{4.0}}).accepted());
  ASSERT_TRUE(trajectory.move_to({Vector{10.0}}).accepted());
  // From 4 to 2 in 0.1 s, to -2 in 0.2 s, at 3.3 m/s; 2.3 of it are left, 1.15 s.
  trajectory.step(100ms);
  EXPECT_NEAR(trajectory.accelerations()[0], 2.0, 1e-9);
  trajectory.step(200ms);
  EXPECT_NEAR(trajectory.accelerations()[0], -2.0, 1e-9);
  EXPECT_NEAR(trajectory.velocities()[0], 3.3, 1e-9);
  trajectory.step(1150ms);
  EXPECT_NEAR(trajectory.velocities()[0], 1.0, 1e-9);
  trajectory.step(20s);
  EXPECT_EQ(trajectory.positions()[0], 10.0);
}

TEST(OnlineTrajectory, FromAnyStateRandomTargetsAreReachedByAllAxesAtOnce) {
  testing::RandomMotion random(2021);
  for (int round = 0; round < 3000; ++round) {
    const auto axes = static_cast<std::size_t>(1 + random.one_of(14));
    OnlineTrajectory::Config config;
    Vector p, v, a, tp, tv, ta;
    for (std::size_t i = 0; i < axes; ++i) {
      const JerkLimits limits = random.limits();
      config.axes.push_back({limits.velocity, limits.acceleration, limits.jerk});
      const MotionSample target = random.state(limits);
      const MotionSample start =
          random.one_of(8) == 0 ? random.beyond(limits) : random.start(limits, target);
      p.push_back(start.position), v.push_back(start.velocity), a.push_back(start.acceleration);
      tp.push_back(target.position), tv.push_back(target.velocity);
      ta.push_back(target.acceleration);
    }
    OnlineTrajectory trajectory = OnlineTrajectory::make(config).value();
    ASSERT_TRUE(trajectory.begin_at({p, v, a}).accepted());
    ASSERT_TRUE(trajectory.move_to({tp, tv, ta}).accepted()) << round;
    for (std::size_t i = 0; i < axes; ++i) {
      const PhasedMotion& motion = trajectory.motion(i);
      const double duration_s = trajectory.duration_s();
      ASSERT_NEAR(motion.duration_s(), duration_s, 1e-9 * (1.0 + duration_s)) << round;
      const MotionSample last = motion.at(std::nextafter(motion.duration_s(), 0.0));
      const double scale = 1.0 + config.axes[i].max_velocity * duration_s;
      if (duration_s == 0.0) continue;
      ASSERT_NEAR(last.position, tp[i], 1e-9 * scale) << round;
      ASSERT_NEAR(last.velocity, tv[i], 1e-9) << round;
      ASSERT_NEAR(last.acceleration, ta[i], 1e-9) << round;
    }
  }
}

/// The speed of the tip of two links of 0.6 m, of which 0.9 m/s are allowed.
class TipOfTwoLinks final : public MotionLimit {
 public:
  double used(std::span<const double> q, std::span<const double> qd) override {
    const double both = qd[0] + qd[1];
    const double x = -0.6 * std::sin(q[0]) * qd[0] - 0.6 * std::sin(q[0] + q[1]) * both;
    const double y = 0.6 * std::cos(q[0]) * qd[0] + 0.6 * std::cos(q[0] + q[1]) * both;
    return std::hypot(x, y) / 0.9;
  }
};

TEST(OnlineTrajectory, RandomMotionsKeepTheLimitOfTheTip) {
  testing::RandomMotion random(7);
  TipOfTwoLinks tip;
  constexpr OnlineTrajectory::Axis kWide{2.0, 4.0, 40.0, -3.0, 3.0};
  OnlineTrajectory trajectory = make(2, kWide);
  ASSERT_TRUE(trajectory.hold(Vector{0.0, 0.0}).accepted());
  double most = 0.0;
  int taken = 0;
  constexpr int kTargets = 500;
  for (int round = 0; round < kTargets; ++round) {
    const Vector target{random.between(-2.9, 2.9), random.between(-2.9, 2.9)};
    const auto answer = trajectory.move_to({target}, 0.0, &tip);
    ASSERT_TRUE(answer.accepted() || answer.refusal == TargetRefusal::kMotionLimit);
    taken += answer.accepted() ? 1 : 0;
    // Half of them are redirected on the way.
    const double share = round % 2 == 0 ? 1.0 : random.between(0.1, 0.9);
    for (double end_s = share * trajectory.remaining_s(); end_s > 0.0; end_s -= 1e-3) {
      trajectory.step(1ms);
      most = std::max(most, tip.used(trajectory.positions(), trajectory.velocities()));
    }
  }
  EXPECT_LE(most, 1.02) << "between the looks";
  EXPECT_GE(most, 0.95);
  EXPECT_GE(taken, kTargets * 9 / 10);
}

}  // namespace
}  // namespace armature::control
