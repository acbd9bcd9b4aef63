// SPDX-License-Identifier: Apache-2.0
#pragma once

struct dds_topic_descriptor;

// The types of messages as Cyclone DDS has them; its header and that of Fast DDS have the same
// names, so they do not meet.
namespace armature::ros2 {

const dds_topic_descriptor& joint_state_type();
const dds_topic_descriptor& joint_trajectory_type();
const dds_topic_descriptor& twist_type();
const dds_topic_descriptor& joy_type();
const dds_topic_descriptor& float64_multi_array_type();
const dds_topic_descriptor& string_type();
const dds_topic_descriptor& clock_type();
const dds_topic_descriptor& tf_type();
const dds_topic_descriptor& diagnostic_array_type();
const dds_topic_descriptor& compressed_image_type();
const dds_topic_descriptor& participant_entities_type();

}  // namespace armature::ros2
