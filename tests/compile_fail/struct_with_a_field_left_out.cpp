// SPDX-License-Identifier: Apache-2.0
// expect: must list every field of Pose once
#include "armature/types/struct.hpp"

struct Pose {
  double x;
  double y;
};
ARMATURE_STRUCT(Pose, x);
