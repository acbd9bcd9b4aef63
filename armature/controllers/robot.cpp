// SPDX-License-Identifier: Apache-2.0
// The component library `robot`: the models of which a deployment makes the controller of a robot.
#include "armature/component/registry.hpp"
#include "armature/controllers/actuator_demux/actuator_demux.hpp"
#include "armature/controllers/arming/arming.hpp"
#include "armature/controllers/axes_generator/axes_generator.hpp"
#include "armature/controllers/axes_generator/axes_generator_online.hpp"
#include "armature/controllers/bridge/bridge.hpp"
#include "armature/controllers/bridge_ref/bridge_ref.hpp"
#include "armature/controllers/cartesian/path_planner.hpp"
#include "armature/controllers/computed_torque/controller_computed_torque.hpp"
#include "armature/controllers/controller_following/controller_position.hpp"
#include "armature/controllers/controller_following/controller_velocity.hpp"
#include "armature/controllers/controller_npid/controller_npid.hpp"
#include "armature/controllers/controller_npid_ff/controller_npid_ff.hpp"
#include "armature/controllers/forward_kinematics/forward_kinematics.hpp"
#include "armature/controllers/gravity_pd/controller_gravity_pd.hpp"
#include "armature/controllers/joint/joint.hpp"
#include "armature/controllers/model/model.hpp"
#include "armature/controllers/pid/pid.hpp"
#include "armature/controllers/reference/reference.hpp"
#include "armature/controllers/robot_model/robot_model.hpp"
#include "armature/controllers/sampler/sampler.hpp"
#include "armature/controllers/sensor_mux/sensor_mux.hpp"
#include "armature/controllers/teach/axes_generator_taught.hpp"
#include "armature/controllers/teach/teacher.hpp"
#include "armature/controllers/velocity_pid/velocity_pid.hpp"

using namespace armature::controllers;

ARMATURE_COMPONENT_LIBRARY(robot, registry) {
  registry.add<Sampler>("Sampler", "begins each sampling period");
  registry.add<Arming>("Arming", "lets the joints move, at the operator's word");
  registry.add<Joint>("Joint", "a joint, with the limiter before its hardware");
  registry.add<JointOf<JointCommand::kCurrent>>(
      "CurrentJoint", "a joint whose drive is given currents, with the limiter before it");
  registry.add<JointOf<JointCommand::kTorque>>(
      "TorqueJoint", "a joint whose drive is given torques, with the limiter before it");
  registry.add<JointOf<JointCommand::kVelocity>>(
      "VelocityJoint", "a joint whose drive follows velocities, with the limiter before it");
  registry.add<JointOf<JointCommand::kPosition>>(
      "PositionJoint", "a joint whose drive follows positions, with the limiter before it");
  registry.add<SensorNMux>("SensorNMux", "makes one vector of what N joints measured",
                           {{"Sensor#Mux", "joints"}});
  registry.add<ActuatorNDemux>("ActuatorNDemux", "hands control signals out to N joints",
                               {{"Actuator#Demux", "joints"}});
  registry.add<ActuatorNDemuxOf<JointCommand::kCurrent>>(
      "CurrentNDemux", "hands currents out to N joints", {{"Current#Demux", "joints"}});
  registry.add<ActuatorNDemuxOf<JointCommand::kTorque>>(
      "TorqueNDemux", "hands torques out to N joints", {{"Torque#Demux", "joints"}});
  registry.add<ActuatorNDemuxOf<JointCommand::kVelocity>>(
      "VelocityNDemux", "hands velocities out to N joints", {{"Velocity#Demux", "joints"}});
  registry.add<ActuatorNDemuxOf<JointCommand::kPosition>>(
      "PositionNDemux", "hands positions out to N joints", {{"Position#Demux", "joints"}});
  registry.add<Pid>("PID", "the controller of one joint");
  registry.add<VelocityPid>("VelocityPID", "the controller of one joint that follows a velocity");
  registry.add<ControllerNPID>("ControllerNPID", "an independent PID for each of N joints",
                               {{"Controller#PID", "joints"}});
  registry.add<ControllerNPIDFF>("ControllerNPIDFF",
                                 "N PIDs and feed-forward of the robot's dynamics",
                                 {{"Controller#PIDFF", "joints"}});
  registry.add<ControllerNPosition>("ControllerNPosition",
                                    "for N drives that follow positions by themselves",
                                    {{"Controller#Position", "joints"}});
  registry.add<ControllerNVelocity>("ControllerNVelocity",
                                    "for N drives that follow velocities by themselves",
                                    {{"Controller#Velocity", "joints"}});
  registry.add<ControllerComputedTorque>("ControllerComputedTorque",
                                         "torques by the robot's dynamics, as it moves now");
  registry.add<ControllerGravityPD>("ControllerGravityPD",
                                    "compensation of gravity, and N PD controllers");
  registry.add<Model>("Model", "inverse dynamics, from the robot's description");
  registry.add<ForwardKinematics>("ForwardKinematics",
                                  "the pose of the tool, from the robot's description");
  registry.add<RobotModel>("Robot", "what a robot weighs and its drives give, for the check");
  registry.add<Bridge>("Bridge", "between a generator and joints with controllers of their own");
  registry.add<BridgeRef>("BridgeRef", "between a generator's vectors and a controller's");
  registry.add<AxesGeneratorPos>("nAxesGeneratorPos", "moves N axes from rest to rest",
                                 {{"nAxisGenPos"}, {"nAxesGenerator"}});
  registry.add<AxesGeneratorOnline>(
      "nAxesGeneratorOnline", "moves N axes from any motion to any target, with limited jerk");
  registry.add<AxesGeneratorTaught>("nAxesGeneratorTaught",
                                    "does so, and plays what a hand taught at any speed");
  registry.add<PathPlanner>("PathPlanner", "moves a tool on lines, arcs and paths through poses");
  registry.add<Teacher>("Teacher", "records motions that a hand shows, and keeps poses by name");
  registry.add<Reference>("Reference", "where an operator wants the joints, through a generator");
}
