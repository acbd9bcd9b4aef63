// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/component/author.hpp"

namespace armature::rover {

/// What a wheel's drive says when it is read.
struct WheelSample {
  std::int64_t counts = 0;  ///< of the motor, since the sample before
  bool fresh = false;       ///< the encoder answered
  bool on = false;          ///< the drive drives
};
ARMATURE_STRUCT(WheelSample, counts, fresh, on);

}  // namespace armature::rover
