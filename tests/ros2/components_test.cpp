// SPDX-License-Identifier: Apache-2.0
// The components of the library ros2 in an application, and Fast DDS on the other side.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/deployed_robot.hpp"
#include "armature/types/dds_idl.hpp"
#include "armature/vision/png.hpp"
#include "fast_peer.hpp"
#include "models.hpp"
#include "walkPubSubTypes.h"

namespace armature::ros2 {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace std::chrono_literals;

constexpr int kDomain = 63;

deploy::Deployment deployment(const std::string& components, const std::string& connections = "",
                              const std::string& interface = "lo") {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.models = [](component::Registry& registry) {
    registry.add<Numbers>("Numbers", "ports of a test");
    registry.add<Ticker>("Ticker", "counts");
    registry.add<Listener>("Listener", "listens");
  };
  const std::string ros = "    activity: {periodic: 2 ms, scheduler: other, thread: ros}\n";
  std::string text = "libraries: [ros2]\ncomponents:\n  Ros:\n    model: RosNode\n" + ros +
                     "    properties: {node: tested, domain: " + std::to_string(kDomain) +
                     ", interface: " + interface + "}\n";
  std::istringstream lines(components);
  for (std::string line; std::getline(lines, line);) {
    const bool is_of_ros = line.starts_with("ros: ");
    if (is_of_ros) line = line.substr(5);
    text += (line.starts_with(' ') ? "" : "  ") + line + "\n" + (is_of_ros ? ros : "");
  }
  if (!connections.empty()) text += "connections:\n" + connections;
  return deploy::parse_deployment(text, "test.yaml", options);
}

constexpr const char* kNumbers = "Numbers: {model: Numbers, activity: {periodic: 2 ms}}\n";

/// An application in simulated time, and a peer; both go on while one waits for the other.
class Talk {
 public:
  explicit Talk(deploy::Deployment deployment) : robot(std::move(deployment)) {
    EXPECT_EQ(robot.start(), "");
  }
  bool until(const std::function<bool()>& reached) {
    return wait_until([&] {
      robot.run_for(2ms);
      return reached();
    });
  }
  std::uint64_t count(const std::string& component, const char* port) {
    return robot.value<std::uint64_t>(component, port);
  }
  /// Sends a message again and again until the component has taken or refused one.
  template <typename Message>
  void send(fast::DataWriter& writer, Message message, const std::string& to) {
    const std::uint64_t before = count(to, "Received") + count(to, "Refused");
    ASSERT_TRUE(until([&] { return is_matched(writer); }));
    int k = 0;
    ASSERT_TRUE(until([&] {
      if (k++ % 50 == 0) writer.write(&message);
      return count(to, "Received") + count(to, "Refused") > before;
    }));
    // What is still on its way belongs to this message.
    until([&, calm = 0, last = before]() mutable {
      const std::uint64_t now = count(to, "Received") + count(to, "Refused");
      calm = now == last ? calm + 1 : 0;
      last = now;
      return calm > 30;
    });
  }

  FastPeer peer{kDomain};
  testing::DeployedRobot robot;
};

// --- out ---------------------------------------------------------------------------------------

TEST(Out, JointStatesHaveNamesPositionsAndTheVelocitiesOfTheSameCycle) {
  Talk talk(deployment(std::string(kNumbers) + "ros: JointStates:\n    model: JointStates\n    "
                                               "properties: {joints: 2, joint_names: [pan, "
                                               "tilt], frame_id: base}\n",
                       "  - Numbers.Position -> JointStates.Position\n  - Numbers.Velocity -> "
                       "JointStates.Velocity\n"));
  auto* const reader =
      talk.peer.read_from<sensor_msgs::msg::dds_::JointState_PubSubType>("rt/joint_states");
  sensor_msgs::msg::dds_::JointState_ message;
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Velocity", std::vector<double>{0.25, -0.5});
    talk.robot.write("Numbers", "Position", std::vector<double>{1.5, -2.5});
    return take(*reader, message);
  })) << talk.robot.log;
  EXPECT_THAT(message.name(), ElementsAre("pan", "tilt"));
  EXPECT_THAT(message.position(), ElementsAre(1.5, -2.5));
  EXPECT_THAT(message.velocity(), ElementsAre(0.25, -0.5));
  EXPECT_THAT(message.effort(), IsEmpty());
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
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Pose", controllers::Pose{{1.0, 2.0, 3.0}, {0.1, 0.2, 0.3, 0.4}});
    return take(*tool, of_tool);
  }));
  ASSERT_EQ(of_tool.transforms().size(), 1u);
  const auto& transform = of_tool.transforms()[0];
  EXPECT_EQ(transform.header().frame_id(), "base");
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
  ASSERT_TRUE(talk.until([&] { return take(*reader, message); }));
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
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Image", pixels);
    return take(*reader, message);
  }));
  EXPECT_EQ(message.format(), "png");
  EXPECT_EQ(message.header().frame_id(), "camera");
  EXPECT_EQ(std::string(message.data().begin(), message.data().end()),
            vision::png_of({pixels.data(), {2, 2}}));
}

