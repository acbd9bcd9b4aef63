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

TEST(Group, ExportsEventsAndCommandsThatTheConnectionSays) {
  EXPECT_EQ(edited("components:\n"
                   "  Button: {model: Button}\n"
                   "  Lift: {model: Lift}\n"
                   "connections:\n"
                   "  - {on: Button.Pressed, do: Lift.level, with: {height: 2 m}}\n",
                   Group{"G", {"Lift"}}),
            "composites:\n"
            "  G:\n"
            "    components:\n"
            "      Lift: {model: Lift}\n"
            "    exports:\n"
            "      operations: {level: Lift.level}\n"
            "components:\n"
            "  Button: {model: Button}\n"
            "  G: {model: G}\n"
            "connections:\n"
            "  - {on: Button.Pressed, do: G.level, with: {height: 2 m}}\n");
}

TEST(Group, WritesBehindOtherDefinitionsAndKeepsLineEndsOfWindows) {
  EXPECT_EQ(
      edited(
          "composites:\r\n  C: {components: {p: {model: M}}}\r\ncomponents:\r\n  A: {model: M}\r\n"
          "  B: {model: C}",
          Group{"G", {"A", "B"}}),
      "composites:\r\n  C: {components: {p: {model: M}}}\r\n  G:\r\n    components:\r\n"
      "      A: {model: M}\r\n      B: {model: C}\r\ncomponents:\r\n  G: {model: G}");
}

TEST(Group, RefusesWhatACompositeCannotSay) {
  const std::string text =
      "components:\n"
      "  A: {model: M}\n"
      "  B{1..3}: {model: M, peers: [A]}\n"
      "  C: {model: M, peers: [A]}\n"
      "  D: {model: M, bind: {read: C.get}, peers: [C]}\n"
      "connections:\n"
      "  - B{i}.x -> B{i+1}.y\n"
      "modes: {one: [B1, C]}\n";
  const auto reason = [&](const std::string& name, const std::vector<std::string>& parts) {
    return refusal(text, Group{name, parts});
  };
  const auto has = [](const std::string& whole, const char* part) {
    EXPECT_NE(whole.find(part), whole.npos) << whole;
  };
  has(reason("G", {"A", "C"}), "'B{1..3}' stands between 'A' and 'C' in the file");
  has(reason("G", {"A"}), "'A' stands in 'peers' of a component outside");
  has(reason("G", {"C"}), "of a component outside, and a composite hides its parts");
  has(reason("G", {"B2"}), "'B2' is not all of an entry: it stands in 'B{1..3}'");
  has(reason("G", {"B{1..3}"}), "mode 'one' has others of its parts, but not 'B2'");
  has(reason("G", {"nobody"}), "unknown component 'nobody'");
  has(reason("G", {}), "it names no components");
  has(reason("C", {"D"}), "is the name of a component, composite or model already");
  has(reason("M", {"D"}), "is the name of a component, composite or model already");
  has(reason("a b", {"D"}), "not a valid name");
  has(reason("Modes", {"D"}), "reserved");
  has(refusal("{components: {A: {model: M}}}\n", Group{"G", {"A"}}), "not in brackets");
}

TEST(Group, RefusesComponentsOfOtherFilesAndThoseThatAreOverridden) {
  const Files files = {
      {"robot.yaml",
       "include: arm.yaml\ncomponents:\n  A: {override: true, peers: [B]}\n  C: {model: M}\n"},
      {"arm.yaml", "components:\n  A: {model: M}\n  B: {model: M}\n"}};
  EXPECT_NE(refusal(files, Group{"G", {"B"}}).find("--in arm.yaml"), std::string::npos);
  EXPECT_NE(refusal(files, Edit{Group{"G", {"B", "C"}}, {"arm.yaml"}}).find("another file"),
            std::string::npos);
  EXPECT_NE(refusal(files, Edit{Group{"G", {"A"}}, {"arm.yaml"}}).find("is overridden here"),
            std::string::npos);
}

TEST(Dissolve, LeavesADefinitionThatOthersUse) {
  const std::string text =
      "composites:\n"
      "  C:\n"
      "    parameters: {n: 2}\n"
      "    components:\n"
      "      w{1..${n}}: {model: W, properties: {Of: \"${n}\"}}\n"
      "    exports: {ports: {\"In{1..2}\": \"w{i}.In\"}}\n"
      "components:\n"
      "  A: {model: C}\n"
      "  B: {model: C}\n"
      "  M: {model: M}\n"
      "connections:\n"
      "  - M.Out{1..2} -> A.In{i}\n"
      "  - M.One -> B.In1\n";
  EXPECT_EQ(edited(text, Dissolve{"B"}),
            "composites:\n"
            "  C:\n"
            "    parameters: {n: 2}\n"
            "    components:\n"
            "      w{1..${n}}: {model: W, properties: {Of: \"${n}\"}}\n"
            "    exports: {ports: {\"In{1..2}\": \"w{i}.In\"}}\n"
            "components:\n"
            "  A: {model: C}\n"
            "  w{1..2}: {model: W, properties: {Of: 2}}\n"
            "  M: {model: M}\n"
            "connections:\n"
            "  - M.Out{1..2} -> A.In{i}\n"
            "  - M.One -> w1.In\n");
}

TEST(Dissolve, WritesAListInPlaceOfItsParameter) {
  const std::string text =
      "composites:\n"
      "  C:\n"
      "    parameters: {gains: [1, 2], peers: []}\n"
      "    components:\n"
      "      p:\n"
      "        model: M\n"
      "        properties:\n"
      "          Gains: ${gains}\n"
      "          Peers: \"${peers}\"\n"
      "components:\n"
      "  A: {model: C, properties: {gains: [3, 4]}}\n"
      "  B: {model: C, properties: {gains: [\"${k}\", 4]}}\n"
      "parameters: {k: 1}\n";
  EXPECT_NE(edited(text, Dissolve{"A"})
                .find("  p:\n"
                      "    model: M\n"
                      "    properties:\n"
                      "      Gains: [3, 4]\n"
                      "      Peers: []\n"),
            std::string::npos)
      << edited(text, Dissolve{"A"});
  EXPECT_NE(refusal(text, Dissolve{"B"}).find("'gains' is computed inside a list or map"),
            std::string::npos);
}

TEST(Dissolve, RefusesWhatWouldMeanSomethingElse) {
  const std::string text =
      "composites:\n"
      "  C:\n"
      "    components: {p: {model: M, properties: {N: 1}}}\n"
      "    exports: {properties: {N: p.N}}\n"
      "components:\n"
      "  A: {model: C, properties: {N: 2}}\n"
      "  R{1..2}: {model: C}\n"
      "  X: {model: C}\n"
      "  p: {model: M}\n";
  const auto has = [&](const std::string& name, const char* part) {
    const std::string whole = refusal(text, Dissolve{name});
    EXPECT_NE(whole.find(part), whole.npos) << whole;
  };
  has("A", "'N' is a property of its part");
  has("R{1..2}", "'R{1..2}' is a range");
  has("X", "'p' is there already");
  has("p", "'p' is no composite");
  has("nobody", "unknown component 'nobody'");
}

}  // namespace
}  // namespace armature::edit
