// SPDX-License-Identifier: Apache-2.0
#include "tests/configurations/motion_watch.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "armature/base/seconds.hpp"

namespace armature::configurations {
namespace {

constexpr base::Duration kOfOneWay = std::chrono::milliseconds(20);
constexpr double kBeyondLimits = 0.05;  // rad

template <typename... Numbers>
std::string formatted(const char* format, Numbers... numbers) {
  char text[160];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

}  // namespace

void MotionWatch::allow_from_now(Bounds bounds) {
  bounds_ = std::move(bounds);
  worst_ = 0.0;
  from_ = last_;
  begin_ = last_time_;
  std::fill(way_.begin(), way_.end(), 0.0);
}

void MotionWatch::look_at(base::Time now, const std::vector<double>& positions) {
  for (std::size_t joint = 0; joint < positions.size(); ++joint) {
    way_[joint] += std::abs(positions[joint] - last_[joint]);
  }
  last_ = positions;
  last_time_ = now;
  const base::Duration elapsed = now - begin_;
  if (elapsed < kOfOneWay) return;
  for (std::size_t joint = 0; joint < positions.size(); ++joint) {
    speeds_[joint] = std::exchange(way_[joint], 0.0) / base::to_seconds(elapsed);
    judge(joint, positions[joint]);
  }
  begin_ = now;
}

double MotionWatch::fastest() const {
  return speeds_.empty() ? 0.0 : *std::max_element(speeds_.begin(), speeds_.end());
}

void MotionWatch::judge(std::size_t joint, double position) {
  note(speeds_[joint] / bounds_.speed, joint, position);
  if (bounds_.moved) note(std::abs(position - from_[joint]) / *bounds_.moved, joint, position);
  const bool below =
      joint < bounds_.lower.size() && position < bounds_.lower[joint] - kBeyondLimits;
  const bool above =
      joint < bounds_.upper.size() && position > bounds_.upper[joint] + kBeyondLimits;
  if (below || above) note(2.0, joint, position);
}

void MotionWatch::note(double excess, std::size_t joint, double position) {
  if (!(excess > worst_)) return;
  worst_ = excess;
  if (excess <= 1.0) return;
  problem_ = formatted("joint %zu at %.3g rad and %.3g rad/s, %.3g rad from where it was",
                       joint + 1, position, speeds_[joint], position - from_[joint]);
}

}  // namespace armature::configurations
