// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/tf.hpp"

#include <cmath>
#include <optional>
#include <set>

#include "bridges/ros2/internal/dds.hpp"
#include "bridges/ros2/internal/messages.hpp"

namespace armature::ros2 {

void Tf::on_check(component::Check& check) const {
  const bool has_pose = !check.writers_of(pose_).empty();
  const bool has_place = !check.writers_of(x_).empty() || !check.writers_of(y_).empty() ||
                         !check.writers_of(heading_).empty();
  if (has_pose == has_place) {
    return check.error(
        has_pose ? "it has both a Pose and X, Y or Heading" : "none of its inputs is connected",
        "connect Pose, or X, Y and Heading");
  }
  if (has_place) check_writers(check);
}

/// Cycles of several components are never the same, and only what is of one is a place.
void Tf::check_writers(component::Check& check) const {
  std::set<std::set<const component::Component*>> owners;
  for (const auto* input : {&x_, &y_, &heading_}) {
    std::set<const component::Component*> of_one;
    for (const auto* writer : check.writers_of(*input)) of_one.insert(&writer->owner());
    if (!of_one.empty()) owners.insert(of_one);
  }
  if (owners.size() < 2) return;
  check.error("X, Y and Heading come from different components, so never from one cycle",
              "connect those of one component, or have one write a Pose");
}

std::string Tf::open(const component::Surroundings& /*surroundings*/) {
  writer_ = writer(topic_, tf2_msgs_msg_dds__TFMessage__desc, {.depth = 100});
  return {};
}

void Tf::work() {
  if (const auto pose = pose_.read(); pose.is_new()) publish_pose(pose.value, pose.time);
  look_at_place();
  tell();
}

/// The next cycle may write while X, Y and Heading are read: then they wait for the next update.
void Tf::look_at_place() {
  const auto x = x_.read();
  const auto y = y_.read();
  const auto heading = heading_.read();
  std::optional<base::Time> at;
  for (const auto* each : {&x, &y, &heading}) {
    if (each->status == component::ReadStatus::kNotConnected) continue;
    if (each->status == component::ReadStatus::kNone || each->time != at.value_or(each->time)) {
      return;
    }
    at = each->time;
  }
  if (!at || at == placed_at_) return;
  placed_at_ = at;
  controllers::Pose pose;
  pose.position = {x.value, y.value, 0.0};
  pose.orientation = {0.0, 0.0, std::sin(0.5 * heading.value), std::cos(0.5 * heading.value)};
  publish_pose(pose, *at);
}

void Tf::publish_pose(const controllers::Pose& pose, base::Time at) {
  const auto& [position, turned] = pose;
  if (!std::isfinite(position.x + position.y + position.z + turned.x + turned.y + turned.z +
                     turned.w)) {
    return count_lost(1);
  }
  geometry_msgs_msg_dds__TransformStamped_ transform{};
  transform.header = internal::header_of(node().stamp_of(at), parent_);
  transform.child_frame_id = internal::lend(child_);
  transform.transform.translation = {position.x, position.y, position.z};
  transform.transform.rotation = {turned.x, turned.y, turned.z, turned.w};
  tf2_msgs_msg_dds__TFMessage_ message{};
  message.transforms._length = message.transforms._maximum = 1;
  message.transforms._buffer = &transform;
  publish(*writer_, &message);
}

}  // namespace armature::ros2
