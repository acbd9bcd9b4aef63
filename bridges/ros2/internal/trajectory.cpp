// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bridges/ros2/internal/names.hpp"

namespace armature::ros2::internal {
namespace {

constexpr double kRest_s = 3 * control::kKnotSpacing_s;
constexpr double kSampling_s = 0.01;
constexpr double kRinging = 1e-3;
constexpr double kBeyondLimit = 0.01;  // a joint may rest there: a controller is not exact

std::string objection_to_numbers(std::string_view what, const std::vector<double>& numbers,
                                 std::size_t joints, bool may_miss) {
  if (numbers.empty() && may_miss) return {};
  if (numbers.size() != joints) {
    return std::to_string(numbers.size()) + " " + std::string(what) + ", expected " +
           std::to_string(joints);
  }
  for (const double each : numbers) {
    if (!std::isfinite(each)) return "a number of " + std::string(what) + " is not finite";
  }
  return {};
}

std::string objection_to_point(const TrajectoryPoint& point, std::size_t joints) {
  if (auto wrong = objection_to_numbers("positions", point.positions, joints, false);
      !wrong.empty()) {
    return wrong;
  }
  if (auto wrong = objection_to_numbers("velocities", point.velocities, joints, true);
      !wrong.empty()) {
    return wrong;
  }
  if (auto wrong = objection_to_numbers("accelerations", point.accelerations, joints, true);
      !wrong.empty()) {
    return wrong;
  }
  if (!point.accelerations.empty() && point.velocities.empty()) {
    return "accelerations without velocities";
  }
  return point.effort.empty() ? "" : "efforts, which no message gives a joint: leave them out";
}

/// @param places  of the joints in the point
std::string objection_to_place(const TrajectoryPoint& point, const std::vector<std::size_t>& places,
                               const TrajectoryLimits& limits) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double position = point.positions[places[i]];
    if (position >= limits.lower[i] && position <= limits.upper[i]) continue;
    return "joint '" + limits.joints[i] + "' is to be at " + std::to_string(position) +
           ", expected " + std::to_string(limits.lower[i]) + " to " +
           std::to_string(limits.upper[i]);
  }
  return {};
}

/// Position, velocity and acceleration of one joint.
struct Moment {
  double time_s = 0.0;
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};

/// How much of a moment is given.
enum class Given { kPositions, kVelocities, kAccelerations };

double between(const Moment& from, const Moment& to, double time_s, Given given) {
  const double whole = to.time_s - from.time_s;
  const double t = time_s - from.time_s;
  const double way = to.position - from.position;
  if (given == Given::kPositions) return from.position + way * t / whole;
  if (given == Given::kVelocities) {
    const double square = (3.0 * way / whole - 2.0 * from.velocity - to.velocity) / whole;
    const double cube = (from.velocity + to.velocity - 2.0 * way / whole) / (whole * whole);
    return from.position + t * (from.velocity + t * (square + t * cube));
  }
  const double T2 = whole * whole;
  const double a = from.acceleration * T2;
  const double b = to.acceleration * T2;
  const double v = from.velocity * whole;
  const double w = to.velocity * whole;
  const double c3 = 10.0 * way - 6.0 * v - 4.0 * w - 1.5 * a + 0.5 * b;
  const double c4 = -15.0 * way + 8.0 * v + 7.0 * w + 1.5 * a - b;
  const double c5 = 6.0 * way - 3.0 * v - 3.0 * w - 0.5 * a + 0.5 * b;
  const double s = t / whole;
  return from.position + s * (v + s * (0.5 * a + s * (c3 + s * (c4 + s * c5))));
}

Given given_by(const Trajectory& trajectory) {
  const auto all_have = [&](const auto member) {
    return std::ranges::none_of(
        trajectory.points, [&](const TrajectoryPoint& each) { return (each.*member).empty(); });
  };
  if (all_have(&TrajectoryPoint::accelerations)) return Given::kAccelerations;
  return all_have(&TrajectoryPoint::velocities) ? Given::kVelocities : Given::kPositions;
}

