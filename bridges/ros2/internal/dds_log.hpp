// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace armature::ros2::internal {

/// What Cyclone DDS has to say: a line for each packet that it cannot read, so without limit for
/// whoever sends such packets.
struct DdsLog {
  std::uint64_t lines = 0;  ///< since this was asked last
  std::string last;         ///< of them
};

/// From now on it says nothing on stderr; it is counted instead.
/// @thread any, and so are the others
void count_dds_log();
/// What was counted since this was asked last.
DdsLog take_dds_log();

}  // namespace armature::ros2::internal
