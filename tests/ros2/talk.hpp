// SPDX-License-Identifier: Apache-2.0
#pragma once

// An application with components of the library ros2, and Fast DDS on the other side.

#include <cstdint>
#include <functional>
#include <sstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "armature/testing/deployed_robot.hpp"
#include "fast_peer.hpp"
#include "models.hpp"

namespace armature::ros2 {

using namespace std::chrono_literals;

inline constexpr int kDomain = 63;

/// A node with components, each on a line as in a deployment; those of ROS 2 begin with `ros: `.
inline deploy::Deployment deployment(const std::string& components,
                                     const std::string& connections = "",
                                     const std::string& interface = "lo") {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.models = [](component::Registry& registry) {
    registry.add<Numbers>("Numbers", "ports of a test");
    registry.add<Operator>("Operator", "arms and stops");
    registry.add<Amplifier>("Amplifier", "makes voltages");
    registry.add<Relay>("Relay", "passes on");
    registry.add<Base>("Base", "drives");
    registry.add<Axis>("Axis", "homes");
    registry.add<Player>("Player", "plays paths");
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

inline constexpr const char* kNumbers = "Numbers: {model: Numbers, activity: {periodic: 2 ms}}\n";

/// An application in simulated time, and a peer; both go on while one waits for the other.
class Talk {
 public:
  explicit Talk(deploy::Deployment deployment) : robot(std::move(deployment)) {
    EXPECT_EQ(robot.start(), "");
    robot.run_for(20ms);
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

  /// @param header  is stamped between `begin` and now, in simulated time
  void expect_stamped_since(base::Time begin, const std_msgs::msg::dds_::Header_& header) {
    const base::Time stamp(std::chrono::seconds(header.stamp().sec()) +
                           std::chrono::nanoseconds(header.stamp().nanosec()));
    EXPECT_GE(stamp, begin);
    EXPECT_LE(stamp, robot.application().now());
  }
  /// What is written from now on has no stamp before that.
  base::Time last_cycle() { return robot.application().now() - 2ms; }

  FastPeer peer{kDomain};
  testing::DeployedRobot robot;
};

}  // namespace armature::ros2
