// SPDX-License-Identifier: Apache-2.0
// The IDL from which both sides of the other tests are made, against the definitions of ROS 2
// Humble as they are published: https://github.com/ros2/rcl_interfaces, common_interfaces,
// geometry2 and rmw_dds_common, branch humble, PACKAGE/msg/NAME.msg.
#include <fstream>
#include <map>
#include <regex>
#include <string>

#include <gtest/gtest.h>

namespace armature::ros2 {
namespace {

/// {package/Name: its fields in order, each with a ; behind it}
using Messages = std::map<std::string, std::string>;

// Field by field, types of the same package with its name. Not of all was the .msg file at hand:
// Header, JointState, DiagnosticArray, Vector3 and some others are as second sources and their
// users have them.
const Messages kHumble{
    {"builtin_interfaces/Time", "int32 sec; uint32 nanosec; "},
    {"builtin_interfaces/Duration", "int32 sec; uint32 nanosec; "},
    {"std_msgs/Header", "builtin_interfaces/Time stamp; string frame_id; "},
    {"std_msgs/String", "string data; "},
    {"std_msgs/MultiArrayDimension", "string label; uint32 size; uint32 stride; "},
    {"std_msgs/MultiArrayLayout", "std_msgs/MultiArrayDimension[] dim; uint32 data_offset; "},
    {"std_msgs/Float64MultiArray", "std_msgs/MultiArrayLayout layout; float64[] data; "},
    {"geometry_msgs/Vector3", "float64 x; float64 y; float64 z; "},
    {"geometry_msgs/Quaternion", "float64 x; float64 y; float64 z; float64 w; "},
    {"geometry_msgs/Transform",
     "geometry_msgs/Vector3 translation; geometry_msgs/Quaternion rotation; "},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header; string child_frame_id; geometry_msgs/Transform transform; "},
    {"geometry_msgs/Twist", "geometry_msgs/Vector3 linear; geometry_msgs/Vector3 angular; "},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms; "},
    {"rosgraph_msgs/Clock", "builtin_interfaces/Time clock; "},
    {"sensor_msgs/JointState",
     "std_msgs/Header header; string[] name; float64[] position; float64[] velocity; "
     "float64[] effort; "},
    {"sensor_msgs/Joy", "std_msgs/Header header; float32[] axes; int32[] buttons; "},
    {"sensor_msgs/CompressedImage", "std_msgs/Header header; string format; uint8[] data; "},
    {"trajectory_msgs/JointTrajectoryPoint",
     "float64[] positions; float64[] velocities; float64[] accelerations; float64[] effort; "
     "builtin_interfaces/Duration time_from_start; "},
    {"trajectory_msgs/JointTrajectory",
     "std_msgs/Header header; string[] joint_names; "
     "trajectory_msgs/JointTrajectoryPoint[] points; "},
    {"diagnostic_msgs/KeyValue", "string key; string value; "},
    {"diagnostic_msgs/DiagnosticStatus",
     "byte level; string name; string message; string hardware_id; "
     "diagnostic_msgs/KeyValue[] values; "},
    {"diagnostic_msgs/DiagnosticArray",
     "std_msgs/Header header; diagnostic_msgs/DiagnosticStatus[] status; "},
    {"rmw_dds_common/Gid", "char[24] data; "},
    {"rmw_dds_common/NodeEntitiesInfo",
     "string<=256 node_namespace; string<=256 node_name; rmw_dds_common/Gid[] reader_gid_seq; "
     "rmw_dds_common/Gid[] writer_gid_seq; "},
    {"rmw_dds_common/ParticipantEntitiesInfo",
     "rmw_dds_common/Gid gid; rmw_dds_common/NodeEntitiesInfo[] node_entities_info_seq; "},
};

/// As a field of a .msg file is written.
std::string field_of(std::string type, const std::string& name, const std::string& count) {
  const auto replace = [&](const char* from, const char* to) {
    type = std::regex_replace(type, std::regex(from), to);
  };
  replace("(\\w+)::msg::dds_::(\\w+)_", "$1/$2");
  replace("string<(\\d+)>", "string<=$1");
  replace("sequence<(.+)>", "$1[]");
  replace("double", "float64");
  replace("float\\b", "float32");
  return type + count + " " + name + "; ";
}

Messages messages_of(const std::string& path) {
  Messages found;
  std::string package;
  std::string message;
  std::smatch part;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (std::regex_match(line, part,
                         std::regex("module (\\w+) \\{ module msg \\{ module dds_ \\{"))) {
      package = part[1];
    } else if (std::regex_match(line, part, std::regex(" +struct (\\w+)_ \\{"))) {
      message = package + "/" + part[1].str();
    } else if (std::regex_match(line, part, std::regex(" +(\\S+) (\\w+)(\\[\\d+\\])?;"))) {
      found[message] += field_of(part[1], part[2], part[3]);
    } else {
      EXPECT_TRUE(std::regex_match(line, std::regex("(//.*| *\\};|\\}; \\}; \\};|)"))) << line;
    }
  }
  return found;
}

/// On the wire `byte`, `char` and `uint8` are an octet.
std::string with_octets(const std::string& fields) {
  return std::regex_replace(fields, std::regex("\\b(byte|char|uint8)\\b"), "octet");
}

TEST(Idl, HasTheFieldsOfRos2HumbleInTheirOrder) {
  Messages ours = messages_of(IDL);
  for (const auto& [name, fields] : kHumble) EXPECT_EQ(ours[name], with_octets(fields)) << name;
  EXPECT_EQ(ours.size(), kHumble.size()) << "a message is not held against its definition";
}

}  // namespace
}  // namespace armature::ros2