TEST(Out, TheNodeIsAnnouncedWithItsReadersAndWriters) {
  Talk talk(deployment(
      std::string(kNumbers) +
          "ros: Twist:\n    model: Twist\n"
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

// --- in ----------------------------------------------------------------------------------------

geometry_msgs::msg::dds_::Twist_ twist(double forward, double turn) {
  geometry_msgs::msg::dds_::Twist_ message;
  message.linear().x(forward);
  message.linear().y(0.2);
  message.linear().z(0.3);
  message.angular().x(0.4);
  message.angular().y(0.5);
  message.angular().z(turn);
  return message;
}

TEST(In, ATwistIsObeyedOrRefusedAsAWhole) {
  Talk talk(
      deployment("ros: Twist:\n    model: Twist\n    properties: {max_linear: 0.6, max_angular: "
                 "2.0, track: 0.5}\n"));
  auto& writer = *talk.peer.write_to<geometry_msgs::msg::dds_::Twist_PubSubType>("rt/cmd_vel");
  talk.send(writer, twist(0.5, 1.0), "Twist");
  const auto port = [&](const char* name) { return talk.robot.value<double>("Twist", name); };
  EXPECT_EQ(port("LinearX"), 0.5);
  EXPECT_EQ(port("LinearY"), 0.2);
  EXPECT_EQ(port("LinearZ"), 0.3);
  EXPECT_EQ(port("AngularX"), 0.4);
  EXPECT_EQ(port("AngularY"), 0.5);
  EXPECT_EQ(port("AngularZ"), 1.0);
  EXPECT_EQ(port("Left"), 0.25);
  EXPECT_EQ(port("Right"), 0.75);
  const std::uint64_t received = talk.count("Twist", "Received");
  for (const auto& wrong :
       {twist(0.7, 0.1), twist(0.1, -2.1), twist(std::numeric_limits<double>::quiet_NaN(), 0.1),
        twist(0.1, std::numeric_limits<double>::infinity())}) {
    const std::uint64_t refused = talk.count("Twist", "Refused");
    talk.send(writer, wrong, "Twist");
    EXPECT_GT(talk.count("Twist", "Refused"), refused);
    EXPECT_EQ(port("LinearX"), 0.5);
    EXPECT_EQ(port("AngularZ"), 1.0);
  }
  EXPECT_EQ(talk.count("Twist", "Received"), received);
  // One line of the log for all that is refused in a row.
  EXPECT_EQ(talk.robot.log.find("refused a message"), talk.robot.log.rfind("refused a message"))
      << talk.robot.log;
}

TEST(In, AJoystickAndNumbersAreObeyedOrRefusedAsAWhole) {
  Talk talk(
      deployment("ros: Joy:\n    model: Joy\n    properties: {axes: 2, buttons: 1}\n"
                 "ros: Numbers:\n    model: Float64MultiArray\n    properties: {topic: wanted, "
                 "size: 2, lower: [-1], upper: [1, 2]}\n"));
  auto& joys = *talk.peer.write_to<sensor_msgs::msg::dds_::Joy_PubSubType>("rt/joy");
  sensor_msgs::msg::dds_::Joy_ joy;
  joy.header().stamp().sec(5);
  joy.axes({0.5f, -1.0f});
  joy.buttons({1});
  talk.send(joys, joy, "Joy");
  EXPECT_THAT(talk.robot.value<std::vector<double>>("Joy", "Axes"), ElementsAre(0.5, -1.0));
  EXPECT_THAT(talk.robot.value<std::vector<int>>("Joy", "Buttons"), ElementsAre(1));
  std::vector<sensor_msgs::msg::dds_::Joy_> wrong(4, joy);
  wrong[0].axes({0.1f});
  wrong[1].buttons({0, 0});
  wrong[2].axes({0.1f, 1.5f});
  wrong[3].axes({0.1f, 0.1f});
  wrong[3].header().stamp().sec(4);
  for (const auto& each : wrong) {
    const std::uint64_t refused = talk.count("Joy", "Refused");
    talk.send(joys, each, "Joy");
    EXPECT_GT(talk.count("Joy", "Refused"), refused);
  }
  EXPECT_THAT(talk.robot.value<std::vector<double>>("Joy", "Axes"), ElementsAre(0.5, -1.0));

  auto& arrays =
      *talk.peer.write_to<std_msgs::msg::dds_::Float64MultiArray_PubSubType>("rt/wanted");
  std_msgs::msg::dds_::Float64MultiArray_ array;
  array.data({-1.0, 2.0});
  talk.send(arrays, array, "Numbers");
  EXPECT_THAT(talk.robot.value<std::vector<double>>("Numbers", "Data"), ElementsAre(-1.0, 2.0));
  for (const std::vector<double>& each :
       {std::vector<double>{0.0}, {0.0, 2.1}, {-1.1, 0.0}, {0.0, std::nan("")}}) {
    const std::uint64_t refused = talk.count("Numbers", "Refused");
    array.data(each);
    talk.send(arrays, array, "Numbers");
    EXPECT_GT(talk.count("Numbers", "Refused"), refused);
  }
  EXPECT_THAT(talk.robot.value<std::vector<double>>("Numbers", "Data"), ElementsAre(-1.0, 2.0));
}

// --- ports as topics of their own ----------------------------------------------------------------

armature::msg::dds_::Walk_ walk_message() {
  armature::msg::dds_::Walk_ message;
  message.on(true);
  message.way(1);
  message.small(-8);
  message.steps(60000);
  message.large(-(std::int64_t{1} << 40));
  message.begin().x(0.25);
  message.begin().y(-0.5f);
  message.ends()[0].x(1.0);
  message.ends()[1].y(2.0f);
  message.between().resize(2);
  message.between()[1].x(3.0);
  message.name("fifteen letters");
  message.matrix()[1][2] = -3;
  message.numbers({0.5, 1.5, 2.5});
  return message;
}

Walk walk() {
  Walk walk;
  walk.on = true;
  walk.way = Way::kRight;
  walk.small = -8;
  walk.steps = 60000;
  walk.large = -(std::int64_t{1} << 40);
  walk.begin = {0.25, -0.5f};
  walk.ends[0].x = 1.0;
  walk.ends[1].y = 2.0f;
  walk.between.resize(2);
  walk.between[1].x = 3.0;
  walk.name = std::string_view("fifteen letters");
  walk.matrix[1][2] = -3;
  walk.numbers = {0.5, 1.5, 2.5};
  return walk;
}

TEST(Ports, TheIdlOfFastDdsIsThatOfThePort) {
  const std::array<const types::Type*, 2> types{&types::type_of<Walk>(),
                                                &types::type_of<std::vector<double>>()};
  std::ifstream file(TESTS "/walk.idl");
  EXPECT_EQ(std::string((std::istreambuf_iterator<char>(file)), {}), types::dds_idl(types));
}

TEST(Ports, AnyOutputIsATopicOfItsOwn) {
  Talk talk(deployment(
      std::string(kNumbers) +
      "ros: Walks:\n    model: PortToTopic\n    properties: {port: Numbers.Walk, topic: walk}\n"
      "ros: Positions:\n    model: PortToTopic\n    properties: {port: Numbers.Position, topic: "
      "positions}\n"));
  auto* const walks = talk.peer.read_from<armature::msg::dds_::Walk_PubSubType>("rt/walk");
  auto* const positions =
      talk.peer.read_from<armature::msg::dds_::Float64Vector_PubSubType>("rt/positions");
  armature::msg::dds_::Walk_ message;
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Walk", walk());
    return take(*walks, message);
  }));
  EXPECT_TRUE(message == walk_message());
  armature::msg::dds_::Float64Vector_ vector;
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Position", std::vector<double>{1.0, 2.0});
    return take(*positions, vector);
  }));
  EXPECT_THAT(vector.data(), ElementsAre(1.0, 2.0));
}

