// SPDX-License-Identifier: Apache-2.0
#include "armature/control/cartesian/path_walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace armature::control {
namespace {

constexpr double kWayStep = 0.001;     // m, in which the way is looked at
constexpr double kReached = 1e-7;      // m and rad together
constexpr double kMostTurn = 50.0;     // rad or m of a joint, for each m of way
constexpr double kBeginsNear = 0.002;  // m, and as many times 5 rad
constexpr double kLookBehind = 0.01;   // m, in which a reach that ends is left

std::string digits(double value, int count = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", count, value);
  return text;
}

}  // namespace

PathWalk::PathWalk(InverseKinematics& arm, const PosePath& path, std::span<const double> start,
                   const CartesianLimits& limits)
    : arm_(arm),
      path_(path),
      limits_(limits),
      start_(start.begin(), start.end()),
      joints_(start_),
      step_(path.length() / std::ceil(path.length() / kWayStep)) {}

std::string PathWalk::objection_to_begin() {
  const std::size_t joints = arm_.joints();
  if (start_.size() != joints || limits_.lower.size() != joints || limits_.upper.size() != joints) {
    return "expected a position and limits for each of " + std::to_string(joints) + " joints";
  }
  const PoseDistance apart = distance(arm_.pose_at(start_), path_.at(0.0));
  if (apart.way <= kBeginsNear && apart.angle <= kTurnOfDeviation * kBeginsNear) return {};
  return "the path does not begin where the tool is: it is " + digits(apart.way, 4) + " m away";
}

Reach PathWalk::reach() {
  return_to_start();
  const auto steps = static_cast<int>(std::round(path_.length() / step_));
  for (int k = 0; k <= steps; ++k) {
    const double way = k * step_;
    const std::vector<double> before = joints_;
    const std::string wrong = objection_at(way, before);
    if (wrong.empty()) continue;
    const auto [x, y, z] = path_.at(way).position;
    return {std::max(0.0, way - step_), digits(way) + " m along the path of " +
                                            digits(path_.length()) + " m, at x " + digits(x) +
                                            " y " + digits(y) + " z " + digits(z) + ", " + wrong};
  }
  return {path_.length(), {}};
}

const std::vector<double>& PathWalk::follow(double way) {
  arm_.solve(path_.at(way), joints_);
  return joints_;
}

std::string PathWalk::objection_at(double way, const std::vector<double>& before) {
  const double left = arm_.solve(path_.at(way), joints_);
  std::size_t most = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!std::isfinite(joints_[i])) return "the pose is out of the arm's reach";
    if (std::abs(joints_[i] - before[i]) > std::abs(joints_[most] - before[most])) most = i;
  }
  const double leap = std::abs(joints_[most] - before[most]);
  if (left >= kReached) {
    return "the pose is out of the arm's reach, by " + digits(std::max(left, 1e-4), 4) + " m";
  }
  if (way > 0.0 && leap > kMostTurn * step_) {
    joints_ = before;
    return objection_to_leap(way, most, leap);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i] >= limits_.lower[i] && joints_[i] <= limits_.upper[i]) continue;
    return name_of(i) + " would be at " + digits(joints_[i]) + ", expected " +
           digits(limits_.lower[i]) + " to " + digits(limits_.upper[i]);
  }
  return {};
}

/// A joint turns fast where the reach ends, too: then nothing behind can be reached.
std::string PathWalk::objection_to_leap(double way, std::size_t joint, double leap) {
  if (ends_behind(way)) return "the arm's reach ends: " + name_of(joint) + " cannot lead further";
  return "the arm is singular: " + name_of(joint) + " would have to move by " + digits(leap) +
         " on " + digits(1000.0 * step_, 1) + " mm of way";
}

bool PathWalk::ends_behind(double way) {
  std::vector<double> joints = joints_;
  return !(arm_.solve(path_.at(way + kLookBehind), joints) < kReached);
}

std::string PathWalk::name_of(std::size_t joint) const {
  return "joint " + std::to_string(joint + 1) + " (" + arm_.joint_names()[joint] + ")";
}

}  // namespace armature::control
