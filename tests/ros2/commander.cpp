// SPDX-License-Identifier: Apache-2.0
// A program with Fast DDS that commands a robot, ten times a second, until it is killed:
//   ros2_commander DOMAIN joint_trajectory JOINTS TARGET TIME_S    all joints to one position
//   ros2_commander DOMAIN joint_trajectory JOINTS TARGET TIME_S stop   from SIGTERM on it asks for
//     a stop instead, with a stamp before that of the trajectory
//   ros2_commander DOMAIN cmd_vel FORWARD_M_S TURN_RAD_S
//   ros2_commander DOMAIN listen TOPIC    reads joint states, until SIGTERM; prints how many
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "fast_peer.hpp"

namespace {

using namespace armature::ros2;

trajectory_msgs::msg::dds_::JointTrajectory_ trajectory_to(int joints, double target,
                                                           double time_s) {
  trajectory_msgs::msg::dds_::JointTrajectory_ message;
  for (int i = 1; i <= joints; ++i) message.joint_names().push_back("joint" + std::to_string(i));
  trajectory_msgs::msg::dds_::JointTrajectoryPoint_ point;
  point.positions(std::vector<double>(static_cast<std::size_t>(joints), target));
  point.time_from_start().sec(static_cast<std::int32_t>(time_s));
  message.points({point});
  return message;
}

geometry_msgs::msg::dds_::Twist_ twist_of(double forward, double turn) {
  geometry_msgs::msg::dds_::Twist_ message;
  message.linear().x(forward);
  message.angular().z(turn);
  return message;
}

volatile std::sig_atomic_t ended = 0;

template <typename Message>
void send(fast::DataWriter& writer, Message message) {
  writer.write(&message);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

template <typename Message>
void send_for_ever(fast::DataWriter& writer, const Message& message) {
  while (true) send(writer, message);
}

void send_trajectory(fast::DataWriter& writer, trajectory_msgs::msg::dds_::JointTrajectory_ message,
                     bool stops) {
  if (!stops) return send_for_ever(writer, message);
  message.header().stamp().sec(1);
  while (ended == 0) send(writer, message);
  trajectory_msgs::msg::dds_::JointTrajectory_ stop;
  stop.header().stamp().nanosec(500'000'000);
  send_for_ever(writer, stop);
}

int listen(FastPeer& peer, const std::string& topic) {
  auto* const reader = peer.read_from<sensor_msgs::msg::dds_::JointState_PubSubType>(topic);
  std::size_t count = 0;
  sensor_msgs::msg::dds_::JointState_ message;
  while (ended == 0) {
    while (take(*reader, message)) ++count;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::cout << count << std::endl;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 3) return 2;
  const bool told_to_end = words[1] == "listen" || words.back() == "stop";
  if (told_to_end) std::signal(SIGTERM, [](int) { ended = 1; });
  FastPeer peer(std::stoi(words[0]));
  if (words[1] == "listen") return listen(peer, words[2]);
  if (words[1] == "cmd_vel") {
    send_for_ever(*peer.write_to<geometry_msgs::msg::dds_::Twist_PubSubType>("rt/cmd_vel"),
                  twist_of(std::stod(words[2]), std::stod(words.at(3))));
  }
  send_trajectory(
      *peer.write_to<trajectory_msgs::msg::dds_::JointTrajectory_PubSubType>("rt/joint_trajectory"),
      trajectory_to(std::stoi(words[2]), std::stod(words.at(3)), std::stod(words.at(4))),
      words.size() > 5);
}
