// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "armature/control/cartesian/inverse_kinematics.hpp"
#include "armature/control/cartesian/pose_path.hpp"

namespace armature::control {

inline constexpr double kTurnOfDeviation = 5.0;  ///< [rad] for each m of deviation from a path

/// What a tool may do, and what its joints may.
struct CartesianLimits {
  double velocity = 0.25;     ///< [m/s] along the way, > 0
  double acceleration = 1.0;  ///< [m/s^2] of the tool; of its turn 10 rad/s^2 for each m/s^2; > 0
  double turning = 1.0;       ///< [rad/s], > 0
  double max_deviation = 0.001;  ///< [m] of the tool from the path; of its turn 5 rad for each m
  std::vector<double> lower;     ///< [rad, m], one for each joint
  std::vector<double> upper;
};

/// How far joints can lead a tool along its path.
struct Reach {
  double way = 0.0;  ///< [m]
  std::string end;   ///< why it is no further, with the place; empty at the end of the path
};

/// Leads a tool along a path by its joints, from `start` on, in steps of a millimetre. One thread
/// uses it; arm, path and limits live longer.
class PathWalk {
 public:
  PathWalk(InverseKinematics& arm, const PosePath& path, std::span<const double> start,
           const CartesianLimits& limits);

  /// Numbers that do not fit, or a path that does not begin where the joints are; empty: none.
  std::string objection_to_begin();
  /// Up to where the pose is out of reach, a joint would leave its limits, or would have to move
  /// by more than 50 rad for each m of way: the arm is singular there.
  Reach reach();
  /// Where the joints are for a place that is a small step from the last one that was asked for.
  const std::vector<double>& follow(double way);
  /// Begins anew.
  void return_to_start() { joints_ = start_; }

 private:
  std::string objection_at(double way, const std::vector<double>& before);
  std::string objection_to_leap(double way, std::size_t joint, double leap);
  bool ends_behind(double way);
  std::string name_of(std::size_t joint) const;

  InverseKinematics& arm_;
  const PosePath& path_;
  const CartesianLimits& limits_;
  const std::vector<double> start_;
  std::vector<double> joints_;
  double step_;  ///< [m]
};

}  // namespace armature::control
