// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/control/cartesian/inverse_kinematics.hpp"
#include "armature/control/cartesian/pose_path.hpp"

namespace armature::control {

/// What a tool may do, and what its joints may.
struct CartesianLimits {
  double velocity = 0.25;        ///< [m/s] along the way, > 0
  double acceleration = 1.0;     ///< [m/s^2] along the way, > 0
  double turning = 1.0;          ///< [rad/s], > 0
  double max_deviation = 0.001;  ///< [m] of the tool from the path; of its turn 5 rad for each m
  std::vector<double> lower;     ///< [rad, m], one for each joint
  std::vector<double> upper;
};

/// A path of joints that moves the tool on a path of poses, as control::TaughtPlayer plays it:
/// control points of a uniform cubic B-spline, and the speed at which that is the planned one.
struct CartesianPlan {
  std::vector<double> points;      ///< control points x joints
  double speed = 1.0;              ///< of the playing
  double duration_s = 0.0;         ///< when joints need not slow it down
  double largest_deviation = 0.0;  ///< [m] of the tool, at places between its samples
};

/// Finds where the joints have to be along `path`, from `start` on, and times it: the tool starts
/// and stops smoothly, and is never faster than its limits. Limits of joints' velocities and
/// accelerations are kept by who plays it.
/// @return the error says what is wrong and how far along the path: out of reach, a joint beyond
/// its
///         limit, a place where a joint would have to turn by more than 50 rad for each m of way
///         (the arm is singular there)
/// @thread configuration only, or one of its own: tens of milliseconds
base::Result<CartesianPlan> plan_cartesian(InverseKinematics& arm, const PosePath& path,
                                           std::span<const double> start,
                                           const CartesianLimits& limits);

}  // namespace armature::control
