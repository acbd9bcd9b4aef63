// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/joint_velocities.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"

namespace armature::wam {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;
using Vector = std::vector<double>;

TEST(JointVelocities, AreDifferencesBehindTheLowPassOfTheFacts) {
  JointVelocities estimate(2);
  Vector velocities(2, 7.0);
  estimate.step(Vector{0.5, -0.3}, 0.002, velocities);
  EXPECT_THAT(velocities, ElementsAre(0.0, 0.0));
  const double response[] = {0.264706, 0.459343, 0.602458};  // of 1 rad/s
  for (int k = 0; k < 3; ++k) {
    estimate.step(Vector{0.5 + 0.002 * (k + 1), -0.3}, 0.002, velocities);
    EXPECT_THAT(velocities, Pointwise(DoubleNear(5e-7), {response[k], 0.0}));
  }
}

TEST(JointVelocities, TakeTheTimeThatPassed) {
  JointVelocities estimate(1);
  Vector velocities(1);
  estimate.step(Vector{0.0}, 0.002, velocities);
  estimate.step(Vector{0.004}, 0.004, velocities);
  EXPECT_NEAR(velocities[0], 0.264706, 5e-7);
}

TEST(JointVelocities, AJumpIsNoMotion) {
  JointVelocities estimate(1);
  Vector velocities(1);
  estimate.step(Vector{0.0}, 0.002, velocities);
  estimate.step(Vector{0.002}, 0.002, velocities);
  const double before = velocities[0];
  estimate.jump();
  estimate.step(Vector{-2.0}, 0.002, velocities);
  EXPECT_EQ(velocities[0], before);
  estimate.step(Vector{-2.0}, 0.002, velocities);
  EXPECT_LT(velocities[0], before);
  EXPECT_GT(velocities[0], 0.0);
}

TEST(JointVelocities, AllocateNothing) {
  JointVelocities estimate(7);
  const Vector positions(7, 0.1);
  Vector velocities(7);
  testing::RealtimeGuard guard;
  const auto violations = guard.watch([&] {
    estimate.step(positions, 0.002, velocities);
    estimate.jump();
  });
  EXPECT_EQ(violations, 0u) << guard.report();
}

}  // namespace
}  // namespace armature::wam
