// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>

namespace armature::control {

/// What the description of a robot (URDF) allows one of its joints; infinite where it says nothing.
struct JointLimits {
  std::optional<bool> slides;  ///< along its axis, in m and N; nothing where nobody says
  double lower = -std::numeric_limits<double>::infinity();        ///< [rad], [m] of one that slides
  double upper = std::numeric_limits<double>::infinity();         ///< the same
  double max_velocity = std::numeric_limits<double>::infinity();  ///< [rad/s], [m/s]
  double max_effort = std::numeric_limits<double>::infinity();    ///< [N m], [N]
};

}  // namespace armature::control
