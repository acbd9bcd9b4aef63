// SPDX-License-Identifier: Apache-2.0
#include "armature/control/cartesian/way_in_time.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

WayLimits even(double length, double velocity, double acceleration) {
  return {length, std::vector<double>(201, velocity), std::vector<double>(201, acceleration)};
}

/// What was found by differences of 1 ms.
struct Found {
  double velocity = 0.0;      ///< the largest share of the limit at its place
  double acceleration = 0.0;  ///< likewise
  double jerk = 0.0;          ///< [m/s^3]
};

Found look_at(const WayLimits& limits) {
  constexpr double kStep = 1e-3;
  const WayInTime timing(limits);
  Found found;
  double before = 0.0;
  for (double t = kStep; t < timing.duration() - kStep; t += kStep) {
    const double way = timing.at(t);
    const double velocity = (timing.at(t + kStep) - timing.at(t - kStep)) / (2 * kStep);
    const double acceleration =
        (timing.at(t + kStep) - 2 * way + timing.at(t - kStep)) / (kStep * kStep);
    const double places = static_cast<double>(limits.velocity.size() - 1);
    const auto place = static_cast<std::size_t>(std::round(places * way / limits.length));
    EXPECT_GE(velocity, -1e-9);
    found.velocity = std::max(found.velocity, velocity / limits.velocity[place]);
    found.acceleration =
        std::max(found.acceleration, std::abs(acceleration) / limits.acceleration[place]);
    if (t > kStep) found.jerk = std::max(found.jerk, std::abs(acceleration - before) / kStep);
    before = acceleration;
  }
  return found;
}

TEST(WayInTime, GoesFromRestToRestAsFastAsItsLimitsAllow) {
  const WayInTime timing(even(1.0, 0.5, 2.0));
  EXPECT_NEAR(timing.duration(), 1.0 / 0.5 + 0.5 / 2.0 + WayInTime::kSmoothing_s, 0.01);
  EXPECT_EQ(timing.at(-1.0), 0.0);
  EXPECT_EQ(timing.at(0.0), 0.0);
  EXPECT_NEAR(timing.at(timing.duration()), 1.0, 1e-12);
  EXPECT_NEAR(timing.at(timing.duration() + 1.0), 1.0, 1e-12);
  EXPECT_NEAR(timing.at(0.5 * timing.duration()), 0.5, 1e-9) << "symmetric";
  EXPECT_LT(timing.at(1e-3), 1e-7);
}

TEST(WayInTime, AShortWayNeverComesToItsVelocity) {
  const WayInTime timing(even(0.01, 0.5, 1.0));
  EXPECT_NEAR(timing.duration(), 2.0 * std::sqrt(0.01) + WayInTime::kSmoothing_s, 0.01);
}

TEST(WayInTime, KeepsLimitsThatChangeAlongTheWayAndItsJerk) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> slow(0.02, 0.4);
  std::uniform_real_distribution<double> hard(0.6, 1.0);
  std::uniform_int_distribution<std::size_t> anywhere(0, 560);
  for (int k = 0; k < 20; ++k) {
    WayLimits limits = {0.6, std::vector<double>(601, 0.4), std::vector<double>(601, 1.0)};
    for (int bend = 0; bend < 5; ++bend) {
      const std::size_t first = anywhere(random);
      const double velocity = slow(random);
      const double acceleration = hard(random);
      for (std::size_t i = first; i < first + 40; ++i) {
        limits.velocity[i] = velocity;
        limits.acceleration[i] = acceleration;
      }
    }
    const Found found = look_at(limits);
    EXPECT_LE(found.velocity, 1.0 + 1e-6);
    EXPECT_GT(found.velocity, 0.9) << "and uses them";
    EXPECT_LE(found.acceleration, 1.0 + 1e-3);
    EXPECT_LE(found.jerk, 2.0 / WayInTime::kSmoothing_s + 0.2);
  }
}

}  // namespace
}  // namespace armature::control
