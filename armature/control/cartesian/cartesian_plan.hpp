// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/control/cartesian/inverse_kinematics.hpp"
#include "armature/control/cartesian/path_walk.hpp"
#include "armature/control/cartesian/pose_path.hpp"

namespace armature::control {

/// A path of joints that moves the tool on a path of poses, as control::TaughtPlayer plays it:
/// control points of a uniform cubic B-spline, and the speed at which that is the planned one.
struct CartesianPlan {
  std::vector<double> points;      ///< control points x joints
  double speed = 1.0;              ///< of the playing, 0.01 to 10
  double duration_s = 0.0;         ///< when joints need not slow it down
  double largest_deviation = 0.0;  ///< [m] of the tool, at places between its samples
};

/// Finds where the joints have to be along `path`, from `start` on, and times it: the tool starts
/// and stops smoothly (WayInTime), and keeps its limits of velocity, of turning, and of
/// acceleration: on a bend, where it may use 0.8 of that across the way, and when the player brakes
/// anywhere, with 0.6. Limits of joints' velocities and accelerations are kept by who plays it.
/// @return the error says what is wrong and how far along the path: see PathWalk
/// @thread configuration only, or one of its own: tens of milliseconds
base::Result<CartesianPlan> plan_cartesian(InverseKinematics& arm, const PosePath& path,
                                           std::span<const double> start,
                                           const CartesianLimits& limits);

/// A line that the tool follows at an even speed, as far as it gets.
struct JogPlan {
  CartesianPlan plan;
  double way = 0.0;  ///< [m] as PosePath has it
  std::string end;   ///< why it is not longer, with the place; empty at the end of the line
};

/// Follows `line` at an even speed, that of the limits, as far as the joints get: up to 5 mm
/// before they get no further, and 0.01 rad before their limits. The player does the rest: it
/// speeds up, and brakes when it is let go of or at the end, in at least as long as the tool's
/// limit of acceleration asks for.
/// @return the error says why the tool cannot be moved at all; at less than 3 mm it is not
/// @thread as plan_cartesian
base::Result<JogPlan> plan_jog(InverseKinematics& arm, const PosePath& line,
                               std::span<const double> start, const CartesianLimits& allowed);

}  // namespace armature::control
