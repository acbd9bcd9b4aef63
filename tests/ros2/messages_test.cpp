// SPDX-License-Identifier: Apache-2.0
// Every field of every message, in both directions, between our node on Cyclone DDS and Fast DDS
// with types by its own generator: our side reads each message into the C type that idlc made, and
// writes that one back.
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "bridges/ros2/participant.hpp"
#include "fast_peer.hpp"
#include "ros_messages_descriptors.hpp"

namespace armature::ros2 {
namespace {

constexpr int kDomain = 61;

/// One participant on each side for all tests: discovery takes a second.
struct Sides {
  std::shared_ptr<Participant> ours =
      std::move(Participant::open({.node = "tested", .domain = kDomain})).value();
  FastPeer theirs{kDomain};
};

class Messages : public testing::Test {
 protected:
  static void SetUpTestSuite() { sides = std::make_unique<Sides>(); }
  static void TearDownTestSuite() { sides.reset(); }

  /// `message` goes there and back.
  template <typename PubSubType>
  void comes_back(const std::string& topic, const dds_topic_descriptor& type,
                  const typename PubSubType::type& message) {
    auto* const from = sides->theirs.write_to<PubSubType>("rt/" + topic);
    auto* const to = sides->theirs.read_from<PubSubType>("rt/" + topic + "_back");
    const auto reader = sides->ours->read_from(topic, type, {});
    const auto writer = sides->ours->write_to(topic + "_back", type, {});
    ASSERT_TRUE(reader && writer);
    ASSERT_TRUE(wait_until([&] { return is_matched(*from) && is_matched(*to); })) << topic;

    typename PubSubType::type found;
    const auto arrives = [&] {
      typename PubSubType::type copy = message;
      from->write(&copy);
      for (int k = 0; k < 100; ++k) {
        reader.value()->take(
            1, [&](const void* sample, const Sender*) { writer.value()->write(sample); });
        if (take(*to, found)) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      return false;
    };
    // One side may know of the other a moment later: then the first ones are for nobody.
    bool arrived = false;
    for (int k = 0; k < 50 && !arrived; ++k) arrived = arrives();
    ASSERT_TRUE(arrived) << topic;
    EXPECT_TRUE(found == message) << topic << ": a field has another value";
    EXPECT_FALSE(found == typename PubSubType::type()) << topic << ": the test has filled nothing";
  }

  static std::unique_ptr<Sides> sides;
};
std::unique_ptr<Sides> Messages::sides;

std_msgs::msg::dds_::Header_ header() {
  std_msgs::msg::dds_::Header_ header;
  header.stamp().sec(-7);
  header.stamp().nanosec(999999999u);
  header.frame_id("base link");
  return header;
}

geometry_msgs::msg::dds_::Vector3_ vector(double x, double y, double z) {
  geometry_msgs::msg::dds_::Vector3_ vector;
  vector.x(x);
  vector.y(y);
  vector.z(z);
  return vector;
}

TEST_F(Messages, JointStates) {
  sensor_msgs::msg::dds_::JointState_ message;
  message.header(header());
  message.name({"shoulder", "", "wrist"});
  message.position({0.5, -1.25, 3.0e300});
  message.velocity({1.5});
  message.effort({2.5, 3.5});
  comes_back<sensor_msgs::msg::dds_::JointState_PubSubType>("joint_state", joint_state_type(),
                                                            message);
}

TEST_F(Messages, Trajectories) {
  trajectory_msgs::msg::dds_::JointTrajectory_ message;
  message.header(header());
  message.joint_names({"pan", "tilt"});
  for (int k = 1; k <= 3; ++k) {
    trajectory_msgs::msg::dds_::JointTrajectoryPoint_ point;
    point.positions({0.1 * k, 0.2 * k});
    point.velocities({0.3 * k});
    point.accelerations({0.4 * k, 0.5 * k, 0.6 * k});
    point.effort({0.7 * k});
    point.time_from_start().sec(k);
    point.time_from_start().nanosec(static_cast<std::uint32_t>(1000 + k));
    message.points().push_back(point);
  }
  comes_back<trajectory_msgs::msg::dds_::JointTrajectory_PubSubType>(
      "trajectory", joint_trajectory_type(), message);
}

TEST_F(Messages, Twists) {
  geometry_msgs::msg::dds_::Twist_ message;
  message.linear(vector(1.0, 2.0, 3.0));
  message.angular(vector(4.0, 5.0, 6.0));
  comes_back<geometry_msgs::msg::dds_::Twist_PubSubType>("twist", twist_type(), message);
}

TEST_F(Messages, JoysAndArrays) {
  sensor_msgs::msg::dds_::Joy_ joy;
  joy.header(header());
  joy.axes({0.5f, -1.0f});
  joy.buttons({1, -2, 3});
  comes_back<sensor_msgs::msg::dds_::Joy_PubSubType>("joy", joy_type(), joy);

  std_msgs::msg::dds_::Float64MultiArray_ array;
  std_msgs::msg::dds_::MultiArrayDimension_ dimension;
  dimension.label("rows");
  dimension.size(2);
  dimension.stride(3);
  array.layout().dim({dimension, dimension});
  array.layout().data_offset(4);
  array.data({1.0, -2.0, 1e-300});
  comes_back<std_msgs::msg::dds_::Float64MultiArray_PubSubType>("array", float64_multi_array_type(),
                                                                array);
}

TEST_F(Messages, TextsClocksAndTransforms) {
  std_msgs::msg::dds_::String_ text;
  text.data(std::string(100000, 'x'));  // longer than a packet
  comes_back<std_msgs::msg::dds_::String_PubSubType>("text", string_type(), text);

  rosgraph_msgs::msg::dds_::Clock_ clock;
  clock.clock().sec(12);
  clock.clock().nanosec(34);
  comes_back<rosgraph_msgs::msg::dds_::Clock_PubSubType>("clock", clock_type(), clock);

  geometry_msgs::msg::dds_::TransformStamped_ transform;
  transform.header(header());
  transform.child_frame_id("tool");
  transform.transform().translation(vector(1.0, 2.0, 3.0));
  transform.transform().rotation().x(0.1);
  transform.transform().rotation().y(0.2);
  transform.transform().rotation().z(0.3);
  transform.transform().rotation().w(0.4);
  tf2_msgs::msg::dds_::TFMessage_ transforms;
  transforms.transforms({transform, transform});
  comes_back<tf2_msgs::msg::dds_::TFMessage_PubSubType>("transforms", tf_type(), transforms);
}

TEST_F(Messages, DiagnosticsImagesAndNodes) {
  diagnostic_msgs::msg::dds_::DiagnosticStatus_ status;
  status.level(2);
  status.name("Joint1");
  status.message("out of service");
  status.hardware_id("card 1");
  diagnostic_msgs::msg::dds_::KeyValue_ value;
  value.key("state");
  value.value("Exception");
  status.values({value, value});
  diagnostic_msgs::msg::dds_::DiagnosticArray_ diagnostics;
  diagnostics.header(header());
  diagnostics.status({status});
  comes_back<diagnostic_msgs::msg::dds_::DiagnosticArray_PubSubType>(
      "diagnostics", diagnostic_array_type(), diagnostics);

  sensor_msgs::msg::dds_::CompressedImage_ image;
  image.header(header());
  image.format("png");
  image.data({0, 255, 137});
  comes_back<sensor_msgs::msg::dds_::CompressedImage_PubSubType>("image", compressed_image_type(),
                                                                 image);

  rmw_dds_common::msg::dds_::NodeEntitiesInfo_ node;
  node.node_namespace("/arm");
  node.node_name("armature");
  rmw_dds_common::msg::dds_::Gid_ gid;
  for (std::size_t k = 0; k < gid.data().size(); ++k) gid.data()[k] = static_cast<std::uint8_t>(k);
  node.reader_gid_seq({gid});
  node.writer_gid_seq({gid, gid});
  rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_ entities;
  entities.gid(gid);
  entities.node_entities_info_seq({node});
  comes_back<rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_PubSubType>(
      "nodes", participant_entities_type(), entities);
}

}  // namespace
}  // namespace armature::ros2
