// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/clock.hpp"

#include "bridges/ros2/internal/dds.hpp"

namespace armature::ros2 {

std::string Clock::open(const component::Surroundings& /*surroundings*/) {
  writer_ = writer(topic_, rosgraph_msgs_msg_dds__Clock__desc, {.depth = 1});
  return {};
}

void Clock::begin() {
  Publisher::begin();
  if (!is_simulated()) log_info("time is not simulated: nothing is written to {}", topic_.get());
}

void Clock::work() {
  if (!is_simulated()) return;
  const Stamp now = node().stamp_of(time());
  rosgraph_msgs_msg_dds__Clock_ message{};
  message.clock.sec = now.sec;
  message.clock.nanosec = now.nanosec;
  publish(*writer_, &message);
  tell();
}

}  // namespace armature::ros2
