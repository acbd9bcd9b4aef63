// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/stops.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "armature/control/online/axis_problem.hpp"
#include "armature/control/online/online_trajectory.hpp"
#include "armature/testing/random_motion.hpp"

namespace armature::control {
namespace {

using Vector = std::vector<double>;

TEST(Stops, OfAMotionAtItsLimitTakeTheRampAndTheRise) {
  // V^2 / 2A + V A / 2J with V 1, A 2, J 20.
  const PhasedMotion stop = stop_from({1.0, 2.0, 20.0}, {0.0, 1.0, 0.0});
  EXPECT_NEAR(stop.end().position, 0.25 + 0.05, 1e-12);
  EXPECT_EQ(stop.end().velocity, 0.0);
}

/// The extent is that of many stops, neither less nor much more.
TEST(Stops, OfRandomMotionsComeAsFarAsTheirExtentSays) {
  testing::RandomMotion random(3);
  constexpr int kMoments = 400;
  int by_a_stop = 0;
  for (int round = 0; round < 2000; ++round) {
    const JerkLimits limits = random.limits();
    const MotionSample target = random.state(limits);
    const MotionSample start = random.state(limits);
    const AxisProblem problem(limits, start, target);
    const double share = random.one_of(2) == 0 ? 1.0 : random.between(1.0, 3.0);
    PhasedMotion motion;
    motion.begin(start);
    problem.append_to(motion, problem.first_duration(share * problem.first_duration(0.0)));
    const auto [lowest, highest] = extent_of_stops(limits, motion);
    auto [low, high] = motion.extent();
    const double own_high = high;
    for (int k = 0; k <= kMoments; ++k) {
      const MotionSample there = motion.at(motion.duration_s() * k / kMoments);
      const auto extent = stop_from(limits, there).extent();
      low = std::min(low, extent.lowest);
      high = std::max(high, extent.highest);
    }
    const double scale = 1.0 + limits.velocity * motion.duration_s();
    ASSERT_GE(low, lowest - 1e-10 * scale) << round;
    ASSERT_LE(high, highest + 1e-10 * scale) << round;
    ASSERT_NEAR(low, lowest, 1e-2 * scale) << round;
    ASSERT_NEAR(high, highest, 1e-2 * scale) << round;
    if (high > own_high + 1e-3) ++by_a_stop;
  }
  EXPECT_GT(by_a_stop, 200) << "or the motion's own extent would do";
}

Vector column(const std::vector<MotionSample>& states, double MotionSample::*number) {
  return {states[0].*number, states[1].*number};
}

/// Two axes with limits of their positions near to where they move.
struct Narrow {
  OnlineTrajectory::Config config;
  std::vector<MotionSample> starts;
  std::vector<MotionSample> targets;

  explicit Narrow(testing::RandomMotion& random) {
    for (int i = 0; i < 2; ++i) {
      const JerkLimits limits = random.limits();
      starts.push_back(random.state(limits));
      MotionSample target = random.state(limits);
      if (random.one_of(2) == 0) target.velocity = target.acceleration = 0.0;
      targets.push_back(target);
      const auto [low, high] = stop_from(limits, starts.back()).extent();
      const auto [target_low, target_high] = stop_from(limits, target).extent();
      const double room = random.one_of(2) == 0 ? 1e-6 : random.between(0.0, 1.0);
      config.axes.push_back({limits.velocity, limits.acceleration, limits.jerk,
                             std::min(low, target_low) - room, std::max(high, target_high) + room});
    }
  }
};

TEST(Stops, AtAnyMomentOfATakenMotionStayWithinThePositionLimits) {
  testing::RandomMotion random(5);
  int taken = 0;
  int refused = 0;
  for (int round = 0; round < 3000; ++round) {
    const Narrow narrow(random);
    OnlineTrajectory trajectory = OnlineTrajectory::make(narrow.config).value();
    const auto begin_p = column(narrow.starts, &MotionSample::position);
    const auto begin_v = column(narrow.starts, &MotionSample::velocity);
    const auto begin_a = column(narrow.starts, &MotionSample::acceleration);
    const auto p = column(narrow.targets, &MotionSample::position);
    const auto v = column(narrow.targets, &MotionSample::velocity);
    const auto a = column(narrow.targets, &MotionSample::acceleration);
    ASSERT_TRUE(trajectory.begin_at({begin_p, begin_v, begin_a}).accepted());
    const auto answer = trajectory.move_to({p, v, a});
    ++(answer.accepted() ? taken : refused);
    if (!answer.accepted()) {
      ASSERT_EQ(answer.refusal, TargetRefusal::kLeavesLimits) << round;
      continue;
    }
    for (int k = 0; k < 100; ++k) {
      OnlineTrajectory stopped = trajectory;
      const double there_s = trajectory.duration_s() * k / 100.0;
      stopped.step(base::Duration(static_cast<base::Duration::rep>(there_s * 1e9)));
      stopped.stop();
      for (std::size_t i = 0; i < 2; ++i) {
        const auto& axis = narrow.config.axes[i];
        const auto [low, high] = stopped.motion(i).extent();
        const double rounding = 2e-9 + 1e-12 * axis.max_velocity * trajectory.duration_s();
        ASSERT_GE(low, axis.lower - rounding) << round << " " << k;
        ASSERT_LE(high, axis.upper + rounding) << round << " " << k;
      }
    }
  }
  EXPECT_GT(taken, 1000);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace armature::control
