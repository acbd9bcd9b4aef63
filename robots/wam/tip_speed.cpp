// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/tip_speed.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace armature::wam {
namespace {

constexpr double kUpperArm = 0.55;  // [m]
constexpr double kForearm = 0.35;
constexpr std::array<double, TipSpeed::kMotors> kLongestArms{
    kUpperArm + kForearm, kUpperArm + kForearm, kForearm, kForearm};

struct Point {
  double x, y, z;
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
};

double distance(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Yaw about the base's z axis after pitch about its y axis.
Point turned(Point point, double yaw, double pitch) {
  const double x = std::cos(pitch) * point.x + std::sin(pitch) * point.z;
  const double z = -std::sin(pitch) * point.x + std::cos(pitch) * point.z;
  return {std::cos(yaw) * x - std::sin(yaw) * point.y, std::sin(yaw) * x + std::cos(yaw) * point.y,
          z};
}

Point elbow(const std::array<double, 4>& q) { return turned({0.0, 0.0, kUpperArm}, q[0], q[1]); }

Point wrist(const std::array<double, 4>& q) {
  const double out = kForearm * std::sin(q[3]);
  const Point forearm{out * std::cos(q[2]), out * std::sin(q[2]), kForearm * std::cos(q[3])};
  return elbow(q) + turned(forearm, q[0], q[1]);
}

}  // namespace

std::optional<double> TipSpeed::add(std::size_t motor, std::int32_t counts, base::Time now,
                                    bool zeroed) {
  counts_[motor] = counts;
  if (!std::ranges::all_of(counts_, [](const auto& each) { return each.has_value(); })) {
    return std::nullopt;
  }
  const Joints q = joints();
  const std::optional<Joints> last = last_;
  const base::Duration passed = now - last_time_;
  last_ = q;
  last_time_ = now;
  counts_.fill(std::nullopt);
  if (!last || passed > kLongest || passed <= base::Duration{}) return std::nullopt;
  const double dt = std::chrono::duration<double>(passed).count();
  if (zeroed)
    return std::max(distance(elbow(q), elbow(*last)), distance(wrist(q), wrist(*last))) / dt;
  double fastest = 0.0;
  for (std::size_t i = 0; i < kMotors; ++i) {
    fastest = std::max(fastest, std::abs(q[i] - (*last)[i]) * kLongestArms[i] / dt);
  }
  return fastest;
}

double TipSpeed::of(std::span<const double> q, std::span<const double> qd) {
  constexpr double kStep = 1e-4;  // [s]
  Joints before, after;
  for (std::size_t i = 0; i < kMotors; ++i) {
    before[i] = q[i] - 0.5 * kStep * qd[i];
    after[i] = q[i] + 0.5 * kStep * qd[i];
  }
  return std::max(distance(elbow(before), elbow(after)), distance(wrist(before), wrist(after))) /
         kStep;
}

void TipSpeed::forget() {
  counts_.fill(std::nullopt);
  last_.reset();
}

/// Through gears, and the differential between motors 2 and 3.
TipSpeed::Joints TipSpeed::joints() const {
  std::array<double, kMotors> motors;
  for (std::size_t i = 0; i < kMotors; ++i) {
    motors[i] = *counts_[i] * 2.0 * std::numbers::pi / counts_per_turn_[i];
  }
  return {-motors[0] / 42.0, (motors[1] - motors[2]) / (2.0 * 28.25),
          -(motors[1] + motors[2]) * 1.68 / (2.0 * 28.25), -motors[3] / 18.0};
}

}  // namespace armature::wam
