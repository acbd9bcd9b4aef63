// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/joy.hpp"

#include <algorithm>
#include <cmath>

#include "bridges/ros2/internal/dds.hpp"
#include "bridges/ros2/internal/messages.hpp"

namespace armature::ros2 {

std::string Joy::open(const component::Surroundings& /*surroundings*/) {
  reader_ = reader(topic_, sensor_msgs_msg_dds__Joy__desc, kCommands);
  return {};
}

void Joy::begin() {
  Subscriber::begin();
  stamp_ns_ = 0;
}

void Joy::work() {
  // Whoever comes after a silence may have another clock.
  if (is_silent()) stamp_ns_ = 0;
  receive(*reader_, [this](const void* sample) { return obey(sample); });
}

std::string Joy::obey(const void* sample) {
  const auto& joy = *static_cast<const sensor_msgs_msg_dds__Joy_*>(sample);
  const std::vector<float> axes = internal::elements_of(joy.axes);
  const std::vector<std::int32_t> buttons = internal::elements_of(joy.buttons);
  if (axes.size() != static_cast<std::size_t>(axes_.get()) ||
      buttons.size() != static_cast<std::size_t>(buttons_.get())) {
    return std::to_string(axes.size()) + " axes and " + std::to_string(buttons.size()) +
           " buttons, expected " + std::to_string(axes_.get()) + " and " +
           std::to_string(buttons_.get());
  }
  if (!std::ranges::all_of(axes, [](float axis) { return std::abs(axis) <= 1.0f; })) {
    return "an axis is not from -1 to 1";
  }
  const std::int64_t stamp_ns = internal::ns_of(joy.header.stamp);
  if (stamp_ns != 0 && stamp_ns < stamp_ns_) return "its stamp is before that of the one before";
  stamp_ns_ = stamp_ns;
  axis_.write({axes.begin(), axes.end()});
  button_.write({buttons.begin(), buttons.end()});
  return {};
}

}  // namespace armature::ros2
