// SPDX-License-Identifier: Apache-2.0
#include "armature/control/taught/taught_motion.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

double wave(double time_s, double phase) { return 0.8 * std::sin(1.5 * time_s + phase); }

TaughtSamples samples_of(double duration_s, double period_s, double noise = 0.0) {
  TaughtSamples samples{2, {}, {}};
  std::mt19937 random(1);
  std::normal_distribution<double> error(0.0, noise > 0.0 ? noise : 1.0);
  for (double t = 0.0; t < duration_s; t += period_s) {
    samples.times_s.push_back(5.0 + t);
    for (const double phase : {0.0, 1.0}) {
      samples.positions.push_back(wave(t, phase) + (noise > 0.0 ? error(random) : 0.0));
    }
  }
  return samples;
}

double largest_error(const TaughtMotion& motion, double until_s) {
  double largest = 0.0;
  for (double t = 0.0; t < until_s; t += 0.003) {
    const auto there = motion.positions_at(t);
    largest =
        std::max({largest, std::abs(there[0] - wave(t, 0.0)), std::abs(there[1] - wave(t, 1.0))});
  }
  return largest;
}

TEST(TaughtMotion, GoesThroughWhatWasTaughtToATenthOfAMilliradian) {
  const auto motion = fit_taught_motion(samples_of(4.0, 0.01));
  ASSERT_TRUE(motion) << motion.error();
  EXPECT_LT(largest_error(motion.value(), 3.9), 1e-4);
  EXPECT_LT(motion.value().largest_deviation, 1e-4);
  EXPECT_NEAR(motion.value().duration_s(), 4.0, 0.05);
}

TEST(TaughtMotion, BridgesAGapInWhichNothingWasSampled) {
  TaughtSamples samples = samples_of(4.0, 0.01);
  samples.times_s.erase(samples.times_s.begin() + 100, samples.times_s.begin() + 120);
  samples.positions.erase(samples.positions.begin() + 200, samples.positions.begin() + 240);
  const auto motion = fit_taught_motion(samples);
  ASSERT_TRUE(motion) << motion.error();
  EXPECT_LT(largest_error(motion.value(), 3.9), 5e-3);
}

TEST(TaughtMotion, ForgetsTheNoiseOfASensor) {
  const auto motion = fit_taught_motion(samples_of(4.0, 0.002, 1e-3));
  ASSERT_TRUE(motion) << motion.error();
  EXPECT_LT(largest_error(motion.value(), 3.9), 1.5e-3);
  EXPECT_GT(motion.value().largest_deviation, 2e-3) << "the noise is in the samples";
}

/// By finite differences, at places that are no knots and at knots.
TEST(TaughtMotion, TheWeightsAreDerivativesOfEachOther) {
  constexpr double kSmall = 1e-5;
  for (const double share : {0.1, 0.4, 0.85}) {
    const auto before = SplineWeights::at(share - kSmall);
    const auto here = SplineWeights::at(share);
    const auto after = SplineWeights::at(share + kSmall);
    const double step_s = 2.0 * kSmall * kKnotSpacing_s;
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR((after.position[k] - before.position[k]) / step_s, here.slope[k], 1e-5);
      EXPECT_NEAR((after.slope[k] - before.slope[k]) / step_s, here.curvature[k], 1e-5);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(SplineWeights::at(1.0).curvature[k + 1], SplineWeights::at(0.0).curvature[k], 1e-9);
    EXPECT_NEAR(SplineWeights::at(1.0).slope[k + 1], SplineWeights::at(0.0).slope[k], 1e-9);
  }
}

TEST(TaughtMotion, RefusesSamplesThatAreNoneAndNamesThem) {
  TaughtSamples samples = samples_of(1.0, 0.01);
  samples.positions[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fit_taught_motion(samples).error(), "sample 3 has no finite number");
  samples = samples_of(1.0, 0.01);
  samples.times_s[7] = samples.times_s[6];
  EXPECT_EQ(fit_taught_motion(samples).error(), "sample 8 is not later than the one before it");
  EXPECT_EQ(fit_taught_motion({2, {1.0}, {0.0, 0.0}}).error(),
            "the motion has 1 samples, expected at least 4");
  samples.positions.pop_back();
  EXPECT_FALSE(fit_taught_motion(samples));
}

}  // namespace
}  // namespace armature::control
