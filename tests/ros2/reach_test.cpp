// SPDX-License-Identifier: Apache-2.0
// What the check says of the way of what comes from ROS 2.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "talk.hpp"

namespace armature::ros2 {
namespace {

using ::testing::HasSubstr;

const std::string kToRelay =
    "ros: Number:\n    model: TopicToPort\n    properties: {port: Relay.In, topic: number}\n";
constexpr const char* kLeadsToVolts = "what comes from ROS 2 leads to the effort 'Numbers.Voltage'";
constexpr const char* kNotTold = "it is not told when the operator arms or stops the robot";

std::string model(const std::string& name, const std::string& more = "") {
  return name + ": {model: " + name + ", activity: {triggered: true}" + more + "}\n";
}
std::string said_of(const std::string& components, const std::string& connections) {
  return deployment(kNumbers + components, connections).diagnostics.to_text();
}

TEST(Reach, CommandsThatAreNoMotionsKeepNoLimits) {
  EXPECT_THAT(said_of(model("Relay") + model("Amplifier") + kToRelay,
                      "  - Relay.Out -> Amplifier.In\n  - Amplifier.Out -> Numbers.Voltage\n"),
              HasSubstr(kLeadsToVolts));
}

TEST(Reach, EventsAreFollowed) {
  EXPECT_THAT(said_of(model("Relay") + model("Amplifier", ", peers: [Relay]") + kToRelay,
                      "  - Amplifier.Out -> Numbers.Voltage\n"),
              HasSubstr(kLeadsToVolts));
}

TEST(Reach, AJointKeepsNoLimitsAlthoughTheOperatorMayHaveItHome) {
  EXPECT_THAT(
      said_of(model("Axis") + "ros: Wanted:\n    model: TopicToPort\n    properties: {port: "
                              "Axis.Wanted, topic: wanted}\n",
              "  - Axis.Volts -> Numbers.Voltage\n"),
      HasSubstr(kLeadsToVolts));
}

/// A topic that says the speed of a chassis.
std::string drives(const std::string& peers_of_base, const std::string& peers) {
  return said_of(
      "Operator: {model: Operator, activity: {periodic: 2 ms}}\n"
      "Other: {model: Operator, activity: {periodic: 2 ms}}\n" +
          model("Base", ", peers: [" + peers_of_base + "]") +
          "ros: Speed:\n    model: TopicToPort\n    peers: [" + peers +
          "]\n    properties: {port: Base.Speed, topic: speed}\n",
      "  - Base.Volts -> Numbers.Voltage\n");
}

TEST(Reach, WhoeverCommandsAMotionIsToldOfItsOperator) {
  EXPECT_EQ(drives("Operator", "Operator"), "");
  EXPECT_THAT(drives("Operator", ""), HasSubstr(kNotTold));
  EXPECT_THAT(drives("Operator", "Other"),
              HasSubstr("it commands 'Base', which 'Operator' stops, and is told of 'Other'"));
  EXPECT_THAT(drives("", "Operator"), HasSubstr(kLeadsToVolts))
      << "nobody brakes it at the operator's stop";
}

TEST(Reach, AnInputHasOneTopic) {
  EXPECT_THAT(said_of(model("Relay") + kToRelay +
                          "ros: Second:\n    model: TopicToPort\n    properties: {port: Relay.In, "
                          "topic: other}\n",
                      ""),
              HasSubstr("'Relay.In' is written by 'Number' already"));
}

}  // namespace
}  // namespace armature::ros2