TEST(Ports, AnInputThatMayStayOpenIsATopicOfItsOwnAndWhatDoesNotFitIsRefused) {
  Talk talk(deployment(std::string(kNumbers) +
                       "ros: Walks:\n    model: TopicToPort\n    properties: "
                       "{port: Numbers.WalkIn, topic: walk}\n"));
  auto& writer = *talk.peer.write_to<armature::msg::dds_::Walk_PubSubType>("rt/walk");
  // The input takes vectors of the size that comes first: none is declared.
  armature::msg::dds_::Walk_ message = walk_message();
  message.between().clear();
  message.numbers().clear();
  talk.send(writer, message, "Walks");
  EXPECT_GT(talk.count("Walks", "Received"), 0u);
  ASSERT_TRUE(talk.until([&] { return talk.robot.value<int>("Numbers", "Walks") > 0; }));
  std::vector<armature::msg::dds_::Walk_> wrong(3, message);
  wrong[0].begin().x(std::nan(""));
  wrong[1].way(2);
  wrong[2].numbers({1.0});
  const std::uint64_t received = talk.count("Walks", "Received");
  for (const auto& each : wrong) {
    const std::uint64_t refused = talk.count("Walks", "Refused");
    talk.send(writer, each, "Walks");
    EXPECT_GT(talk.count("Walks", "Refused"), refused);
  }
  EXPECT_EQ(talk.count("Walks", "Received"), received);
}

