// SPDX-License-Identifier: Apache-2.0
// What of gains, limits and motors the check refuses where a Robot says what the joints are: on the
// head and on an own robot.
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "armature/document/yaml.hpp"

namespace armature {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

deploy::Deployment load(const std::string& file, std::vector<std::string> overrides = {}) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, SERVO_LIBRARY};
  options.document.overrides = std::move(overrides);
  return deploy::load_deployment(file, options);
}

std::string head(const std::string& file, std::vector<std::string> overrides = {}) {
  return load(JANUS "/" + file, std::move(overrides)).diagnostics.to_text();
}
std::string own(std::vector<std::string> overrides = {}) {
  return load(EXAMPLES "/07_own_robot/arm.yaml", std::move(overrides)).diagnostics.to_text();
}

TEST(RobotCheck, FindsNothingInWhatIsShipped) {
  for (const char* file : {"pid.yaml", "pid_feed_forward.yaml", "modes.yaml", "paper2.yaml"}) {
    EXPECT_EQ(head(file), "") << file;
  }
  EXPECT_EQ(own(), "");
}

TEST(RobotCheck, RefusesGainsThatWouldShakeAJointWithTheirFigures) {
  EXPECT_THAT(head("pid.yaml", {"PID1.Kp=4000"}),
              AllOf(HasSubstr("'PID1': Joint1: shakes at "), HasSubstr("give at most 0."),
                    HasSubstr("sampled every 10 ms")));
  EXPECT_THAT(head("pid.yaml", {"PID2.Kd=2000"}), HasSubstr("'PID2': Joint2: "));
  EXPECT_THAT(head("pid_feed_forward.yaml", {"PID1.Ki=2000"}), HasSubstr("'PID1': Joint1: "));
  EXPECT_THAT(head("paper2.yaml", {"PID2.Kp=2000"}), HasSubstr("'PID2': AIC2.Joint: shakes at "));
  EXPECT_THAT(head("pid.yaml", {"period=50 ms"}), HasSubstr("sampled every 50 ms"));
  EXPECT_THAT(own({"PID3.Kp=20000"}), HasSubstr("'PID3': Joint3: shakes at "));
}

TEST(RobotCheck, RefusesLimitsBeyondDescriptionAndDrives) {
  EXPECT_THAT(head("pid.yaml", {"Joint1.MaxVelocity=1e9"}),
              HasSubstr("'Joint1': MaxVelocity is 1e+09 rad/s, the description allows 3.4 rad/s"));
  EXPECT_THAT(head("pid.yaml", {"Joint2.PositionMax=45"}),
              HasSubstr("'Joint2': PositionMax is 45 rad, the joint ends at 4.5 rad"));
  EXPECT_THAT(head("pid.yaml", {"Joint2.PositionMin=-5"}), HasSubstr("PositionMin is -5 rad"));
  EXPECT_THAT(head("pid.yaml", {"Joint1.MaxVoltage=120"}),
              HasSubstr("MaxVoltage 120: its torque is 210 Nm, the description allows 21 Nm"));
  EXPECT_THAT(head("pid.yaml", {"Joint1.MaxAcceleration=1e4"}),
              HasSubstr("MaxAcceleration 1e+04 rad/s^2: its torque is"));
  EXPECT_THAT(head("pid.yaml", {"Joint1.MaxVelocity=.nan"}), HasSubstr("expected a finite number"));
  EXPECT_THAT(head("pid.yaml", {"Robot.motor_gear_ratio=[]"}),
              HasSubstr("'Robot': motor_gear_ratio: found 0 numbers, expected 2"));
  EXPECT_THAT(head("pid.yaml", {"PID1.UMax=120"}),
              HasSubstr("'PID1': UMin and UMax are up to 120, Joint1 takes 12"));
  EXPECT_THAT(own({"Robot.weight=[15]"}),
              HasSubstr("MaxVoltage 12: its torque is 12 Nm, the joint weighs up to 15 Nm"));
}

TEST(RobotCheck, RefusesALinearAxisWhereTheDescriptionHasOneThatTurns) {
  std::vector<std::string> linear;
  for (const char* each : {"Joint1", "Joint2", "Sensor", "BridgeRef", "Controller", "PID1", "PID2",
                           "Generator", "Arming"}) {
    linear.push_back(std::string(each) + ".Unit=m");
  }
  EXPECT_THAT(head("pid.yaml", linear),
              HasSubstr("'Joint1': Unit is 'm', and in the description the joint turns: expected "
                        "'rad'"));
}

