// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/twist.hpp"

#include <cmath>

#include "bridges/ros2/internal/dds.hpp"

namespace armature::ros2 {
namespace {

/// Not of a number that is none.
bool is_within(const geometry_msgs_msg_dds__Vector3_& vector, double limit) {
  return std::abs(vector.x) <= limit && std::abs(vector.y) <= limit && std::abs(vector.z) <= limit;
}

}  // namespace

std::string Twist::open(const component::Surroundings& /*surroundings*/) {
  reader_ = reader(topic_, geometry_msgs_msg_dds__Twist__desc, kCommands);
  return {};
}

void Twist::work() {
  receive(*reader_, [this](const void* sample) { return obey(sample); });
}

std::string Twist::obey(const void* sample) {
  const auto& twist = *static_cast<const geometry_msgs_msg_dds__Twist_*>(sample);
  if (!is_within(twist.linear, max_linear_)) return "a linear speed is above max_linear, or none";
  if (!is_within(twist.angular, max_angular_))
    return "an angular speed is above max_angular, or none";
  x_.write(twist.linear.x);
  y_.write(twist.linear.y);
  z_.write(twist.linear.z);
  roll_.write(twist.angular.x);
  pitch_.write(twist.angular.y);
  yaw_.write(twist.angular.z);
  const double turn = 0.5 * track_ * twist.angular.z;
  left_.write(twist.linear.x - turn);
  right_.write(twist.linear.x + turn);
  return {};
}

}  // namespace armature::ros2
