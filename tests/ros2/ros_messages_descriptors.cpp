// SPDX-License-Identifier: Apache-2.0
#include "ros_messages_descriptors.hpp"

#include <dds/dds.h>

#include "ros_messages.h"

namespace armature::ros2 {

const dds_topic_descriptor& joint_state_type() { return sensor_msgs_msg_dds__JointState__desc; }
const dds_topic_descriptor& joint_trajectory_type() {
  return trajectory_msgs_msg_dds__JointTrajectory__desc;
}
const dds_topic_descriptor& twist_type() { return geometry_msgs_msg_dds__Twist__desc; }
const dds_topic_descriptor& joy_type() { return sensor_msgs_msg_dds__Joy__desc; }
const dds_topic_descriptor& float64_multi_array_type() {
  return std_msgs_msg_dds__Float64MultiArray__desc;
}
const dds_topic_descriptor& string_type() { return std_msgs_msg_dds__String__desc; }
const dds_topic_descriptor& clock_type() { return rosgraph_msgs_msg_dds__Clock__desc; }
const dds_topic_descriptor& tf_type() { return tf2_msgs_msg_dds__TFMessage__desc; }
const dds_topic_descriptor& diagnostic_array_type() {
  return diagnostic_msgs_msg_dds__DiagnosticArray__desc;
}
const dds_topic_descriptor& compressed_image_type() {
  return sensor_msgs_msg_dds__CompressedImage__desc;
}
const dds_topic_descriptor& participant_entities_type() {
  return rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc;
}

}  // namespace armature::ros2
