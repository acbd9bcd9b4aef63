// SPDX-License-Identifier: Apache-2.0
#include "armature/general/reporter/robot_track.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/component/interface.hpp"
#include "armature/record/ros_types.hpp"
#include "armature/types/number_place.hpp"

namespace armature::general {
namespace {

using record::McapWriter;
namespace ros = record::ros;

constexpr std::int64_t kSecond = 1'000'000'000;

ros::Time ros_time(base::Time time) {
  const std::int64_t ns = base::to_ns(time);
  return {static_cast<std::int32_t>(ns / kSecond), static_cast<std::uint32_t>(ns % kSecond)};
}

ros::Vector3 as_vector(const std::array<double, 3>& of) { return {of[0], of[1], of[2]}; }

ros::Quaternion as_quaternion(const std::array<double, 4>& of) {
  return {of[0], of[1], of[2], of[3]};
}

ros::TFMessage for_ros(const control::RobotFrames& frames,
                       const std::vector<control::FramePose>& poses, base::Time time) {
  ros::TFMessage message;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto& joint = frames.joints()[i];
    message.transforms.push_back(
        {{ros_time(time), joint.parent},
         joint.child,
         {as_vector(poses[i].position), as_quaternion(poses[i].rotation)}});
  }
  return message;
}

ros::FrameTransforms for_foxglove(const control::RobotFrames& frames,
                                  const std::vector<control::FramePose>& poses, base::Time time) {
  ros::FrameTransforms message;
  const ros::Time stamp = ros_time(time);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto& joint = frames.joints()[i];
    message.transforms.push_back({{static_cast<std::uint32_t>(stamp.sec), stamp.nanosec},
                                  joint.parent,
                                  joint.child,
                                  as_vector(poses[i].position),
                                  as_quaternion(poses[i].rotation)});
  }
  return message;
}

template <typename T>
std::vector<std::byte> encoded(const T& value) {
  std::vector<std::byte> bytes;
  types::encode(types::type_of<T>(), &value, bytes);
  return bytes;
}

std::string text_property(component::Component& of, const std::string& name) {
  for (const component::PropertyBase* one : component::interface_of(of).properties) {
    if (one->name() == name && one->type().kind == types::Kind::kText) {
      return *static_cast<const std::string*>(one->data());
    }
  }
  return {};
}

}  // namespace

base::Result<RobotTrack> RobotTrack::make(const std::vector<component::Component*>& components,
                                          std::vector<types::Value> positions,
                                          McapWriter::Profile profile) {
  for (component::Component* one : components) {
    const std::string path = text_property(*one, "robot_description");
    if (path.empty()) continue;
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    auto frames = control::RobotFrames::parse(text);
    if (!frames) return base::Error{base::quoted(path) + ": " + frames.error()};
    auto moving =
        frames.value().moving(text_property(*one, "base_link"), text_property(*one, "tip_link"));
    RobotTrack track(std::move(frames).value(), std::move(moving), std::move(positions), profile);
    const std::size_t found = track.numbers();
    const bool one_port = track.positions_.size() == 1;
    if (found == track.moving_.size() || (one_port && found > track.moving_.size())) return track;
    return base::Error{"the property 'joints' names the positions of " + std::to_string(found) +
                       " joints, and " + base::quoted(path) + " has " +
                       std::to_string(track.moving_.size())};
  }
  return base::Error{
      "the property 'joints' is of a robot, and no component describes one: none "
      "has a property robot_description that names a file (URDF)"};
}

RobotTrack::RobotTrack(control::RobotFrames frames, std::vector<std::size_t> moving,
                       std::vector<types::Value> positions, McapWriter::Profile profile)
    : frames_(std::move(frames)),
      moving_(std::move(moving)),
      positions_(std::move(positions)),
      came_(positions_.size(), false),
      profile_(profile) {}

std::vector<record::Channel> RobotTrack::channels() const {
  const std::string doc = "where the links are, by the recorded positions of the joints";
  if (!is_for_ros()) {
    return {{"/tf", types::Value::of(for_foxglove(frames_, poses(), base::Time{})), "", doc}};
  }
  ros::JointState state;
  state.name.resize(moving_.size());
  state.position.resize(moving_.size());
  return {{"/tf", types::Value::of(for_ros(frames_, poses(), base::Time{})), "", doc},
          {"/joint_states", types::Value::of(state), "", "the recorded positions of the joints"}};
}

void RobotTrack::take(std::size_t port, const std::vector<std::byte>& value) {
  types::Value& position = positions_[port];
  came_[port] = types::decode(position.type(), value.data(), value.size(), position.data()).ok();
}

std::vector<RobotTrack::Sample> RobotTrack::due(base::Time time) {
  const bool soon = last_ && time - *last_ < kInterval;
  if (soon || std::ranges::count(came_, false) > 0) return {};
  last_ = time;
  if (!is_for_ros()) return {{0, encoded(for_foxglove(frames_, poses(), time))}};
  ros::JointState state{{ros_time(time), ""}, {}, joint_positions(), {}, {}};
  for (const std::size_t joint : moving_) state.name.push_back(frames_.joints()[joint].name);
  return {{0, encoded(for_ros(frames_, poses(), time))}, {1, encoded(state)}};
}

std::size_t RobotTrack::numbers() const {
  std::size_t count = 0;
  for (const types::Value& one : positions_) {
    count += types::NumberPlace::all_in(one.type(), one.data()).size();
  }
  return count;
}

std::vector<double> RobotTrack::joint_positions() const {
  std::vector<double> all;
  for (const types::Value& one : positions_) {
    for (const auto& place : types::NumberPlace::all_in(one.type(), one.data())) {
      all.push_back(place.read(one.data()));
    }
  }
  all.resize(moving_.size());
  return all;
}

std::vector<control::FramePose> RobotTrack::poses() const {
  const std::vector<double> positions = joint_positions();
  std::map<std::size_t, double> of_joint;
  for (std::size_t i = 0; i < std::min(moving_.size(), positions.size()); ++i) {
    of_joint[moving_[i]] = positions[i];
  }
  std::vector<control::FramePose> all;
  for (std::size_t i = 0; i < frames_.joints().size(); ++i) {
    const auto found = of_joint.find(i);
    all.push_back(frames_.pose(i, found == of_joint.end() ? 0.0 : found->second));
  }
  return all;
}

}  // namespace armature::general
