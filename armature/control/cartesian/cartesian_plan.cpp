// SPDX-License-Identifier: Apache-2.0
#include "armature/control/cartesian/cartesian_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/control/taught/taught_motion.hpp"

namespace armature::control {
namespace {

constexpr double kWayStep = 0.001;      // m, in which the way is looked at
constexpr double kReachedOnWay = 1e-7;  // m and rad together
constexpr double kMostTurn = 50.0;      // rad or m of a joint, for each m of way
constexpr double kBeginsNear = 0.002;   // m, and as many times 5 rad
constexpr double kTurnOfDeviation = 5;  // rad for each m
constexpr double kSample_s = 0.01;
constexpr double kMostStretch = 8.0;

std::string rounded_text(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

/// How far a tool has come that starts and stops smoothly: its velocity rises as a half wave of a
/// cosine, stays, and falls likewise.
class WayInTime {
 public:
  WayInTime(double length, double velocity, double acceleration)
      : length_(length), velocity_(velocity) {
    // The acceleration is largest in the middle of the ramp: v pi / (2 ramp).
    const double full = std::numbers::pi * velocity * velocity / (2.0 * acceleration);
    if (full > length) velocity_ = std::sqrt(2.0 * acceleration * length / std::numbers::pi);
    ramp_ = std::numbers::pi * velocity_ / (2.0 * acceleration);
    even_ = std::max(0.0, length / velocity_ - ramp_);
  }
  double duration() const { return 2.0 * ramp_ + even_; }
  double at(double time) const {
    if (time <= 0.0) return 0.0;
    if (time >= duration()) return length_;
    if (time <= ramp_) return risen(time);
    if (time <= ramp_ + even_) return 0.5 * velocity_ * ramp_ + velocity_ * (time - ramp_);
    return length_ - risen(duration() - time);
  }

 private:
  double risen(double time) const {
    const double phase = std::numbers::pi * time / ramp_;
    return 0.5 * velocity_ * (time - ramp_ / std::numbers::pi * std::sin(phase));
  }
  double length_;
  double velocity_;
  double ramp_ = 0.0;
  double even_ = 0.0;
};

/// Walks along the path with the joints.
class Walk {
 public:
  Walk(InverseKinematics& arm, const PosePath& path, std::span<const double> start,
       const CartesianLimits& limits)
      : arm_(arm), path_(path), limits_(limits), start_(start.begin(), start.end()) {}

  std::string objection_to_begin() {
    if (start_.size() != arm_.joints() || limits_.lower.size() != arm_.joints() ||
        limits_.upper.size() != arm_.joints()) {
      return "expected a position and limits for each of " + std::to_string(arm_.joints()) +
             " joints";
    }
    const PoseDistance apart = distance(arm_.pose_at(start_), path_.at(0.0));
    if (apart.way <= kBeginsNear && apart.angle <= kTurnOfDeviation * kBeginsNear) return {};
    return "the path does not begin where the tool is: it is " + rounded_text(apart.way, 4) +
           " m away";
  }

  /// Step by step to the end.
  std::string objection() {
    std::vector<double> joints = start_;
    const auto steps = static_cast<int>(std::ceil(path_.length() / kWayStep));
    for (int k = 0; k <= steps; ++k) {
      const double way = path_.length() * k / std::max(steps, 1);
      const std::vector<double> before = joints;
      if (std::string wrong = objection_at(way, before, joints, k > 0); !wrong.empty()) {
        return rounded_text(way) + " m along the path of " + rounded_text(path_.length()) + " m " +
               wrong;
      }
      fastest_turn_ = std::max(fastest_turn_, k > 0 ? turn_since(way, steps) : 0.0);
    }
    return {};
  }

  /// The largest velocity along the way with which the tool turns as slowly as it has to.
  double velocity() const {
    return fastest_turn_ > 0.0 ? std::min(limits_.velocity, limits_.turning / fastest_turn_)
                               : limits_.velocity;
  }

  /// The same way in time.
  /// @param stretch  slower by this
  TaughtSamples samples(const WayInTime& timing, double stretch) {
    TaughtSamples all;
    all.axes = arm_.joints();
    std::vector<double> joints = start_;
    const double duration = timing.duration() * stretch;
    const auto count = std::max(8, static_cast<int>(std::ceil(duration / kSample_s)));
    for (int k = 0; k <= count; ++k) {
      const double time = duration * k / count;
      arm_.solve(path_.at(timing.at(time / stretch)), joints);
      all.times_s.push_back(time);
      all.positions.insert(all.positions.end(), joints.begin(), joints.end());
    }
    return all;
  }

  /// [m] of the tool, or of its turn as so many m.
  double deviation(const TaughtMotion& motion, const WayInTime& timing, double stretch) {
    double most = 0.0;
    const double duration = timing.duration() * stretch;
    const auto count = static_cast<int>(std::ceil(duration / (0.7 * kSample_s)));
    for (int k = 0; k <= count; ++k) {
      const double time = duration * k / count;
      const Pose wanted = path_.at(timing.at(time / stretch));
      const PoseDistance apart = distance(arm_.pose_at(motion.positions_at(time)), wanted);
      most = std::max({most, apart.way, apart.angle / kTurnOfDeviation});
    }
    return most;
  }

 private:
  std::string objection_at(double way, const std::vector<double>& before,
                           std::vector<double>& joints, bool moved) {
    const double left = arm_.solve(path_.at(way), joints);
    const double step = path_.length() / std::ceil(path_.length() / kWayStep);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const double turn = std::abs(joints[i] - before[i]);
      if (!std::isfinite(joints[i]) || (moved && turn > kMostTurn * step)) {
        return "the arm is singular or out of reach: " + name(i) + " would have to move by " +
               rounded_text(turn) + " on " + rounded_text(1000.0 * step, 1) + " mm";
      }
    }
    if (!(left < kReachedOnWay))
      return "is out of the arm's reach, by " + rounded_text(left, 4) + " m";
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (joints[i] >= limits_.lower[i] && joints[i] <= limits_.upper[i]) continue;
      return name(i) + " would be at " + rounded_text(joints[i]) + ", expected " +
             rounded_text(limits_.lower[i]) + " to " + rounded_text(limits_.upper[i]);
    }
    return {};
  }
  /// [rad/m]
  double turn_since(double way, int steps) const {
    const double step = path_.length() / steps;
    return distance(path_.at(way - step), path_.at(way)).angle / step;
  }
  std::string name(std::size_t joint) const {
    return "joint " + std::to_string(joint + 1) + " (" + arm_.joint_names()[joint] + ")";
  }

