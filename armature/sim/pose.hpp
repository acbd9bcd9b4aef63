// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace armature::sim {

/// Where a body is, in the axes of the world.
struct Pose {
  std::array<double, 3> position{};                       ///< [m]
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  ///< unit quaternion w, x, y, z
};

}  // namespace armature::sim
