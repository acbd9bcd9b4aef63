// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/tip_speed.hpp"

#include <chrono>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using Joints = std::array<double, 4>;

constexpr double kCounts = 4096.0 / (2.0 * std::numbers::pi);
constexpr double kQuantum = 0.02;  // [m/s] a count of motor 4 in 2 ms, and some more

/// Positions of the motors at these joints go in, one after the other.
std::optional<double> add(TipSpeed& speed, const Joints& q, base::Time now, bool zeroed) {
  const Joints motors{-42.0 * q[0], 28.25 * (q[1] - q[2] / 1.68), -28.25 * (q[1] + q[2] / 1.68),
                      -18.0 * q[3]};
  std::optional<double> last;
  for (std::size_t motor = 0; motor < 4; ++motor) {
    const auto counts = static_cast<std::int32_t>(std::floor(motors[motor] * kCounts));
    last = speed.add(motor, counts, now, zeroed);
    if (motor < 3) {
      EXPECT_FALSE(last) << "the round is not complete";
    }
  }
  return last;
}

/// The speed found while the joints turn at these velocities for 2 ms.
double found(const Joints& q, const Joints& velocities, bool zeroed = true) {
  TipSpeed speed({4096, 4096, 4096, 4096});
  EXPECT_FALSE(add(speed, q, base::time_from_ns(0), zeroed));
  Joints then = q;
  for (std::size_t i = 0; i < 4; ++i) then[i] += 0.002 * velocities[i];
  return add(speed, then, base::time_from_ns(2'000'000), zeroed).value();
}

TEST(TipSpeed, TurnsWithEveryJoint) {
  EXPECT_NEAR(found({0, 0, 0, 0}, {1, 0, 0, 0}), 0.0, kQuantum) << "upright";
  EXPECT_NEAR(found({0, 0, 0, 0}, {0, 1, 0, 0}), 0.9, kQuantum);
  EXPECT_NEAR(found({0.3, 0, 0, 0}, {0, 0, 0, 2}), 0.7, kQuantum);
  const double kRight = std::numbers::pi / 2.0;
  EXPECT_NEAR(found({0, kRight, 0, 0}, {1, 0, 0, 0}), 0.9, kQuantum) << "stretched out";
  EXPECT_NEAR(found({0, kRight, 0, kRight}, {1, 0, 0, 0}), 0.55, kQuantum) << "forearm hangs down";
  EXPECT_NEAR(found({0, 0, 0.7, kRight}, {0, 0, 1, 0}), 0.35, kQuantum) << "forearm swings round";
}

TEST(TipSpeed, OfKnownVelocitiesIsWhatTheBoardFinds) {
  const Joints q{0.3, 1.2, -0.7, 0.9}, qd{0.5, -0.4, 0.8, 1.0};
  EXPECT_NEAR(TipSpeed::of(q, qd), found(q, qd), kQuantum);
  EXPECT_NEAR(TipSpeed::of(Joints{}, Joints{0, 1, 0, 0}), 0.9, 1e-6);
  EXPECT_NEAR(TipSpeed::of(q, Joints{}), 0.0, 1e-12);
}

TEST(TipSpeed, WithoutZeroItTakesTheLongestArm) {
  EXPECT_NEAR(found({0, 0, 0, 0}, {1, 0, 0, 0}, false), 0.9, kQuantum);
  EXPECT_NEAR(found({0, 0, 0, 0}, {0, 0, 0, 2}, false), 0.7, kQuantum);
}

TEST(TipSpeed, AfterAPauseItBeginsAnew) {
  TipSpeed speed({4096, 4096, 4096, 4096});
  add(speed, {0, 0, 0, 0}, base::time_from_ns(0), true);
  EXPECT_FALSE(add(speed, {1, 1, 1, 1}, base::time_from_ns(60'000'000), true));
  EXPECT_TRUE(add(speed, {1, 1, 1, 1}, base::time_from_ns(62'000'000), true));
  speed.forget();
  EXPECT_FALSE(add(speed, {1, 1, 1, 1}, base::time_from_ns(64'000'000), true));
}

}  // namespace
}  // namespace armature::wam
