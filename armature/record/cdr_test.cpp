// SPDX-License-Identifier: Apache-2.0
#include "armature/record/cdr.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/record/internal/test_types.hpp"
#include "armature/record/json.hpp"
#include "armature/record/ros_types.hpp"

namespace armature::record {
namespace {

using ::testing::HasSubstr;
using types::type_of;

template <typename T>
std::string cdr_of(const T& value) {
  return to_cdr(type_of<T>(), &value);
}

template <typename T>
std::string read_back(const T& value) {
  const auto json = json_of_cdr(types::layout_text(type_of<T>()), cdr_of(value));
  EXPECT_TRUE(json.ok()) << json.error();
  return json ? json.value() : "";
}

const std::string kHead("\x00\x01\x00\x00", 4);

TEST(Cdr, NumbersAreAlignedToTheirSizeBehindTheHead) {
  // In ROS 2's own form: a time is two numbers of four bytes, a header a text behind it.
  EXPECT_EQ(cdr_of(ros::Header{{1, 2}, "ab"}),
            kHead + std::string("\x01\0\0\0\x02\0\0\0\x03\0\0\0ab\0", 15));
  // A byte, seven of padding, and a number of eight.
  EXPECT_EQ(cdr_of(std::vector<double>{}), kHead + std::string(4, '\0'));
  const std::string one = cdr_of(std::vector<double>{1.0});
  EXPECT_EQ(one, kHead + std::string("\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\xf0\x3f", 16));
}

TEST(Cdr, EveryTypeIsReadBackAsTheJsonThatRecordingsHave) {
  const types::Everything everything = types::make_everything();
  EXPECT_EQ(read_back(everything), to_json(type_of<types::Everything>(), &everything));
  const std::array<double, 3> odd{std::nan(""), std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
  EXPECT_EQ(read_back(odd), R"({"value":[null,1e999,-1e999]})");
  EXPECT_EQ(read_back(Gait::kTurningOnTheSpot), R"({"value":"turning_on_the_spot"})");
  EXPECT_EQ(read_back(std::string("a\nb")), R"({"value":"a\u000ab"})");
  EXPECT_EQ(read_back(std::vector<Pose>{{1, 2}}), R"({"value":[{"x":1,"y":2}]})");
}

TEST(Cdr, WhatIsDamagedIsRefusedAndSaysWhere) {
  const std::string layout = types::layout_text(type_of<ros::Header>());
  const std::string whole = cdr_of(ros::Header{{1, 2}, "ab"});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(json_of_cdr(layout, whole.substr(0, size)).ok()) << size;
  }
  EXPECT_THAT(json_of_cdr(layout, whole + "x").error(), HasSubstr("expected the end at byte 19"));
  std::string endless = whole;
  endless[12] = '\xff';
  EXPECT_THAT(json_of_cdr(layout, endless).error(), HasSubstr("a text that ends with 0"));
  EXPECT_THAT(json_of_cdr("vector<double>", kHead + std::string(4, '\xff')).error(),
              HasSubstr("a list that fits"));
  for (const char* const bad : {"", "Pose{", "Pose{x}", "vector<", "array<double>", "Mode:{}",
                                "Mode:uint8{off}", "unknown", "double}"}) {
    EXPECT_THAT(json_of_cdr(bad, whole).error(), HasSubstr("is no layout")) << bad;
  }
}

TEST(Ros2Definition, ScalarsAreMessagesThatRosHas) {
  EXPECT_EQ(ros2_name(type_of<double>()), "std_msgs/msg/Float64");
  EXPECT_EQ(ros2_name(type_of<std::uint16_t>()), "std_msgs/msg/UInt16");
  EXPECT_EQ(ros2_name(type_of<bool>()), "std_msgs/msg/Bool");
  EXPECT_EQ(ros2_name(type_of<std::string>()), "std_msgs/msg/String");
  EXPECT_EQ(ros2_definition(type_of<double>()), "float64 data\n");
  EXPECT_EQ(ros2_name(type_of<std::vector<float>>()), "armature_msgs/msg/Float32List");
  EXPECT_EQ(ros2_definition(type_of<std::vector<float>>()), "float32[] data\n");
}

TEST(Ros2Definition, MessagesWithinMessagesAreBehindThem) {
  const std::string line(80, '=');
  EXPECT_EQ(ros2_name(type_of<ros::JointState>()), "sensor_msgs/msg/JointState");
  EXPECT_EQ(ros2_definition(type_of<ros::JointState>()),
            "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
            "float64[] effort\n" +
                line + "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" +
                line + "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
}

TEST(Ros2Definition, ListsOfListsAreListsOfMessagesAndEnumeratorsAreConstants) {
  const std::string text = ros2_definition(type_of<types::Everything>());
  EXPECT_THAT(text, HasSubstr("GAIT_TURNING_ON_THE_SPOT="));
  EXPECT_THAT(text, HasSubstr("armature_msgs/UInt16List[2] tables\n"));
  EXPECT_THAT(text, HasSubstr("MSG: armature_msgs/UInt16List\nuint16[] data\n"));
}

}  // namespace
}  // namespace armature::record
