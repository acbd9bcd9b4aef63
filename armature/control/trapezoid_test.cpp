// SPDX-License-Identifier: Apache-2.0
#include "armature/control/trapezoid.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

void expect_sample(const MotionSample& sample, double position, double velocity,
                   double acceleration) {
  EXPECT_NEAR(sample.position, position, 1e-12);
  EXPECT_NEAR(sample.velocity, velocity, 1e-12);
  EXPECT_NEAR(sample.acceleration, acceleration, 1e-12);
}

TEST(Trapezoid, IsExactInEachOfItsParts) {
  // 4 s, of which 1 s up and 1 s down: 3 s times the velocity are 6.
  const Trapezoid motion = Trapezoid::rest_to_rest(1.0, 7.0, 4.0, 0.25);
  expect_sample(motion.at(0.0), 1.0, 0.0, 2.0);
  expect_sample(motion.at(0.5), 1.25, 1.0, 2.0);
  expect_sample(motion.at(1.0), 2.0, 2.0, 0.0);
  expect_sample(motion.at(2.0), 4.0, 2.0, 0.0);
  expect_sample(motion.at(3.5), 6.75, 1.0, -2.0);
  expect_sample(motion.at(4.0), 7.0, 0.0, 0.0);
}

TEST(Trapezoid, RestsBeforeItsStartAndAfterItsEnd) {
  const Trapezoid motion = Trapezoid::rest_to_rest(0.0, -1.0, 1.0, 0.5);
  EXPECT_EQ(motion.at(-1.0).position, 0.0);
  EXPECT_EQ(motion.at(1.0).position, -1.0);
  EXPECT_EQ(motion.at(1e300).position, -1.0);
  expect_sample(Trapezoid::resting(0.7).at(3.0), 0.7, 0.0, 0.0);
}

TEST(Trapezoid, BrakesEvenlyToRest) {
  const Trapezoid motion = Trapezoid::braking(1.0, -2.0, 4.0);
  expect_sample(motion.at(0.0), 1.0, -2.0, 0.5);
  expect_sample(motion.at(2.0), -2.0, -1.0, 0.5);
  expect_sample(motion.at(4.0), -3.0, 0.0, 0.0);
  expect_sample(Trapezoid::braking(1.0, 0.0, 4.0).at(2.0), 1.0, 0.0, 0.0);
}

TEST(Trapezoid, VelocityIsTheSlopeOfPositionAndAccelerationThatOfVelocity) {
  std::mt19937_64 random(4711);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int round = 0; round < 1000; ++round) {
    const Trapezoid motion = Trapezoid::rest_to_rest(
        share(random), share(random), 1.0 + share(random), 0.1 + 0.4 * share(random));
    const double time = (0.01 + 0.98 * share(random)) * motion.duration_s;
    const double step = 1e-6;
    const auto before = motion.at(time - step);
    const auto now = motion.at(time);
    const auto after = motion.at(time + step);
    if (before.acceleration != after.acceleration) continue;  // a corner between them
    ASSERT_NEAR((after.position - before.position) / (2.0 * step), now.velocity, 1e-8);
    ASSERT_NEAR((after.velocity - before.velocity) / (2.0 * step), now.acceleration, 1e-8);
  }
}

}  // namespace
}  // namespace armature::control
