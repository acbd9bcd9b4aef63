// SPDX-License-Identifier: Apache-2.0
#include "armature/control/cartesian/cartesian_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "armature/control/cartesian/way_in_time.hpp"
#include "armature/control/taught/taught_motion.hpp"
#include "armature/control/taught/taught_player.hpp"

namespace armature::control {
namespace {

constexpr double kPlace = 0.001;  // m, between two places whose limits are looked at
constexpr double kSample_s = 0.01;
constexpr double kFastestPlay = TaughtPlayer::kFastest;
constexpr double kHardest = TimedPath::kHardest;
constexpr double kShareAcross = 0.8;    // of the acceleration, on a bend
constexpr double kShareOfBrake = 0.6;   // of it, when the player slows down by itself
constexpr double kShareOfJog = 0.95;    // the fit is not exact
constexpr double kMarginOfWay = 0.005;  // m, from where a jog would end, so that it leads back
constexpr double kMarginOfJog = 0.01;   // rad, m of a joint
constexpr double kShortestJog = 0.003;  // m
constexpr int kMostHalvings = 3;        // a jog stays shorter than the usual max_duration

std::string metres(double way) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5f m", way);
  return text;
}

/// What the tool may do along its path, by its bends and its turns.
WayLimits limits_along(const PosePath& path, const CartesianLimits& limits) {
  const auto steps = std::max(8, static_cast<int>(std::ceil(path.length() / kPlace)));
  const double step = path.length() / steps;
  WayLimits all{.length = path.length(), .velocity = {}, .acceleration = {}};
  for (int k = 0; k <= steps; ++k) {
    const double from = std::max(0.0, (k - 1) * step);
    const double to = std::min(path.length(), (k + 1) * step);
    const double bend = path.bend(from, to);
    const double turn = distance(path.at(from), path.at(to)).angle / (to - from);
    double most = std::min(limits.velocity, kShareOfBrake * limits.acceleration);
    if (turn > 0.0) most = std::min(most, limits.turning / turn);
    if (bend > 0.0) most = std::min(most, std::sqrt(kShareAcross * limits.acceleration / bend));
    const double across = most * most * bend;
    all.velocity.push_back(most);
    all.acceleration.push_back(
        std::sqrt(limits.acceleration * limits.acceleration - across * across));
  }
  return all;
}

/// A path of joints for a way in the player's time.
class Fit {
 public:
  Fit(InverseKinematics& arm, const PosePath& path, PathWalk& walk)
      : arm_(arm), path_(path), walk_(walk) {}

  /// @param way_at  double f(double time_s): how far the tool is
  template <typename WayAt>
  base::Result<CartesianPlan> run(double duration_s, const WayAt& way_at) {
    TaughtSamples samples{.axes = arm_.joints(), .times_s = {}, .positions = {}};
    const auto count = std::max(8, static_cast<int>(std::ceil(duration_s / kSample_s)));
    walk_.return_to_start();
    for (int k = 0; k <= count; ++k) {
      const double time_s = duration_s * k / count;
      const std::vector<double>& joints = walk_.follow(way_at(time_s));
      samples.times_s.push_back(time_s);
      samples.positions.insert(samples.positions.end(), joints.begin(), joints.end());
    }
    auto motion = fit_taught_motion(samples);
    if (!motion) return base::Error{motion.error()};
    CartesianPlan plan;
    for (int k = 0; k < 2 * count; ++k) {
      const double time_s = duration_s * (k + 0.35) / (2 * count);
      const Pose pose = arm_.pose_at(motion.value().positions_at(time_s));
      const PoseDistance apart = distance(pose, path_.at(way_at(time_s)));
      plan.largest_deviation =
          std::max({plan.largest_deviation, apart.way, apart.angle / kTurnOfDeviation});
    }
    plan.points = std::move(motion).value().points;
    return plan;
  }

 private:
  InverseKinematics& arm_;
  const PosePath& path_;
  PathWalk& walk_;
};

/// A jog's joints keep off their limits, and those that are nearer may leave them.
CartesianLimits with_margin(CartesianLimits limits, std::span<const double> start) {
  for (std::size_t i = 0; i < start.size(); ++i) {
    limits.lower[i] = std::min(limits.lower[i] + kMarginOfJog, start[i]);
    limits.upper[i] = std::max(limits.upper[i] - kMarginOfJog, start[i]);
  }
  return limits;
}

/// The player takes only what begins where the joints are.
bool begins_at(const CartesianPlan& plan, std::span<const double> start) {
  for (std::size_t axis = 0; axis < start.size(); ++axis) {
    const double begin = taught_hull(plan.points, start.size(), 0, axis).front();
    if (std::abs(begin - start[axis]) > TaughtPlayer::kHere) return false;
  }
  return true;
}

bool stays_within(const CartesianPlan& plan, const CartesianLimits& limits) {
  const std::size_t axes = limits.lower.size();
  for (std::size_t knot = 0; knot + 3 < plan.points.size() / axes; ++knot) {
    for (std::size_t axis = 0; axis < axes; ++axis) {
      for (const double place : taught_hull(plan.points, axes, knot, axis)) {
        if (place < limits.lower[axis] || place > limits.upper[axis]) return false;
      }
    }
  }
  return true;
}

base::Error too_far_off(double deviation, double allowed) {
  return base::Error{"the joints' smooth way would lead the tool off the path, by " +
                     metres(deviation) + ", expected " + metres(allowed) +
                     " at most, or begins beside them: the arm is nearly singular, or too fast"};
}

}  // namespace

