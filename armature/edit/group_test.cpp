// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/edit/internal/in_memory.hpp"

namespace armature::edit {
namespace {

using internal::edited;
using internal::Files;
using internal::refusal;

constexpr const char* kRover = R"(# A rover.
application: rover
parameters: {radius: 0.1}

components:
  Driver: {model: Driver, activity: {periodic: 10 ms, priority: 70}}
  # Shares the motion out.
  mixer: {model: Mixer, properties: {Track: 40 cm}}  # between the wheels
  left:
    model: Wheel
    properties: {Radius: "${radius}"}  # of rubber
  right: {model: Wheel, properties: {Radius: "${radius}"}, peers: [left, Driver]}

connections:
  - Driver.Forward -> mixer.Forward
  # The wheels follow.
  - mixer.Left -> left.Speed
  - {from: mixer.Right, to: right.Speed, max_age: 30 ms}
  - left.Angle -> Driver.Left
  - right.Angle -> Driver.Right
before_stop: [mixer.halt]
modes:
  drive: [left, mixer, right]
)";

constexpr const char* kGrouped = R"(# A rover.
application: rover
parameters: {radius: 0.1}

composites:
  Chassis:
    parameters: {radius: 0.1}
    components:
      # Shares the motion out.
      mixer: {model: Mixer, properties: {Track: 40 cm}}  # between the wheels
      left:
        model: Wheel
        properties: {Radius: "${radius}"}  # of rubber
      right: {model: Wheel, properties: {Radius: "${radius}"}, peers: [left, Driver]}
    connections:
      # The wheels follow.
      - mixer.Left -> left.Speed
      - {from: mixer.Right, to: right.Speed, max_age: 30 ms}
    exports:
      ports: {Forward: mixer.Forward, left_Angle: left.Angle, right_Angle: right.Angle}

components:
  Driver: {model: Driver, activity: {periodic: 10 ms, priority: 70}}
  Chassis: {model: Chassis, properties: {radius: "${radius}"}}

connections:
  - Driver.Forward -> Chassis.Forward
  - Chassis.left_Angle -> Driver.Left
  - Chassis.right_Angle -> Driver.Right
before_stop: [Chassis.mixer.halt]
modes:
  drive: [Chassis]
)";

TEST(Group, MakesPartsOfComponents) {
  EXPECT_EQ(edited(kRover, Group{"Chassis", {"right", "mixer", "left"}}), kGrouped);
}

TEST(Dissolve, MakesComponentsOfParts) {
  EXPECT_EQ(edited(kGrouped, Dissolve{"Chassis"}), R"(# A rover.
application: rover
parameters: {radius: 0.1}

components:
  Driver: {model: Driver, activity: {periodic: 10 ms, priority: 70}}
  # Shares the motion out.
  mixer: {model: Mixer, properties: {Track: 40 cm}}  # between the wheels
  left:
    model: Wheel
    properties: {Radius: "${radius}"}  # of rubber
  right: {model: Wheel, properties: {Radius: "${radius}"}, peers: [left, Driver]}

connections:
  - Driver.Forward -> mixer.Forward
  - left.Angle -> Driver.Left
  - right.Angle -> Driver.Right
  - mixer.Left -> left.Speed
  - {from: mixer.Right, to: right.Speed, max_age: 30 ms}
before_stop: [mixer.halt]
modes:
  drive: [mixer, left, right]
)");
}

TEST(Group, ShowsPortsOfRanges) {
  const std::string text =
      "components:\n"
      "  Drive{1..3}: {model: Servo}\n"
      "  Joint{1..3}: {model: Joint}\n"
      "  Sensor: {model: Mux}\n"
      "connections:\n"
      "  - Drive{i}.Angle -> Joint{i}.Angle\n"
      "  - Joint{i}.Voltage -> Drive{i}.Voltage\n"
      "  - Joint{i}.Position -> Sensor.In{i}\n"
      "  - Joint2.Position -> Sensor.Second\n";
  EXPECT_EQ(edited(text, Group{"Arm", {"Joint{1..3}", "Sensor"}}),
            "composites:\n"
            "  Arm:\n"
            "    components:\n"
            "      Joint{1..3}: {model: Joint}\n"
            "      Sensor: {model: Mux}\n"
            "    connections:\n"
            "      - Joint{i}.Position -> Sensor.In{i}\n"
            "      - Joint2.Position -> Sensor.Second\n"
            "    exports:\n"
            "      ports: {\"Angle{1..3}\": \"Joint{i}.Angle\", \"Voltage{1..3}\": "
            "\"Joint{i}.Voltage\"}\n"
            "components:\n"
            "  Drive{1..3}: {model: Servo}\n"
            "  Arm: {model: Arm}\n"
            "connections:\n"
            "  - Drive{i}.Angle -> Arm.Angle{1..3}\n"
            "  - Arm.Voltage{1..3} -> Drive{i}.Voltage\n");
  EXPECT_EQ(edited(text, Group{"Out", {"Sensor"}}),
            "composites:\n"
            "  Out:\n"
            "    components:\n"
            "      Sensor: {model: Mux}\n"
            "    exports:\n"
            "      ports: {\"In{1..3}\": \"Sensor.In{i}\", Second: Sensor.Second}\n"
            "components:\n"
            "  Drive{1..3}: {model: Servo}\n"
            "  Joint{1..3}: {model: Joint}\n"
            "  Out: {model: Out}\n"
            "connections:\n"
            "  - Drive{i}.Angle -> Joint{i}.Angle\n"
            "  - Joint{i}.Voltage -> Drive{i}.Voltage\n"
            "  - Joint{i}.Position -> Out.In{1..3}\n"
            "  - Joint2.Position -> Out.Second\n");
}

}  // namespace
}  // namespace armature::edit
