// SPDX-License-Identifier: Apache-2.0
// What the components of the library ros2 write, as Fast DDS reads it.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "armature/vision/png.hpp"
#include "talk.hpp"

namespace armature::ros2 {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Out, JointStatesHaveNamesPositionsAndTheVelocitiesOfTheSameCycle) {
  Talk talk(deployment(std::string(kNumbers) + "ros: JointStates:\n    model: JointStates\n    "
                                               "properties: {joints: 2, joint_names: [pan, "
                                               "tilt], frame_id: base}\n",
                       "  - Numbers.Position -> JointStates.Position\n  - Numbers.Velocity -> "
                       "JointStates.Velocity\n  - Numbers.Effort -> JointStates.Effort\n"));
  auto* const reader =
      talk.peer.read_from<sensor_msgs::msg::dds_::JointState_PubSubType>("rt/joint_states");
  sensor_msgs::msg::dds_::JointState_ message;
  const base::Time begin = talk.last_cycle();
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Effort", std::vector<double>{3.5, -4.5});
    talk.robot.write("Numbers", "Velocity", std::vector<double>{0.25, -0.5});
    talk.robot.write("Numbers", "Position", std::vector<double>{1.5, -2.5});
    return take(*reader, message);
  })) << talk.robot.log;
  EXPECT_THAT(message.name(), ElementsAre("pan", "tilt"));
  EXPECT_THAT(message.position(), ElementsAre(1.5, -2.5));
  EXPECT_THAT(message.velocity(), ElementsAre(0.25, -0.5));
  EXPECT_THAT(message.effort(), ElementsAre(3.5, -4.5));
  talk.expect_stamped_since(begin, message.header());
  EXPECT_EQ(message.header().frame_id(), "base");
}

TEST(Out, ADescriptionIsThereForWhoComesLaterAndTheClockTellsSimulatedTime) {
  Talk talk(deployment(std::string("ros: RobotDescription:\n    model: RobotDescription\n    "
                                   "properties: {robot_description: ") +
                       ROBOTS "/janus/janus.urdf}\nros: Clock:\n    model: Clock\n"));
  talk.robot.run_for(20ms);
  auto* const description = talk.peer.read_from<std_msgs::msg::dds_::String_PubSubType>(
      "rt/robot_description", {.transient_local = true});
  std_msgs::msg::dds_::String_ text;
  ASSERT_TRUE(talk.until([&] { return take(*description, text); }));
  std::ifstream file(ROBOTS "/janus/janus.urdf");
  const std::string content((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(text.data(), content);

  auto* const reader = talk.peer.read_from<rosgraph_msgs::msg::dds_::Clock_PubSubType>("rt/clock");
  rosgraph_msgs::msg::dds_::Clock_ clock;
  ASSERT_TRUE(talk.until([&] { return take(*reader, clock); }));
  while (take(*reader, clock)) continue;
  const double now = clock.clock().sec() + 1e-9 * clock.clock().nanosec();
  EXPECT_NEAR(now, 1e-9 * static_cast<double>(base::to_ns(talk.robot.application().now())), 0.5);
}

TEST(Out, ADescriptionAsLargeAsAMessageMayBeArrivesAndALargerOneIsRefused) {
  const std::string path = ::testing::TempDir() + "description_" + std::to_string(::getpid());
  const auto described = [&](std::size_t size) {
    std::ofstream(path) << std::string(size, 'x');
    return deployment(
        "ros: RobotDescription:\n    model: RobotDescription\n    properties: "
        "{robot_description: " +
        path + "}\n");
  };
  constexpr std::size_t kLargest = (4u << 20) - 16;
  EXPECT_THAT(described(kLargest + 1).diagnostics.to_text(),
              HasSubstr("it is larger than 4194288 bytes"));
  Talk talk(described(kLargest));
  std::remove(path.c_str());
  auto* const reader = talk.peer.read_from<std_msgs::msg::dds_::String_PubSubType>(
      "rt/robot_description", {.transient_local = true});
  std_msgs::msg::dds_::String_ text;
  ASSERT_TRUE(talk.until([&] { return take(*reader, text); }));
  EXPECT_EQ(text.data().size(), kLargest);
}

TEST(Out, TransformsAreOfPosesAndOfPlacesInThePlane) {
  Talk talk(deployment(std::string(kNumbers) +
                           "ros: Tool:\n    model: Tf\n    properties: {frame_id: base, "
                           "child_frame_id: tool, topic: tool}\n"
                           "ros: Odometry:\n    model: Tf\n    properties: {frame_id: odom, "
                           "child_frame_id: base_link}\n",
                       "  - Numbers.Pose -> Tool.Pose\n  - Numbers.X -> Odometry.X\n  - "
                       "Numbers.Heading -> Odometry.Heading\n"));
  auto* const tool = talk.peer.read_from<tf2_msgs::msg::dds_::TFMessage_PubSubType>("rt/tool");
  auto* const odometry = talk.peer.read_from<tf2_msgs::msg::dds_::TFMessage_PubSubType>("rt/tf");
  tf2_msgs::msg::dds_::TFMessage_ of_tool;
  const base::Time begin = talk.last_cycle();
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Pose", controllers::Pose{{1.0, 2.0, 3.0}, {0.1, 0.2, 0.3, 0.4}});
    return take(*tool, of_tool);
  }));
  ASSERT_EQ(of_tool.transforms().size(), 1u);
  const auto& transform = of_tool.transforms()[0];
  EXPECT_EQ(transform.header().frame_id(), "base");
  talk.expect_stamped_since(begin, transform.header());
  EXPECT_EQ(transform.child_frame_id(), "tool");
  EXPECT_EQ(transform.transform().translation().z(), 3.0);
  EXPECT_EQ(transform.transform().rotation().x(), 0.1);
  EXPECT_EQ(transform.transform().rotation().w(), 0.4);

  tf2_msgs::msg::dds_::TFMessage_ of_chassis;
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "X", 0.5);
    talk.robot.write("Numbers", "Heading", 1.0);
    return take(*odometry, of_chassis) &&
           of_chassis.transforms()[0].transform().rotation().z() != 0.0;
  }));
  EXPECT_EQ(of_chassis.transforms()[0].transform().translation().x(), 0.5);
  EXPECT_DOUBLE_EQ(of_chassis.transforms()[0].transform().rotation().z(), std::sin(0.5));
  EXPECT_DOUBLE_EQ(of_chassis.transforms()[0].transform().rotation().w(), std::cos(0.5));
  // X and Heading of different cycles are no place; those of one are sent once.
  talk.robot.run_for(20ms);
  const std::uint64_t published = talk.count("Odometry", "Published");
  talk.robot.write("Numbers", "X", 0.75);
  talk.robot.run_for(20ms);
  EXPECT_EQ(talk.count("Odometry", "Published"), published);
  talk.robot.write("Numbers", "X", 1.5);
  talk.robot.write("Numbers", "Heading", 2.0);
  talk.robot.run_for(20ms);
  EXPECT_EQ(talk.count("Odometry", "Published"), published + 1);
}