  InverseKinematics& arm_;
  const PosePath& path_;
  const CartesianLimits& limits_;
  const std::vector<double> start_;
  double fastest_turn_ = 0.0;  // rad for each m
};

}  // namespace

base::Result<CartesianPlan> plan_cartesian(InverseKinematics& arm, const PosePath& path,
                                           std::span<const double> start,
                                           const CartesianLimits& limits) {
  Walk walk(arm, path, start, limits);
  if (std::string wrong = walk.objection_to_begin(); !wrong.empty()) return base::Error{wrong};
  if (std::string wrong = walk.objection(); !wrong.empty()) return base::Error{wrong};
  const WayInTime timing(path.length(), walk.velocity(), limits.acceleration);
  CartesianPlan plan{.points = {}, .duration_s = timing.duration()};
  for (double stretch = 1.0; stretch <= kMostStretch; stretch *= 2.0) {
    auto motion = fit_taught_motion(walk.samples(timing, stretch));
    if (!motion) return base::Error{motion.error()};
    plan.speed = stretch;
    plan.largest_deviation = walk.deviation(motion.value(), timing, stretch);
    plan.points = std::move(motion).value().points;
    if (plan.largest_deviation <= limits.max_deviation) return plan;
  }
  return base::Error{"the tool would be " + rounded_text(plan.largest_deviation, 5) +
                     " m off the path, expected at most " + rounded_text(limits.max_deviation, 5) +
                     ": let it be slower"};
}

}  // namespace armature::control