TEST(RobotCheck, RefusesAGearThatIsAnotherThanTheRobots) {
  EXPECT_THAT(head("pid.yaml", {"Joint1.GearRatio=0.03"}),
              HasSubstr("'Joint1': GearRatio is 0.03, expected 0.01: the Robot's motor_gear_ratio "
                        "says 100 turns of the motor for one of the joint"));
  EXPECT_THAT(head("pid.yaml", {"Robot.motor_gear_ratio=[100, 95]"}),
              HasSubstr("'Joint2': GearRatio is 0.01, expected 0.01053"));
  EXPECT_THAT(own({"Joint3.GearRatio=-0.01"}), HasSubstr("'Joint3': GearRatio is -0.01"));
}

/// Adds to every connection whose text begins so that it is read a cycle later.
std::string head_with_delay(const std::string& connection) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, SERVO_LIBRARY};
  base::Diagnostics diagnostics;
  document::Document document = deploy::load_document(JANUS "/pid.yaml", {}, diagnostics);
  for (document::Connection& each : document.connections) {
    const std::string text =
        each.from.component + "." + each.from.port + " -> " + each.to.component;
    if (text == connection) each.policy.one_cycle_delay = true;
  }
  return deploy::parse_deployment(document::write_yaml(document), document.file, options)
      .diagnostics.to_text();
}

TEST(RobotCheck, RefusesGainsThatWouldShakeAJointWhoseLoopIsDelayedByAConnection) {
  EXPECT_EQ(head_with_delay("nothing"), "");
  for (const char* connection :
       {"Actuator.Voltage1 -> Joint1", "Controller.act -> Actuator", "PID1.Out -> Controller",
        "Controller.Sen1 -> PID1", "Sensor.sensor -> Controller", "Joint1.Position -> Sensor",
        "AIC1.DisplacementSensor -> Joint1", "Joint1.VoltageActuator -> AIC1"}) {
    EXPECT_THAT(head_with_delay(connection),
                AllOf(HasSubstr("'PID1': Joint1: "),
                      HasSubstr("answered 10.7 ms later: a connection of the loop has "
                                "one_cycle_delay")))
        << connection;
  }
  EXPECT_EQ(head_with_delay("BridgeRef.reference -> Controller"), "");
}

TEST(RobotCheck, RefusesAWeightThatFeedForwardWouldDriveTheOtherWay) {
  EXPECT_THAT(head("pid_feed_forward.yaml", {"Model.gravity=[0, 0, 9.81]"}),
              HasSubstr("'Controller': Joint1: gravity is [0, 0, 9.81] m/s^2, that of its hardware "
                        "[0, 0, -9.81] m/s^2"));
  EXPECT_EQ(head("pid_feed_forward.yaml", {"Model.gravity=[0, 0, 0]"}), "");
}

TEST(RobotCheck, RefusesMotionsThatAJointWouldCut) {
  EXPECT_THAT(own({"Joint3.PositionMax=0.09 deg"}),
              HasSubstr("'Generator': upper of axis 3 is 1.5, beyond 0.001571, PositionMax of "
                        "Joint3: motions would be cut there"));
  EXPECT_THAT(own({"Joint2.PositionMin=-60 deg"}), HasSubstr("lower of axis 2 is -1.5, beyond"));
  EXPECT_THAT(head("pid.yaml", {"Joint1.MaxVelocity=0.003"}),
              HasSubstr("max_vel of axis 1 is 2, beyond 0.003, MaxVelocity of Joint1"));
  EXPECT_THAT(head("paper2.yaml", {"AIC2.MaxAcceleration=1e-9"}),
              HasSubstr("max_acc of axis 2 is 5, beyond 1e-09, MaxAcceleration of AIC2.Joint"));
  EXPECT_THAT(head("modes.yaml", {"Generator.upper=[45]"}),
              HasSubstr("upper of axis 1 is 45, beyond 4.5"));
}

/// With the readers of two connections swapped.
std::string with_swapped(const std::string& file, const std::string& one,
                         const std::string& other) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, SERVO_LIBRARY};
  base::Diagnostics diagnostics;
  document::Document document = deploy::load_document(JANUS "/" + file, {}, diagnostics);
  document::Endpoint* ends[2] = {};
  for (document::Connection& each : document.connections) {
    const std::string reader = each.to.component + "." + each.to.port;
    if (reader == one) ends[0] = &each.to;
    if (reader == other) ends[1] = &each.to;
  }
  std::swap(*ends[0], *ends[1]);
  return deploy::parse_deployment(document::write_yaml(document), document.file, options)
      .diagnostics.to_text();
}

