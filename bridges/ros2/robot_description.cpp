// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/robot_description.hpp"

#include <utility>

#include "armature/platform/file.hpp"
#include "bridges/ros2/internal/dds.hpp"

namespace armature::ros2 {

namespace {

/// Beside the text a message has its length, its end and how it is encoded.
constexpr std::size_t kLargestText = kLargestSample - 16;

}  // namespace

std::vector<RobotDescription::Objection> RobotDescription::objections(
    const Components& /*components*/) const {
  const auto text = platform::read_file(file_.get(), kLargestText);
  if (text) return {};
  return {
      {text.error(), "name a file with the robot's description (URDF) that fits into a message"}};
}

std::string RobotDescription::open(const component::Surroundings& /*surroundings*/) {
  auto text = platform::read_file(file_.get(), kLargestText);
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
