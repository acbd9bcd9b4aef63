// SPDX-License-Identifier: Apache-2.0
// The component library `ros2`: an application as a node of ROS 2, on Cyclone DDS.
#include "armature/component/registry.hpp"
#include "bridges/ros2/joint_states.hpp"
#include "bridges/ros2/node.hpp"

using namespace armature::ros2;

ARMATURE_COMPONENT_LIBRARY(ros2, registry) {
  registry.add<RosNode>("RosNode", "the application as a node of ROS 2: name, domain, network");
  registry.add<JointStates>("JointStates", "where the joints are: sensor_msgs/JointState");
}
