// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/robot_description.hpp"

#include <utility>

#include "armature/platform/file.hpp"
#include "bridges/ros2/internal/dds.hpp"

namespace armature::ros2 {

std::string RobotDescription::open(const component::Surroundings& /*surroundings*/) {
  constexpr std::size_t kLargest = 16u << 20;
  auto text = platform::read_file(file_.get(), kLargest);
  if (!text) return text.error();
  text_ = std::move(text).value();
  writer_ = writer(topic_, std_msgs_msg_dds__String__desc, {.transient_local = true, .depth = 1});
  return {};
}

void RobotDescription::begin() {
  Publisher::begin();
  std_msgs_msg_dds__String_ message{};
  message.data = internal::lend(text_);
  publish(*writer_, &message);
  tell();
}

}  // namespace armature::ros2