// --- the check -----------------------------------------------------------------------------------

TEST(Checked, WhatComesFromRosIsNoEffort) {
  const auto direct = deployment(std::string(kNumbers) +
                                 "ros: Walks:\n    model: TopicToPort\n    properties: {port: "
                                 "Numbers.Voltage, topic: volts}\n");
  EXPECT_THAT(direct.diagnostics.to_text(),
              HasSubstr("what comes from ROS 2 leads to the effort 'Numbers.Voltage'"));
}

TEST(Checked, AnInterfaceThatOthersReachIsWarnedOf) {
  const auto open = deployment("", "", "eth0");
  EXPECT_TRUE(open.ok());
  EXPECT_THAT(open.diagnostics.to_text(),
              HasSubstr("opens it to other machines, and DDS proves nobody's identity"));
  EXPECT_EQ(deployment("").diagnostics.to_text(), "");
}

TEST(Checked, AnApplicationIsOneNode) {
  const auto two = deployment("Other: {model: RosNode, activity: {periodic: 2 ms}}\n");
  EXPECT_THAT(two.diagnostics.to_text(),
              HasSubstr("is a RosNode, too, and an application is one node"));
}

TEST(Checked, NamesOfJointsAreHeldAgainstTheirNumber) {
  const auto wrong = deployment(std::string(kNumbers) +
                                    "ros: JointStates:\n    model: JointStates\n    properties: "
                                    "{joints: 2, joint_names: [pan]}\n",
                                "  - Numbers.Position -> JointStates.Position\n");
  EXPECT_THAT(wrong.diagnostics.to_text(),
              HasSubstr("joint_names has 1 names, expected joints = 2"));
}

TEST(Checked, AThreadThatOthersShareIsRefused) {
  testing::DeployedRobot robot(deployment(
      "Numbers: {model: Numbers, activity: {periodic: 2 ms, scheduler: other, thread: ros}}\n"
      "ros: Twist:\n    model: Twist\n"));
  EXPECT_THAT(robot.start(), HasSubstr("it works with DDS in the thread of 'Numbers'"));
}

}  // namespace
}  // namespace armature::ros2
