// SPDX-License-Identifier: Apache-2.0
// Ports as topics of their own, and what the check says of deployments with ROS 2.
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/types/dds_idl.hpp"
#include "talk.hpp"
#include "walkPubSubTypes.h"

namespace armature::ros2 {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
  message.name("fifteen letters");
  message.matrix()[1][2] = -3;
  return message;
}
armature::msg::dds_::Hike_ hike_message() {
  armature::msg::dds_::Hike_ message;
  message.walk(walk_message());
  message.between().resize(2);
  message.between()[1].x(3.0);
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
  walk.name = std::string_view("fifteen letters");
  walk.matrix[1][2] = -3;
  return walk;
}
Hike hike() {
  Hike hike{walk(), {}, {0.5, 1.5, 2.5}};
  hike.between.resize(2);
  hike.between[1].x = 3.0;
  return hike;
}

template <typename T>
std::string text_of(const T& value) {
  return types::to_text(types::type_of<T>(), &value);
}

TEST(Ports, TheIdlOfFastDdsIsThatOfThePort) {
  const std::array<const types::Type*, 2> types{&types::type_of<Hike>(),
                                                &types::type_of<std::vector<double>>()};
  std::ifstream file(TESTS "/walk.idl");
  EXPECT_EQ(std::string((std::istreambuf_iterator<char>(file)), {}), types::dds_idl(types));
}

TEST(Ports, AnyOutputIsATopicOfItsOwn) {
  Talk talk(deployment(
      std::string(kNumbers) +
      "ros: Hikes:\n    model: PortToTopic\n    properties: {port: Numbers.Hike, topic: hike}\n"
      "ros: Positions:\n    model: PortToTopic\n    properties: {port: Numbers.Position, topic: "
      "positions}\n"));
  auto* const hikes = talk.peer.read_from<armature::msg::dds_::Hike_PubSubType>("rt/hike");
  auto* const positions =
      talk.peer.read_from<armature::msg::dds_::Float64Vector_PubSubType>("rt/positions");
  armature::msg::dds_::Hike_ message;
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Hike", hike());
    return take(*hikes, message);
  }));
  EXPECT_TRUE(message == hike_message());
  armature::msg::dds_::Float64Vector_ vector;
  ASSERT_TRUE(talk.until([&] {
    talk.robot.write("Numbers", "Position", std::vector<double>{1.0, 2.0});
    return take(*positions, vector);
  }));
  EXPECT_THAT(vector.data(), ElementsAre(1.0, 2.0));
}

TEST(Ports, AnInputThatMayStayOpenIsATopicOfItsOwnAndWhatDoesNotFitIsRefused) {
  using Vector = armature::msg::dds_::Float64Vector_;
  Talk talk(deployment(
      std::string(kNumbers) +
      "ros: Walks:\n    model: TopicToPort\n    properties: {port: Numbers.WalkIn, topic: walk}\n"
      "ros: Vectors:\n    model: TopicToPort\n    properties: {port: Numbers.Wanted, topic: "
      "wanted}\n"));
  const auto send = [&](auto& writer, const auto& message, const std::string& to) {
    const std::uint64_t received = talk.count(to, "Received");
    const std::uint64_t refused = talk.count(to, "Refused");
    talk.send(writer, message, to);
    return std::pair(talk.count(to, "Received") > received, talk.count(to, "Refused") > refused);
  };
  const std::pair obeyed(true, false);
  const std::pair refused(false, true);
  auto& walks = *talk.peer.write_to<armature::msg::dds_::Walk_PubSubType>("rt/walk");
  const armature::msg::dds_::Walk_ message = walk_message();
  EXPECT_EQ(send(walks, message, "Walks"), obeyed);
  EXPECT_EQ(text_of(talk.robot.value<Walk>("Numbers", "Walk")), text_of(walk()));
  std::vector<armature::msg::dds_::Walk_> wrong(2, message);
  wrong[0].begin().x(std::nan(""));
  wrong[1].way(2);
  for (const auto& each : wrong) EXPECT_EQ(send(walks, each, "Walks"), refused);

  auto& vectors = *talk.peer.write_to<armature::msg::dds_::Float64Vector_PubSubType>("rt/wanted");
  Vector vector;
  for (const std::vector<double>& each : {std::vector<double>{}, {1.5}, {1.5, -2.5, 3.5}}) {
    vector.data(each);
    EXPECT_EQ(send(vectors, vector, "Vectors"), refused);
  }
  vector.data({1.5, -2.5});
  EXPECT_EQ(send(vectors, vector, "Vectors"), obeyed);
  EXPECT_THAT(talk.robot.value<std::vector<double>>("Numbers", "Position"), ElementsAre(1.5, -2.5));
}

TEST(Checked, AnInputOfVectorsWhoseSizeNobodyDeclaresIsNoTopic) {
  for (const std::string port : {"Any", "HikeIn"}) {
    EXPECT_THAT(
        deployment(kNumbers + ("ros: Topic:\n    model: TopicToPort\n    properties: {port: "
                               "Numbers." +
                               port + ", topic: any}\n"))
            .diagnostics.to_text(),
        HasSubstr("'Numbers." + port +
                  "' takes vectors, and its component does not "
                  "declare their size"));
  }
}

TEST(Checked, WhatComesFromRosIsNoEffort) {
  const auto direct = deployment(std::string(kNumbers) +
                                 "ros: Walks:\n    model: TopicToPort\n    properties: {port: "
                                 "Numbers.Voltage, topic: volts}\n");
  EXPECT_THAT(direct.diagnostics.to_text(),
              HasSubstr("what comes from ROS 2 leads to the effort 'Numbers.Voltage'"));
}

TEST(Checked, WhatBecomesAnEffortOnItsWayIsRefusedToo) {
  const auto by_way = deployment(std::string(kNumbers) +
                                     "Amplifier: {model: Amplifier, activity: {triggered: true}}\n"
                                     "ros: Number:\n    model: TopicToPort\n    properties: {port: "
                                     "Amplifier.In, topic: number}\n",
                                 "  - Amplifier.Out -> Numbers.Voltage\n");
  EXPECT_THAT(by_way.diagnostics.to_text(),
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

TEST(Checked, APlaceIsOfOneComponent) {
  const auto of_two = deployment(std::string(kNumbers) +
                                     "Others: {model: Numbers, activity: {periodic: 2 ms}}\n"
                                     "ros: Odometry:\n    model: Tf\n    properties: {frame_id: "
                                     "odom, child_frame_id: base_link}\n",
                                 "  - Numbers.X -> Odometry.X\n  - Others.X -> Odometry.Y\n");
  EXPECT_THAT(of_two.diagnostics.to_text(),
              HasSubstr("X, Y and Heading come from different components"));
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
      "Operator: {model: Operator, activity: {periodic: 2 ms}}\nros: Twist:\n    model: Twist\n    "
      "peers: [Operator]\n"));
  EXPECT_THAT(robot.start(), HasSubstr("it works with DDS in the thread of 'Numbers'"));
}
}  // namespace
}  // namespace armature::ros2
