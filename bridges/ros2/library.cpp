// SPDX-License-Identifier: Apache-2.0
// The component library `ros2`: an application as a node of ROS 2, on Cyclone DDS.
#include "armature/component/registry.hpp"
#include "bridges/ros2/clock.hpp"
#include "bridges/ros2/diagnostics.hpp"
#include "bridges/ros2/float64_multi_array.hpp"
#include "bridges/ros2/image.hpp"
#include "bridges/ros2/joint_states.hpp"
#include "bridges/ros2/joint_trajectory.hpp"
#include "bridges/ros2/joy.hpp"
#include "bridges/ros2/node.hpp"
#include "bridges/ros2/port_to_topic.hpp"
#include "bridges/ros2/robot_description.hpp"
#include "bridges/ros2/tf.hpp"
#include "bridges/ros2/topic_to_port.hpp"
#include "bridges/ros2/twist.hpp"

using namespace armature::ros2;
using armature::component::Granularity;

ARMATURE_COMPONENT_LIBRARY(ros2, registry) {
  registry.add<RosNode>("RosNode", "the application as a node of ROS 2: name, domain, network",
                        Granularity::kAtomic);
  registry.add<JointStates>("JointStates", "where the joints are: sensor_msgs/JointState");
  registry.add<RobotDescription>("RobotDescription", "the robot's description: std_msgs/String");
  registry.add<Clock>("Clock", "the simulated time: rosgraph_msgs/Clock");
  registry.add<Tf>("Tf", "where a frame is: tf2_msgs/TFMessage");
  registry.add<Diagnostics>("Diagnostics",
                            "the state of each component: diagnostic_msgs/DiagnosticArray");
  registry.add<Image>("Image", "images of a camera: sensor_msgs/CompressedImage");
  registry.add<PortToTopic>("PortToTopic", "any output port as a topic of its own");
  registry.add<TopicToPort>("TopicToPort", "a topic of its own for an input that may stay open",
                            Granularity::kApplication);
  registry.add<JointTrajectory>("JointTrajectory",
                                "moves the robot: trajectory_msgs/JointTrajectory",
                                Granularity::kApplication);
  registry.add<Twist>("Twist", "speeds that are asked for: geometry_msgs/Twist",
                      Granularity::kApplication);
  registry.add<Joy>("Joy", "what a joystick says: sensor_msgs/Joy", Granularity::kApplication);
  registry.add<Float64MultiArray>("Float64MultiArray", "numbers: std_msgs/Float64MultiArray",
                                  Granularity::kApplication);
}
