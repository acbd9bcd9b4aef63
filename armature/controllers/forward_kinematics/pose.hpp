// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/types/struct.hpp"

namespace armature::controllers {

/// A place in space.
struct Point {
  double x = 0.0, y = 0.0, z = 0.0;
};
ARMATURE_STRUCT(Point, (x, "m"), (y, "m"), (z, "m"));

/// How something is turned, as a unit quaternion; with w = 1 it is not.
struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};
ARMATURE_STRUCT(Quaternion, x, y, z, w);

/// Where a link is and how it is turned, in the axes of another: v_base = q v_link q^-1 + position.
struct Pose {
  Point position{};
  Quaternion orientation{};
};
ARMATURE_STRUCT(Pose, position, orientation);

}  // namespace armature::controllers
