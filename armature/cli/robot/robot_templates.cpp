// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/robot/robot_templates.hpp"

#include <array>

namespace armature::cli {
namespace {

constexpr std::string_view kRobotController =
    R"(# Everything between the drives and the motions, for any number of joints. It is yours to change; the robot is @name@.yaml.
libraries: [robot]
parameters: {joints: 1, period: 2 ms}
components:
  Sampler: {model: Sampler, activity: {periodic: "${period}", priority: 80}}
  Arming: {model: Arming, activity: {periodic: "${period}", priority: 30}, properties: {joints: "${joints}"}}
  Joint{1..${joints}}:
    model: @joint@
    peers: ["Drive{i}", Sampler, Actuator, Arming]
    properties: {PeerName: "Drive{i}", RobotJoint: "{i}", Brake: true, GearRatio: 1}  # drives that know their gears
  Sensor: {model: SensorNMux, peers: [Sampler], properties: {joints: "${joints}"}}
  Actuator: {model: @demux@, peers: [Sampler], properties: {joints: "${joints}"}}
  BridgeRef: {model: BridgeRef, properties: {joints: "${joints}"}}
  Generator:
    model: nAxesGeneratorPos
    activity: {periodic: "${period}", priority: 40}
    peers: [Arming]
    properties: {num_axes: "${joints}"}
connections:
  - Drive{i}.PositionSensor -> Joint{i}.PositionSensor
  - Drive{i}.IndexSensor -> Joint{i}.IndexSensor
  - Joint{i}.@actuator@ -> Drive{i}.@actuator@
  - Joint{i}.Position -> Sensor.Position{i}
  - Joint{i}.Displacement -> Sensor.Displacement{i}
  - Joint{i}.Armed -> Arming.Armed{i}
  - Sensor.sensor -> BridgeRef.sensor
  - Sensor.sensor -> Controller.sensor
  - BridgeRef.nAxesSensorPosition -> Generator.nAxesSensorPosition
  - BridgeRef.nAxesSensorPosition -> Arming.nAxesSensorPosition
  - Generator.nAxesDesiredPosition -> Arming.nAxesDesiredPosition
  - Generator.nAxesDesiredVelocity -> Arming.nAxesDesiredVelocity
  - Generator.nAxesDesiredPosition -> BridgeRef.nAxesDesiredPosition
  - Generator.nAxesDesiredVelocity -> BridgeRef.nAxesDesiredVelocity
  - Generator.nAxesDesiredAcceleration -> BridgeRef.nAxesDesiredAcceleration
  - BridgeRef.reference -> Controller.reference
  - Controller.act -> Actuator.act
  - Actuator.@command@{i} -> Joint{i}.@command@
)";

constexpr std::string_view kRobotFile =
    R"(# The robot: its description, limits and gains. It is run by simulated.yaml, which has its drives.
include: controller.yaml
application: @name@
libraries: [@libraries@]
parameters: {joints: @joints@}
components:
  # What the joints move and hold: limits and gains are checked against it.
  Robot:
    model: Robot
    properties:
      joints: "${joints}"
      robot_description: "${here}/@name@.urdf"
      motor_rotor_inertia: [@rotor@]  # kg m^2 of each motor, at the joint
      effort_delay: [@delay@]  # s, from a sample until its answer acts
  Drive{1..${joints}}: {model: @drive@, peers: [Bus], properties: {node: "{i}", Brake: true}}
@joint_lines@@controller@  Generator:
    override: true
    properties:
      max_vel: @max_vel@
      max_acc: @max_acc@
      lower: @lower@
      upper: @upper@
)";

constexpr std::string_view kRobotRecorded =
    R"(# armature run --sim --script move.lua --out out recorded.yaml && armature report out
include: simulated.yaml
libraries: [record]
components:
  Reporter:
    model: Reporter
    activity: {periodic: 20 ms, scheduler: other}
    properties: {what: [BridgeRef.reference, Sensor.sensor, "Joint*.Armed"], file: robot.mcap}
)";

constexpr std::string_view kRobotScript = R"(-- armature run --sim --script move.lua simulated.yaml
local function reach(target)
  assert(wait(Generator:moveTo(target, 0)))  -- 0: as fast as the limits allow
  wait(1)
  for number = 1, @joints@ do
    local joint = _ENV["Joint" .. number]
    local error = math.abs(joint.Position - target[number])
    print(string.format("joint %d: %.1f mrad from its target", number, 1000 * error))
    assert(error < 0.02, "joint " .. number .. " did not arrive")
  end
end

wait(0.1)
assert(wait(Arming:arm()))
reach(array(@target@))
reach(array(@start@))
stop()
)";

constexpr std::string_view kRobotPromises =
    R"(// What every drive promises, asked of this robot in simulation: nothing moves before the operator arms, arming moves nothing,
// and whatever ends a motion, the joints rest, stay there and have no power until they are armed again. `silence` and `fail` of
// DriveCase say how your drives break; `positions` and `powered` how they really are.
#include "armature/testing/drive_conformance.hpp"

namespace armature::testing {
namespace {

DriveCase @name@() {
  DriveCase robot;
  robot.name = "@Name@";
  robot.file = ROBOT_FOLDER "/simulated.yaml";
  robot.library_folders = {LIBRARY_FOLDER};
  robot.hardware = {@hardware@};
  robot.away = {@target@};
@case@  return robot;
}

INSTANTIATE_TEST_SUITE_P(Robot, DriveConformance, ::testing::Values(@name@()), by_name);

}  // namespace
}  // namespace armature::testing
)";

constexpr std::string_view kRobotIgnore = "build/\nout/\n";

constexpr std::array<FileTemplate, 6> kRobotFiles = {{
    {"controller.yaml", kRobotController},
    {"@name@.yaml", kRobotFile},
    {"recorded.yaml", kRobotRecorded},
    {"move.lua", kRobotScript},
    {"promises_test.cpp", kRobotPromises},
    {".gitignore", kRobotIgnore},
}};

}  // namespace

std::span<const FileTemplate> robot_templates() { return kRobotFiles; }

}  // namespace armature::cli
