// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/control/taught/taught_motion.hpp"

namespace armature::ros2::internal {

/// Where joints are to be at a time, as trajectory_msgs/JointTrajectoryPoint has it.
struct TrajectoryPoint {
  std::vector<double> positions;      ///< one for each joint
  std::vector<double> velocities;     ///< the same, or none
  std::vector<double> accelerations;  ///< the same, or none
  std::vector<double> effort;         ///< none
  std::int64_t time_ns = 0;           ///< from the start

  bool operator==(const TrajectoryPoint&) const = default;
};

/// trajectory_msgs/JointTrajectory.
struct Trajectory {
  std::int64_t stamp_ns = 0;  ///< of its header; 0: none
  std::vector<std::string> joints;
  std::vector<TrajectoryPoint> points;

  bool operator==(const Trajectory&) const = default;
};

/// What a trajectory is held against as a whole; the generator that plays it has limits of speed.
struct TrajectoryLimits {
  std::vector<std::string> joints;
  std::vector<double> lower;  ///< of each joint
  std::vector<double> upper;
  double longest_s = 60.0;
};

/// What is wrong with a trajectory; empty if nothing is.
std::string objection_to(const Trajectory& trajectory, const TrajectoryLimits& limits);

/// The way from `present`, at rest, through the points to rest in the last one, each 10 ms: through
/// positions, velocities and accelerations as they are given (polynomials of degree 1, 3 or 5
/// between two points, as ROS 2's joint_trajectory_controller has them), joints in the order of
/// `limits`. Before and behind it rests for a moment, so that a smooth path ends where it is to.
/// A joint that rests a little beyond its limit begins at the limit.
/// @param trajectory  to which there is no objection
control::TaughtSamples way_of(const Trajectory& trajectory, const TrajectoryLimits& limits,
                              std::span<const double> present);

/// The smooth path nearest to `way`, as a generator plays it. Of a way along a limit it rings by
/// less than 1 mrad beyond it; that is cut off.
base::Result<control::TaughtMotion> smooth_path_of(const control::TaughtSamples& way,
                                                   const TrajectoryLimits& limits);

}  // namespace armature::ros2::internal