TEST(RobotCheck, RefusesAPidThatIsGivenWhatIsOfAnotherJoint) {
  for (const char* other : {"PID1.Ref", "PID2.Sen"}) {
    EXPECT_THAT(with_swapped("pid.yaml", "PID1.Sen", other),
                AllOf(HasSubstr("'PID1' answers for joint 1, and is given what is of another"),
                      HasSubstr("connect Ref1 to PID1.Ref and Sen1 to PID1.Sen")))
        << other;
  }
  EXPECT_THAT(with_swapped("paper2.yaml", "PID1.Sen", "PID1.Ref"),
              AllOf(HasSubstr("'PID1': it drives 'AIC1.Joint', and Sen is of 'Bridge'"),
                    HasSubstr("it would follow what it drives: Ref is of 'AIC1.Joint'")));
  EXPECT_THAT(with_swapped("paper2.yaml", "PID1.Sen", "PID2.Sen"),
              HasSubstr("it drives 'AIC1.Joint', and Sen is of 'AIC2.Joint'"));
}

TEST(RobotCheck, RefusesAPidThatAlwaysDrivesOrOneWayOnly) {
  EXPECT_THAT(head("pid.yaml", {"PID2.UMax=-1"}),
              HasSubstr("'PID2': UMin is -12 and UMax -1, expected 0 between them"));
  EXPECT_THAT(head("pid.yaml", {"PID2.UMin=-0.012"}),
              HasSubstr("'PID2': UMin is -0.012 and UMax 12: Joint2 would be driven one way only, "
                        "expected at least 1.2 both ways"));
}

TEST(RobotCheck, RefusesFeedForwardForOtherMotorsThanTheRobots) {
  EXPECT_THAT(head("pid_feed_forward.yaml", {"Controller.motor_resistance=[2000]"}),
              HasSubstr("Joint1: feed-forward gives 571.4 V for 1 Nm at the joint, its drive needs "
                        "0.5714 V"));
  EXPECT_THAT(head("pid_feed_forward.yaml", {"Controller.motor_rotor_inertia=[1.2e-2]"}),
              HasSubstr("feed-forward is for a rotor of 120 kg m^2"));
  EXPECT_THAT(head("pid_feed_forward.yaml", {"Model.gravity=[0, 0, -98.1]"}),
              HasSubstr("'Model': gravity is [0, 0, -98.1] m/s^2, in size 98.1"));
}

TEST(RobotCheck, RefusesAModelOfARobotThatIsMountedOtherwise) {
  EXPECT_THAT(head("pid_feed_forward.yaml", {"Model.gravity=[0, 0, 9.81]"}),
              AllOf(HasSubstr("'Model': Joint1: gravity is [0, 0, 9.81] m/s^2, that of its "
                              "hardware [0, 0, -9.81] m/s^2"),
                    HasSubstr("the same for all who compute it")));
  EXPECT_THAT(head("pid_feed_forward.yaml", {"Robot.gravity=[9.81, 0, 0]"}),
              HasSubstr("that of its hardware [9.81, 0, 0] m/s^2"))
      << "on a wall";
  EXPECT_EQ(
      head("pid_feed_forward.yaml", {"Robot.gravity=[9.81, 0, 0]", "Model.gravity=[9.81, 0, 0]"}),
      "");
}

/// With other components beside those of the arm.
std::string own_with(const std::string& components) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, SERVO_LIBRARY};
  const std::string text = "application: own\ninclude: " EXAMPLES
                           "/07_own_robot/arm.yaml\ncomponents:\n  " +
                           components + "\n";
  return deploy::parse_deployment(text, "own.yaml", options).diagnostics.to_text();
}

TEST(RobotCheck, NamesTheRobotsOfWhichAJointCouldBe) {
  EXPECT_THAT(own_with("Robot: {remove: true}"),
              AllOf(HasSubstr("'Joint1': RobotJoint needs exactly one component of the model "
                              "Robot, found none"),
                    HasSubstr("let the Robot run again, too")));
  EXPECT_THAT(own_with("Other: {model: Robot, properties: {joints: 1, inertia_min: [1], "
                       "inertia_max: [1]}}"),
              AllOf(HasSubstr("'Joint1': RobotJoint needs exactly one component of the model "
                              "Robot, found Robot, Other"),
                    HasSubstr("peers: [Robot]")));
}