TEST(Out, DiagnosticsTellWhoIsOutOfServiceAndWhy) {
  Talk talk(deployment(
      std::string(kNumbers) +
      "ros: Diagnostics:\n    model: Diagnostics\n    properties: {hardware_id: rig}\n"));
  component::Component& numbers = *talk.robot.application().find("Numbers");
  talk.robot.application().run_in_thread_of(numbers, [&] { numbers.fault("the rig is on fire"); });
  auto* const reader =
      talk.peer.read_from<diagnostic_msgs::msg::dds_::DiagnosticArray_PubSubType>("rt/diagnostics");
  diagnostic_msgs::msg::dds_::DiagnosticArray_ message;
  const base::Time begin = talk.last_cycle();
  ASSERT_TRUE(talk.until([&] { return take(*reader, message); }));
  talk.expect_stamped_since(begin, message.header());
  std::vector<std::string> told;
  for (const auto& status : message.status()) {
    told.push_back(status.name() + " " + std::to_string(status.level()) + " " + status.message() +
                   " " + status.hardware_id() + " " + status.values().at(0).key() + "=" +
                   status.values().at(0).value());
  }
  EXPECT_THAT(told, ElementsAre("Ros 0 Running rig state=Running",
                                "Numbers 2 the rig is on fire rig state=Exception",
                                "Diagnostics 0 Running rig state=Running"));
}

TEST(Out, ImagesArePng) {
  Talk talk(deployment(
      std::string(kNumbers) +
          "ros: Image:\n    model: Image\n    properties: {ImageWidth: 2, ImageHeight: 2}\n",
      "  - Numbers.Image -> Image.Image\n"));
  auto* const reader = talk.peer.read_from<sensor_msgs::msg::dds_::CompressedImage_PubSubType>(
      "rt/image/compressed");
  const std::vector<std::uint8_t> pixels{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  sensor_msgs::msg::dds_::CompressedImage_ message;
  const base::Time begin = talk.last_cycle();
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Image", pixels);
    return take(*reader, message);
  }));
  EXPECT_EQ(message.format(), "png");
  EXPECT_EQ(message.header().frame_id(), "camera");
  talk.expect_stamped_since(begin, message.header());
  EXPECT_EQ(std::string(message.data().begin(), message.data().end()),
            vision::png_of({pixels.data(), {2, 2}}));
}

TEST(Out, TheNodeIsAnnouncedWithItsReadersAndWriters) {
  Talk talk(deployment(
      std::string(kNumbers) +
          "Operator: {model: Operator, activity: {periodic: 2 ms}}\nros: Twist:\n    model: "
          "Twist\n    peers: [Operator]\n"
          "ros: Image:\n    model: Image\n    properties: {ImageWidth: 2, ImageHeight: 2}\n",
      "  - Numbers.Image -> Image.Image\n"));
  auto* const reader =
      talk.peer.read_from<rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_PubSubType>(
          "ros_discovery_info", {.transient_local = true});
  auto* const image = talk.peer.read_from<sensor_msgs::msg::dds_::CompressedImage_PubSubType>(
      "rt/image/compressed");
  rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_ message;
  ASSERT_TRUE(talk.until([&] { return take(*reader, message) && is_matched(*image); }));
  ASSERT_EQ(message.node_entities_info_seq().size(), 1u);
  const auto& node = message.node_entities_info_seq()[0];
  EXPECT_EQ(node.node_namespace(), "/");
  EXPECT_EQ(node.node_name(), "tested");
  EXPECT_EQ(node.reader_gid_seq().size(), 1u);
  ASSERT_EQ(node.writer_gid_seq().size(), 1u);
  // Its images come from the writer that is announced.
  sensor_msgs::msg::dds_::CompressedImage_ taken;
  fast::SampleInfo info;
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Image", std::vector<std::uint8_t>(12));
    return image->take_next_sample(&taken, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
  }));
  std::vector<std::uint8_t> writer;
  const auto guid = eprosima::fastrtps::rtps::iHandle2GUID(info.publication_handle);
  writer.insert(writer.end(), std::begin(guid.guidPrefix.value), std::end(guid.guidPrefix.value));
  writer.insert(writer.end(), std::begin(guid.entityId.value), std::end(guid.entityId.value));
  const auto& gid = node.writer_gid_seq()[0].data();
  EXPECT_EQ(std::vector<std::uint8_t>(gid.begin(), gid.begin() + 16), writer);
}
}  // namespace
}  // namespace armature::ros2
