// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::cli {

/// Limits and gains for one joint of a new robot, to begin with.
struct JointPlan {
  bool continuous = false;  ///< it turns without end: `lower` and `upper` are a turn to both sides
  double lower = 0.0;       ///< [rad]
  double upper = 0.0;       ///< [rad]
  double max_velocity = 0.0;      ///< [rad/s] of the joint's limiter
  double max_acceleration = 0.0;  ///< [rad/s^2] likewise
  double motion_velocity = 0.0;   ///< [rad/s] of motions, with a margin below the limiter's
  double motion_acceleration = 0.0;
  double max_torque = 0.0;  ///< [Nm]
  double kp = 0.0;          ///< [Nm/rad]
  double kd = 0.0;          ///< [Nm s/rad]
  double start = 0.0;       ///< [rad] where the simulated joint begins
  double target = 0.0;      ///< [rad] where the first motion goes
};

/// How the joints are driven.
struct JointDrive {
  double period_s = 0.0;
  double delay_s = 0.0;        ///< from a sample until the torque acts that answers it
  double rotor_inertia = 0.0;  ///< [kg m^2] of the motor at the joint
  bool closed_here = true;     ///< drives that follow by themselves need no gains
};

/// Reads the robot's description, and chooses limits within it, and gains by pole placement: both
/// poles at -w, kp = w^2 I and kd = 2 w I, with the inertia I of the heaviest pose, or as much of
/// it as is possible, and the largest w up to 20 rad/s for which the sampled loop has a margin in
/// every pose (`control::judge_loop`).
/// @param urdf    its text
/// @param file    what errors call it
/// @param joints  that it is expected to have
/// @return an error for a description that cannot be read, has another number of joints, a joint
///         that slides, or one that cannot carry its own weight
base::Result<std::vector<JointPlan>> plan_joints(const std::string& urdf, const std::string& file,
                                                 std::size_t joints, const JointDrive& drive);

}  // namespace armature::cli