TEST(RobotCheck, SaysWhatOfTheRobotIsMissing) {
  EXPECT_THAT(own({"Joint1.RobotJoint=0"}),
              HasSubstr("warning: 'Joint1': its limits and the gains"));
  EXPECT_THAT(own({"Joint1.RobotJoint=4"}), HasSubstr("Robot has joints 1 to 3, found 4"));
  EXPECT_THAT(own({"Robot.inertia_min=[]"}),
              HasSubstr("expected robot_description, or inertia_min and inertia_max"));
  EXPECT_THAT(own({"Robot.inertia_min=[3]"}), HasSubstr("a joint moves 3 to 0.25 kg m^2"));
  EXPECT_THAT(own({"Robot.motor_torque_constant=[]"}),
              HasSubstr("expected motor_torque_constant beside motor_resistance"));
  EXPECT_THAT(own({"Robot.motor_resistance=[]"}),
              HasSubstr("Robot needs motor_resistance: joint 1 is given voltages"));
}

TEST(RobotCheck, AJointHasBothEndsOrNone) {
  EXPECT_THAT(own({"Joint1.Continuous=true"}),
              AllOf(HasSubstr("'Joint1': property 'PositionMin' is given, and Continuous says that "
                              "the joint turns without end (leave out one of them)"),
                    HasSubstr("property 'PositionMax' is given")));
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, SERVO_LIBRARY};
  const auto without_end = [&](const std::string& more) {
    return deploy::parse_deployment(
               "include: arm.yaml\napplication: endless\ncomponents:\n  Joint1: {override: true, "
               "properties: {PositionMin: {remove: true}, PositionMax: {remove: true}" +
                   more + "}}\n",
               EXAMPLES "/07_own_robot/endless.yaml", options)
        .diagnostics.to_text();
  };
  EXPECT_THAT(
      without_end(""),
      AllOf(HasSubstr("'Joint1': property 'PositionMin' has no default and must be given (or "
                      "set Continuous: true for a joint that turns without end)"),
            HasSubstr("property 'PositionMax' has no default")));
  EXPECT_EQ(without_end(", Continuous: true"), "");
}

TEST(RobotCheck, WarnsOfAJointThatNobodyDescribes) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, SERVO_LIBRARY};
  const auto deployment = deploy::parse_deployment(R"(
include: controller.yaml
application: undescribed
libraries: [servo]
components:
  Drive1: {model: Servo, properties: {Period: "${period}"}}
  Joint1: {override: true, properties: {Brake: true, GearRatio: 0.01, PositionMin: -1, PositionMax: 1,
                                        MaxVelocity: 2, MaxAcceleration: 8, MaxVoltage: 12}}
  PID1: {override: true, properties: {Kp: 1e6, UMin: -12, UMax: 12}}
  Controller: {override: true, properties: {MaxAcceleration: [4.0]}}
  Generator: {override: true, properties: {max_vel: [1.5], max_acc: [4.0], lower: [-1], upper: [1]}}
)",
                                                   EXAMPLES "/07_own_robot/other.yaml", options);
  EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  EXPECT_THAT(deployment.diagnostics.to_text(),
              AllOf(HasSubstr("warning: 'Joint1': its limits and the gains of its controller are "
                              "not checked against the robot"),
                    HasSubstr("add a component of the model Robot")));
}

TEST(RobotCheck, GoesOnAfterTheCheckForWhatIsChanged) {
  auto deployment = load(JANUS "/pid.yaml");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  deployment.options.simulated = true;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  const auto refusal = [&](const char* component, const char* property, double value) {
    const auto set = application.set_property(component, property, types::Value::of(value));
    return set ? std::string() : set.error();
  };
  EXPECT_THAT(refusal("Joint1", "MaxVelocity", 1e9), HasSubstr("the description allows 3.4 rad/s"));
  EXPECT_EQ(refusal("Joint1", "MaxVelocity", 2.0), "");
  EXPECT_THAT(refusal("Joint1", "GearRatio", 0.03), HasSubstr("GearRatio is 0.03, expected 0.01"));
  ASSERT_TRUE(application.start().ok());
  application.run_for(std::chrono::milliseconds(100));
  EXPECT_THAT(
      refusal("PID1", "Kp", 1e9),
      AllOf(HasSubstr("property 'Kp' of 'PID1' cannot be 1e+09"), HasSubstr("Joint1: unstable ")));
  EXPECT_THAT(refusal("PID1", "Kp", 2000.0), HasSubstr("Joint1: shakes at "));
  EXPECT_THAT(refusal("PID1", "Kp", 500.0), HasSubstr("gain margin 1."));
  EXPECT_EQ(refusal("PID1", "Kp", 350.0), "");
}

}  // namespace
}  // namespace armature
