// SPDX-License-Identifier: Apache-2.0
// What Fast DDS writes, as the components of the library ros2 obey or refuse it.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "talk.hpp"

namespace armature::ros2 {
namespace {

using ::testing::ElementsAre;

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
      deployment("Operator: {model: Operator, activity: {periodic: 2 ms}}\nros: Twist:\n    model: "
                 "Twist\n    peers: [Operator]\n    properties: {max_linear: 0.6, max_angular: "
                 "2.0, track: 0.5}\n"));
  EXPECT_EQ(talk.robot.call("Operator", "arm"), "");
  talk.robot.run_for(600ms);
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

TEST(In, WhoIsThereWhenTheOperatorArmsOrStopsIsNotHeardAnyMore) {
  using TwistType = geometry_msgs::msg::dds_::Twist_PubSubType;
  Talk talk(
      deployment("Operator: {model: Operator, activity: {periodic: 2 ms}}\n"
                 "ros: Twist:\n    model: Twist\n    peers: [Operator]\n    properties: "
                 "{max_silence: 4 s}\n"));
  talk.robot.run_for(5s);
  const auto expect_refused = [&](fast::DataWriter& writer) {
    const std::uint64_t received = talk.count("Twist", "Received");
    const std::uint64_t refused = talk.count("Twist", "Refused");
    talk.send(writer, twist(0.5, 1.0), "Twist");
    EXPECT_GT(talk.count("Twist", "Refused"), refused);
    EXPECT_EQ(talk.count("Twist", "Received"), received);
  };
  auto* quiet = talk.peer.write_to<TwistType>("rt/cmd_vel");
  auto* sends = talk.peer.write_to<TwistType>("rt/cmd_vel");
  expect_refused(*sends);  // nobody has armed it; DDS told of the quiet one before
  for (const char* act : {"arm", "stop"}) {
    EXPECT_EQ(talk.robot.call("Operator", act), "");
    talk.robot.run_for(4ms);
    // Who comes within max_silence, while the robot's time stands still.
    auto& early = *talk.peer.write_to<TwistType>("rt/cmd_vel");
    auto message = twist(0.5, 1.0);
    ASSERT_TRUE(wait_until([&] {
      early.write(&message);
      return is_matched(early) && early.wait_for_acknowledgments({0, 20'000'000}) ==
                                      eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
    }));
    talk.robot.run_for(4ms);
    // However long they are silent in between, as a program that sends once a second is.
    talk.robot.run_for(5s);
    for (auto* each : {sends, quiet, &early}) expect_refused(*each);
    quiet = talk.peer.write_to<TwistType>("rt/cmd_vel");
    sends = talk.peer.write_to<TwistType>("rt/cmd_vel");
    const std::uint64_t received = talk.count("Twist", "Received");
    talk.send(*sends, twist(0.25, 1.0), "Twist");
    EXPECT_GT(talk.count("Twist", "Received"), received) << "who began since is heard";
  }
  EXPECT_EQ(talk.robot.call("Operator", "disarm"), "");
  talk.robot.run_for(5s);
  expect_refused(*talk.peer.write_to<TwistType>("rt/cmd_vel"));
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
  wrong[0].axes({0.1f, 0.1f});
  wrong[0].header().stamp().sec(4);  // within max_silence
  wrong[1].axes({0.1f});
  wrong[2].buttons({0, 0});
  wrong[3].axes({0.1f, 1.5f});
  for (const auto& each : wrong) {
    const std::uint64_t refused = talk.count("Joy", "Refused");
    talk.send(joys, each, "Joy");
    EXPECT_GT(talk.count("Joy", "Refused"), refused);
  }
  EXPECT_THAT(talk.robot.value<std::vector<double>>("Joy", "Axes"), ElementsAre(0.5, -1.0));
  // Behind a silence another one may send, whose clock has another time.
  talk.robot.run_for(600ms);
  auto& other = *talk.peer.write_to<sensor_msgs::msg::dds_::Joy_PubSubType>("rt/joy");
  joy.header().stamp().sec(3);
  joy.axes({0.25f, 0.5f});
  talk.send(other, joy, "Joy");
  EXPECT_THAT(talk.robot.value<std::vector<double>>("Joy", "Axes"), ElementsAre(0.25, 0.5));

  auto& arrays =
      *talk.peer.write_to<std_msgs::msg::dds_::Float64MultiArray_PubSubType>("rt/wanted");
  std_msgs::msg::dds_::Float64MultiArray_ array;
  array.data({-1.0, 2.0});
  array.layout().dim().resize(1);  // which is for people
  array.layout().dim()[0].label("joints");
  talk.send(arrays, array, "Numbers");
  EXPECT_THAT(talk.robot.value<std::vector<double>>("Numbers", "Data"), ElementsAre(-1.0, 2.0));
  for (const std::vector<double>& each :
       {std::vector<double>{0.0}, {0.0, 2.1}, {-1.1, 0.0}, {0.0, std::nan("")}}) {
    const std::uint64_t refused = talk.count("Numbers", "Refused");
    array.data(each);
    talk.send(arrays, array, "Numbers");
    EXPECT_GT(talk.count("Numbers", "Refused"), refused);
  }
  array.data({0.0, 0.0});
  array.layout().data_offset(1);
  const std::uint64_t refused = talk.count("Numbers", "Refused");
  talk.send(arrays, array, "Numbers");
  EXPECT_GT(talk.count("Numbers", "Refused"), refused);
  EXPECT_THAT(talk.robot.value<std::vector<double>>("Numbers", "Data"), ElementsAre(-1.0, 2.0));
}

using trajectory_msgs::msg::dds_::JointTrajectory_;

/// Of two joints, through two points.
JointTrajectory_ trajectory() {
  JointTrajectory_ message;
  message.joint_names({"pan", "tilt"});
  message.points().resize(2);
  message.points()[0].positions({0.1, 0.1});
  message.points()[0].velocities({0.1, 0.1});
  message.points()[0].accelerations({0.0, 0.0});
  message.points()[0].time_from_start().nanosec(900'000'000);
  message.points()[1] = message.points()[0];
  message.points()[1].positions({0.2, 0.2});
  message.points()[1].velocities({0.0, 0.0});
  message.points()[1].time_from_start().sec(2);
  message.points()[1].time_from_start().nanosec(0);
  return message;
}

/// An application that plays trajectories for a Player; armed, and ready to hear.
struct Plays : Talk {
  Plays()
      : Talk(deployment(
            "Operator: {model: Operator, activity: {periodic: 2 ms}}\n"
            "Player: {model: Player, activity: {periodic: 2 ms}, peers: [Operator]}\n"
            "ros: Trajectory:\n    model: JointTrajectory\n    peers: [Operator, Player]\n"
            "    properties: {joints: 2, joint_names: [pan, tilt]}\n",
            "  - Player.nAxesDesiredPosition -> Trajectory.nAxesDesiredPosition\n")) {
    EXPECT_EQ(robot.call("Operator", "arm"), "");
    robot.run_for(600ms);
    writer = peer.write_to<trajectory_msgs::msg::dds_::JointTrajectory_PubSubType>(
        "rt/joint_trajectory");
  }
  bool obeys(const JointTrajectory_& message) {
    const std::uint64_t refused = count("Trajectory", "Refused");
    send(*writer, message, "Trajectory");
    return count("Trajectory", "Refused") == refused;
  }
  /// As a header has it.
  builtin_interfaces::msg::dds_::Time_ now_and(base::Duration more) {
    const std::int64_t ns = base::to_ns(robot.application().now()) + more.count();
    builtin_interfaces::msg::dds_::Time_ stamp;
    stamp.sec(static_cast<std::int32_t>(ns / 1'000'000'000));
    stamp.nanosec(static_cast<std::uint32_t>(ns % 1'000'000'000));
    return stamp;
  }

  fast::DataWriter* writer = nullptr;
};

TEST(In, EachFieldOfATrajectoryIsTheOneThatItsNameSays) {
  Plays plays;
  const auto expect_refused = [&](const char* why, const auto& spoil) {
    JointTrajectory_ message = trajectory();
    spoil(message.points()[1]);
    EXPECT_FALSE(plays.obeys(message)) << why;
    EXPECT_THAT(plays.robot.log, ::testing::HasSubstr(why));
    EXPECT_TRUE(plays.obeys(JointTrajectory_())) << "a stop, with which a series of refusals ends";
  };
  expect_refused("point 2: joint 'tilt' is to be at 1.5", [](auto& p) { p.positions({0.0, 1.5}); });
  expect_refused("point 2: 1 velocities", [](auto& p) { p.velocities({0.0}); });
  expect_refused("point 2: 3 accelerations", [](auto& p) { p.accelerations({0.0, 0.0, 0.0}); });
  expect_refused("point 2: efforts", [](auto& p) { p.effort({0.0, 0.0}); });
  expect_refused("point 2: time_from_start is not later", [](auto& p) {
    p.time_from_start().sec(0);
    p.time_from_start().nanosec(899'999'999);
  });
  EXPECT_TRUE(plays.obeys(trajectory())) << plays.robot.log;
}

TEST(In, ATrajectoryOfAnotherTimeIsRefused) {
  Plays plays;
  JointTrajectory_ message = trajectory();
  message.header().stamp(plays.now_and(0s));
  JointTrajectory_ stop;
  stop.header().stamp(plays.now_and(100s));
  EXPECT_TRUE(plays.obeys(stop)) << "a stop is obeyed, whatever its stamp";
  EXPECT_FALSE(plays.obeys(message)) << "it was sent before the stop";
  EXPECT_TRUE(plays.obeys(stop));
  message.header().stamp(plays.now_and(5s));
  EXPECT_FALSE(plays.obeys(message));
  EXPECT_THAT(plays.robot.log, ::testing::HasSubstr("s ahead of the clock"));
  EXPECT_FALSE(plays.robot.value<bool>("Trajectory", "Moves"));
  message.header().stamp(plays.now_and(400ms));
  EXPECT_TRUE(plays.obeys(message)) << plays.robot.log;
  EXPECT_TRUE(plays.until([&] { return plays.robot.value<bool>("Trajectory", "Moves"); }));
  message.header().stamp(plays.now_and(-100ms));
  EXPECT_FALSE(plays.obeys(message));
  EXPECT_THAT(plays.robot.log, ::testing::HasSubstr("its stamp is before that of the one before"));
}

/// Of RTPS, with a submessage that is shorter than any of its kind.
void send_malformed(int times) {
  const std::vector<unsigned char> packet{'R',  'T', 'P', 'S', 2, 1, 1,  0x10, 1,  2,
                                          3,    4,   5,   6,   7, 8, 9,  10,   11, 12,
                                          0x15, 5,   4,   0,   0, 0, 16, 0};
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(7400 + 250 * kDomain + 10);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  for (int k = 0; k < times; ++k) {
    sendto(socket, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to),
           sizeof to);
  }
  close(socket);
}

TEST(In, WhatIsNoMessageAtAllIsCountedAndToldOnceInAWhile) {
  ::testing::internal::CaptureStderr();
  testing::DeployedRobot robot(deployment(""));
  ASSERT_EQ(robot.start(), "");
  send_malformed(100);
  const auto told = [&] { return robot.log.find("DDS had ") != std::string::npos; };
  EXPECT_TRUE(wait_until([&] {
    robot.run_for(20ms);
    return told();
  }));
  EXPECT_THAT(robot.log, ::testing::HasSubstr("complaints, the last: "));
  EXPECT_EQ(robot.log.find("DDS had "), robot.log.rfind("DDS had ")) << robot.log;
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}
}  // namespace
}  // namespace armature::ros2
