// SPDX-License-Identifier: Apache-2.0
// expect: must list every field of Pose once
// expect: Pose needs all its fields public and in one struct, and no virtual function
#include "armature/types/struct.hpp"

struct Pose {
  virtual ~Pose() = default;
  double x = 0.0;
};
ARMATURE_STRUCT(Pose, x);
