// SPDX-License-Identifier: Apache-2.0
#pragma once

// Parts of messages that several components write or read.

#include <cstdint>
#include <string>

#include "bridges/ros2/internal/dds.hpp"
#include "bridges/ros2/node.hpp"

namespace armature::ros2::internal {

inline std_msgs_msg_dds__Header_ header_of(const Stamp& stamp, const std::string& frame) {
  std_msgs_msg_dds__Header_ header{};
  header.stamp.sec = stamp.sec;
  header.stamp.nanosec = stamp.nanosec;
  header.frame_id = lend(frame);
  return header;
}

inline std::int64_t ns_of(const Stamp& stamp) {
  return std::int64_t{1'000'000'000} * stamp.sec + stamp.nanosec;
}
inline std::int64_t ns_of(const builtin_interfaces_msg_dds__Time_& time) {
  return std::int64_t{1'000'000'000} * time.sec + time.nanosec;
}
inline std::int64_t ns_of(const builtin_interfaces_msg_dds__Duration_& duration) {
  return std::int64_t{1'000'000'000} * duration.sec + duration.nanosec;
}

}  // namespace armature::ros2::internal
