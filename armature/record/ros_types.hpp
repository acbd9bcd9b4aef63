// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "armature/types/struct.hpp"

/// Messages that ROS 2 has itself, and a schema of Foxglove: what a robot's frames and joints are
/// recorded as.
namespace armature::record::ros {

/// builtin_interfaces/msg/Time
struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};
ARMATURE_STRUCT(Time, sec, nanosec);

/// std_msgs/msg/Header
struct Header {
  Time stamp;
  std::string frame_id;
};
ARMATURE_STRUCT(Header, stamp, frame_id);

/// geometry_msgs/msg/Vector3, foxglove.Vector3
struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;
};
ARMATURE_STRUCT(Vector3, x, y, z);

/// geometry_msgs/msg/Quaternion, foxglove.Quaternion
struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};
ARMATURE_STRUCT(Quaternion, x, y, z, w);

/// geometry_msgs/msg/Transform
struct Transform {
  Vector3 translation;
  Quaternion rotation;
};
ARMATURE_STRUCT(Transform, translation, rotation);

/// geometry_msgs/msg/TransformStamped
struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;
};
ARMATURE_STRUCT(TransformStamped, header, child_frame_id, transform);

/// tf2_msgs/msg/TFMessage
struct TFMessage {
  std::vector<TransformStamped> transforms;
};
ARMATURE_STRUCT(TFMessage, transforms);

/// sensor_msgs/msg/JointState; lists that are not known are empty
struct JointState {
  Header header;
  std::vector<std::string> name;
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> effort;
};
ARMATURE_STRUCT(JointState, header, name, position, velocity, effort);

/// foxglove's time
struct Stamp {
  std::uint32_t sec = 0;
  std::uint32_t nsec = 0;
};
ARMATURE_STRUCT(Stamp, sec, nsec);

/// foxglove.FrameTransform
struct FrameTransform {
  Stamp timestamp;
  std::string parent_frame_id;
  std::string child_frame_id;
  Vector3 translation;
  Quaternion rotation;
};
ARMATURE_STRUCT(FrameTransform, timestamp, parent_frame_id, child_frame_id, translation, rotation);

/// foxglove.FrameTransforms
struct FrameTransforms {
  std::vector<FrameTransform> transforms;
};
ARMATURE_STRUCT(FrameTransforms, transforms);

}  // namespace armature::record::ros