base::Result<CartesianPlan> plan_cartesian(InverseKinematics& arm, const PosePath& path,
                                           std::span<const double> start,
                                           const CartesianLimits& limits) {
  PathWalk walk(arm, path, start, limits);
  if (std::string wrong = walk.objection_to_begin(); !wrong.empty()) return base::Error{wrong};
  if (Reach reach = walk.reach(); !reach.end.empty()) return base::Error{std::move(reach.end)};
  const WayLimits along = limits_along(path, limits);
  const WayInTime timing(along);
  const double fastest = *std::ranges::max_element(along.velocity);
  double speed = std::max(1.0, kHardest * fastest / (kShareOfBrake * limits.acceleration));
  Fit fit(arm, path, walk);
  for (;; speed = std::min(2.0 * speed, kFastestPlay)) {
    // The player needs that long until it has its speed: the tool moves only then.
    const double rest_s = 0.5 * speed * speed / kHardest + kKnotSpacing_s;
    auto plan = fit.run(2.0 * rest_s + speed * timing.duration(),
                        [&](double time_s) { return timing.at((time_s - rest_s) / speed); });
    if (!plan) return plan;
    plan.value().speed = speed;
    plan.value().duration_s = timing.duration() + 2.0 * speed / kHardest;
    const double deviation = plan.value().largest_deviation;
    if (deviation <= limits.max_deviation && begins_at(plan.value(), start)) return plan;
    if (speed >= kFastestPlay) return too_far_off(deviation, limits.max_deviation);
  }
}

base::Result<JogPlan> plan_jog(InverseKinematics& arm, const PosePath& line,
                               std::span<const double> start, const CartesianLimits& allowed) {
  PathWalk begin(arm, line, start, allowed);
  if (std::string wrong = begin.objection_to_begin(); !wrong.empty()) return base::Error{wrong};
  const CartesianLimits limits = with_margin(allowed, start);
  PathWalk whole(arm, line, start, limits);
  Reach reach = whole.reach();
  if (!reach.end.empty()) reach.way -= kMarginOfWay;
  if (reach.way < kShortestJog) return base::Error{std::move(reach.end)};
  const auto path = PosePath::line(line.at(0.0), line.at(reach.way));
  if (!path) return base::Error{path.error()};
  PathWalk walk(arm, path.value(), start, limits);
  Fit fit(arm, path.value(), walk);
  // The player's speed changes by kHardest at most: at this one that is the tool's acceleration.
  double even = kShareOfJog * limits.acceleration / kHardest;
  double deviation = 0.0;
  const double length = path.value().length();
  for (int halvings = 0; halvings < kMostHalvings; ++halvings, even *= 0.5) {
    // Whole pieces of the spline, so that it ends where the line does.
    const double duration_s = std::ceil(length / even / kKnotSpacing_s) * kKnotSpacing_s;
    const double speed = limits.velocity * duration_s / length;
    if (halvings == 0 && (speed < TaughtPlayer::kSlowest || speed > kFastestPlay)) {
      return base::Error{"the tool would be jogged with " + metres(limits.velocity) +
                         "/s, expected " +
                         metres(limits.velocity * TaughtPlayer::kSlowest / speed) + "/s to " +
                         metres(limits.velocity * kFastestPlay / speed) + "/s by its acceleration"};
    }
    if (speed > kFastestPlay) break;
    auto plan = fit.run(duration_s, [&](double time_s) { return length * time_s / duration_s; });
    if (!plan) return base::Error{plan.error()};
    plan.value().speed = speed;
    plan.value().duration_s = length / limits.velocity;
    deviation = plan.value().largest_deviation;
    if (deviation > limits.max_deviation || !begins_at(plan.value(), start)) continue;
    if (!stays_within(plan.value(), allowed)) continue;
    return JogPlan{std::move(plan).value(), length, std::move(reach.end)};
  }
  return too_far_off(deviation, limits.max_deviation);
}

}  // namespace armature::control