/// What the trajectory says of one joint.
/// @param place  of the joint in the points
std::vector<Moment> moments_of(const Trajectory& trajectory, std::size_t place, double present) {
  std::vector<Moment> moments;
  if (trajectory.points.front().time_ns > 0) moments.push_back({.position = present});
  const auto at = [&](const std::vector<double>& numbers) {
    return numbers.empty() ? 0.0 : numbers[place];
  };
  for (const TrajectoryPoint& point : trajectory.points) {
    moments.push_back({1e-9 * static_cast<double>(point.time_ns), point.positions[place],
                       at(point.velocities), at(point.accelerations)});
  }
  return moments;
}

/// A position that is beyond a limit by less than `tolerance` is at the limit.
double within(const TrajectoryLimits& limits, std::size_t joint, double position,
              double tolerance) {
  const double inside = std::clamp(position, limits.lower[joint], limits.upper[joint]);
  return std::abs(inside - position) < tolerance ? inside : position;
}

double position_at(const std::vector<Moment>& moments, double time_s, Given given) {
  const auto next = std::ranges::upper_bound(moments, time_s, {}, &Moment::time_s);
  if (next == moments.begin()) return moments.front().position;
  if (next == moments.end()) return moments.back().position;
  return between(*(next - 1), *next, time_s, given);
}

}  // namespace

std::string objection_to(const Trajectory& trajectory, const TrajectoryLimits& limits) {
  if (trajectory.points.empty()) return {};  // it asks for a stop
  const Places places = places_of(limits.joints, trajectory.joints);
  if (!places.refused.empty()) return places.refused;
  std::int64_t before_ns = -1;
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    const TrajectoryPoint& point = trajectory.points[i];
    const std::string name = "point " + std::to_string(i + 1) + ": ";
    if (auto wrong = objection_to_point(point, limits.joints.size()); !wrong.empty()) {
      return name + wrong;
    }
    if (auto wrong = objection_to_place(point, places.of, limits); !wrong.empty()) {
      return name + wrong;
    }
    if (point.time_ns <= before_ns) {
      return name + "time_from_start is not later than the point's before it";
    }
    before_ns = point.time_ns;
  }
  if (1e-9 * static_cast<double>(before_ns) > limits.longest_s) {
    return "it takes " + std::to_string(1e-9 * static_cast<double>(before_ns)) +
           " s, expected at most max_duration, " + std::to_string(limits.longest_s) + " s";
  }
  return {};
}

control::TaughtSamples way_of(const Trajectory& trajectory, const TrajectoryLimits& limits,
                              std::span<const double> present) {
  const std::size_t joints = limits.joints.size();
  const std::vector<std::size_t> places = places_of(limits.joints, trajectory.joints).of;
  // One point without velocities is where to come to rest.
  const Given given = trajectory.points.size() == 1 && trajectory.points[0].velocities.empty()
                          ? Given::kVelocities
                          : given_by(trajectory);
  std::vector<std::vector<Moment>> moments;
  for (std::size_t i = 0; i < joints; ++i) {
    moments.push_back(
        moments_of(trajectory, places[i], within(limits, i, present[i], kBeyondLimit)));
  }
  const double end_s = 1e-9 * static_cast<double>(trajectory.points.back().time_ns);
  control::TaughtSamples way{joints, {}, {}};
  for (double time_s = -kRest_s; time_s < end_s + kRest_s; time_s += kSampling_s) {
    way.times_s.push_back(time_s + kRest_s);
    for (const auto& joint : moments) way.positions.push_back(position_at(joint, time_s, given));
  }
  return way;
}

base::Result<control::TaughtMotion> smooth_path_of(const control::TaughtSamples& way,
                                                   const TrajectoryLimits& limits) {
  auto path = control::fit_taught_motion(way);
  if (!path) return path;
  std::vector<double>& points = path.value().points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = within(limits, i % way.axes, points[i], kRinging);
  }
  return path;
}

}  // namespace armature::ros2::internal
