// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/joint_states.hpp"

#include <utility>

#include "armature/component/face.hpp"
#include "bridges/ros2/internal/dds.hpp"
#include "bridges/ros2/internal/messages.hpp"
#include "bridges/ros2/internal/names.hpp"

namespace armature::ros2 {

std::vector<JointStates::Objection> JointStates::objections(
    const Components& /*components*/) const {
  return internal::objections_to_names(names_, static_cast<std::size_t>(joints_.get()));
}

std::string JointStates::open(const component::Surroundings& /*surroundings*/) {
  writer_ = writer(topic_, sensor_msgs_msg_dds__JointState__desc, {.depth = 100});
  const auto capacity = static_cast<std::size_t>(buffer_.get());
  positions_.follow(face(position_), capacity);
  velocities_.follow(face(velocity_), capacity);
  efforts_.follow(face(effort_), capacity);
  return {};
}

void JointStates::close() {
  writer_.reset();
  positions_.end();
  velocities_.end();
  efforts_.end();
}

void JointStates::begin() {
  Publisher::begin();
  seen_ = 0;
  present_velocity_.clear();
  present_effort_.clear();
  updated_at_ = time();
  for (internal::Feed* each : {&positions_, &velocities_, &efforts_}) each->skip();
}

void JointStates::work() {
  // Cycles that began before the last update have written all that belongs to them.
  const base::Time whole = std::exchange(updated_at_, time());
  types::Value value(types::type_of<Vector>());
  auto& numbers = *static_cast<Vector*>(value.data());
  while (const auto at = positions_.take_before(whole, value)) {
    Vector positions = numbers;
    const base::Time after = *at + base::Duration(1);
    while (velocities_.take_before(after, value)) present_velocity_ = numbers;
    while (efforts_.take_before(after, value)) present_effort_ = numbers;
    if (seen_++ % static_cast<std::uint64_t>(every_.get()) == 0) publish_state(*at, positions);
  }
  count_lost(positions_.take_dropped());
  tell();
}

void JointStates::publish_state(base::Time at, Vector& positions) {
  std::vector<char*> names;
  for (const std::string& name : names_.get()) names.push_back(internal::lend(name));
  sensor_msgs_msg_dds__JointState_ message{};
  message.header = internal::header_of(node().stamp_of(at), frame_);
  internal::lend(names, message.name);
  internal::lend(positions, message.position);
  internal::lend(present_velocity_, message.velocity);
  internal::lend(present_effort_, message.effort);
  publish(*writer_, &message);
}

}  // namespace armature::ros2
