// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using internal::load_yaml;
using internal::Loaded;

constexpr const char* kChassis = R"(
composites:
  Chassis:
    parameters: {wheels: 2, top_speed: , card: aic}
    components:
      wheel{1..${wheels}}: {model: Wheel, properties: {limit: "${top_speed}"}, peers: ["${card}"]}
      drive: {model: Drive, properties: {Kp: 1}, peers: ["wheel{1..${wheels}}"], bind: {read: wheel1.read}}
    connections:
      - wheel{i}.Speed -> drive.Speed{i}
    exports:
      ports: {Velocity: drive.Velocity, Command: drive.Command}
      operations: {setVelocity: drive.setVelocity}
      events: {slipped: wheel1.slipped}
      properties: {Kp: drive.Kp}
)";

Loaded load_chassis(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return load_yaml(text + kChassis, overrides);
}

const Component* component(const Loaded& loaded, const std::string& name) {
  for (const Component& one : loaded.document.components) {
    if (one.name == name) return &one;
  }
  ADD_FAILURE() << "no component " << name;
  return &loaded.document.components.at(0);
}

std::string property(const Loaded& loaded, const std::string& name, const std::string& key) {
  const Property* found = find(component(loaded, name)->properties, key);
  return found == nullptr ? "(none)" : to_text(found->value);
}

TEST(Composite, BecomesComponentsNamedAfterItsInstance) {
  const Loaded loaded =
      load_chassis("components: {base: {model: Chassis, properties: {top_speed: 2 rad/s}}}");
  EXPECT_EQ(loaded.messages(), "");
  ASSERT_EQ(loaded.document.components.size(), 3u);
  EXPECT_EQ(loaded.document.components[0].name, "base.wheel1");
  EXPECT_EQ(loaded.document.components[1].name, "base.wheel2");
  EXPECT_EQ(loaded.document.components[2].name, "base.drive");
  EXPECT_EQ(property(loaded, "base.wheel2", "limit"), "2 rad/s");
}

TEST(Composite, InAModeStandsForItsParts) {
  const Loaded loaded = load_chassis(
      "components: {b: {model: Chassis, properties: {top_speed: 1}}, c: {model: Card}}\n"
      "modes: {one: [b], two: [\"{c}\", c]}\nmode: two\n");
  EXPECT_EQ(
      loaded.messages(),
      "robot.yaml:2:25: error: document: mode 'two' '{c}' is not a valid name (a name has letters, "
      "digits, '_' and '-' and begins with a letter)\n");
  ASSERT_EQ(loaded.document.modes.size(), 2u);
  ASSERT_EQ(loaded.document.modes[0].components.size(), 3u);
  EXPECT_EQ(loaded.document.modes[0].components[1].name, "b.wheel2");
  EXPECT_EQ(loaded.document.mode.name, "two");
}

TEST(Composite, ConnectsItsParts) {
  const Loaded loaded =
      load_chassis("components: {b: {model: Chassis, properties: {top_speed: 1}}}");
  ASSERT_EQ(loaded.document.connections.size(), 2u);
  EXPECT_EQ(loaded.document.connections[1].from.component, "b.wheel2");
  EXPECT_EQ(loaded.document.connections[1].to.component, "b.drive");
  EXPECT_EQ(loaded.document.connections[1].to.port, "Speed2");
}

TEST(Composite, NameInsideMeansAPartOrElseAComponentOutside) {
  const Loaded loaded = load_chassis(
      "components: {aic: {model: AIC}, b: {model: Chassis, properties: {top_speed: 1}}}");
  EXPECT_EQ(component(loaded, "b.wheel1")->peers.at(0).component, "aic");
  const Component& drive = *component(loaded, "b.drive");
  EXPECT_EQ(drive.peers.at(1).name, "wheel2") << "the name under which the part knows its peer";
  EXPECT_EQ(drive.peers.at(1).component, "b.wheel2");
  EXPECT_EQ(drive.bindings.at(0).component, "b.wheel1");
}

TEST(Composite, ExportedNamesLeadToTheParts) {
  const Loaded loaded = load_chassis(
      "components:\n"
      "  a: {model: Chassis, properties: {top_speed: 1}}\n"
      "  Op: {model: Op, peers: [a], bind: {go: a.setVelocity, slip: a.slipped}}\n"
      "connections:\n  - a.Velocity -> Op.In\n  - Op.Out -> a.Command\n");
  EXPECT_EQ(loaded.messages(), "");
  const auto& connections = loaded.document.connections;
  EXPECT_EQ(connections.at(2).from.component, "a.drive");
  EXPECT_EQ(connections.at(3).to.component, "a.drive");
  EXPECT_EQ(connections.at(3).to.port, "Command");
  const Component& op = *component(loaded, "Op");
  ASSERT_EQ(op.peers.size(), 2u) << "the parts that serve what is exported";
  EXPECT_EQ(op.peers[0].component, "a.drive");
  EXPECT_EQ(op.peers[1].component, "a.wheel1");
  EXPECT_EQ(op.bindings.at(0).component, "a.drive");
  EXPECT_EQ(op.bindings.at(0).member, "setVelocity");
  EXPECT_EQ(op.bindings.at(1).component, "a.wheel1");
}

TEST(Composite, ExportedPropertySetsThatOfThePart) {
  const Loaded loaded =
      load_chassis("components: {a: {model: Chassis, properties: {top_speed: 1, Kp: 7}}}");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(property(loaded, "a.drive", "Kp"), "7");
}

TEST(Composite, IsRememberedWithItsExports) {
  const Loaded loaded =
      load_chassis("components: {a: {model: Chassis, properties: {top_speed: 1}}}");
  ASSERT_EQ(loaded.document.composites.size(), 1u);
  const Composite& composite = loaded.document.composites[0];
  EXPECT_EQ(composite.name, "a");
  EXPECT_EQ(composite.model, "Chassis");
  EXPECT_EQ(find(composite.parameters, "wheels")->value.text, "2");
  ASSERT_EQ(composite.exports.size(), 5u);
  EXPECT_EQ(composite.exports[0].name, "Velocity");
  EXPECT_EQ(composite.exports[0].component, "a.drive");
}

TEST(Composite, MayBeRepeated) {
  const Loaded loaded = load_chassis(
      "components:\n  c{1..2}: {model: Chassis, properties: {top_speed: \"{i}\", wheels: 1}}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.components.size(), 4u);
  EXPECT_EQ(property(loaded, "c2.wheel1", "limit"), "2");
}

TEST(Composite, MayContainComposites) {
  const Loaded loaded = load_yaml(R"(
components: {top: {model: Outer}}
composites:
  Outer:
    components: {in: {model: Inner, properties: {K: 5}}, log: {model: Log, peers: [in]}}
    connections: [in.Out -> log.In]
    exports: {ports: {Out: in.Out}, properties: {K: in.K}}
  Inner:
    components: {core: {model: Core}}
    exports: {ports: {Out: core.Value}, operations: {go: core.go}, properties: {K: core.Gain}}
connections: [top.Out -> Sink.In]
)");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(property(loaded, "top.in.core", "Gain"), "5");
  EXPECT_EQ(loaded.document.connections.at(0).from.component, "top.in.core");
  EXPECT_EQ(loaded.document.connections.at(1).from.component, "top.in.core");
  EXPECT_EQ(loaded.document.connections.at(1).from.port, "Value");
  EXPECT_EQ(component(loaded, "top.log")->peers.at(0).component, "top.in.core");
  EXPECT_EQ(loaded.document.composites.at(0).exports.at(0).component, "top.in.core");
}

TEST(Composite, CommandLineSetsItsParametersAndParts) {
  const Loaded loaded = load_chassis(
      "components: {a: {model: Chassis, properties: {top_speed: 1}}}",
      {"a.top_speed=9", "a.Kp=3", "a.wheel2.limit=4", "a.drive.activity.periodic=1 ms"});
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(property(loaded, "a.wheel1", "limit"), "9");
  EXPECT_EQ(property(loaded, "a.wheel2", "limit"), "4");
  EXPECT_EQ(property(loaded, "a.drive", "Kp"), "3");
  EXPECT_EQ(component(loaded, "a.drive")->activity.kind, Activity::Kind::kPeriodic);
}

struct Mistake {
  const char* text;
  const char* message;
};

class CompositeMistake : public testing::TestWithParam<Mistake> {};

TEST_P(CompositeMistake, IsReportedWithItsPlace) {
  EXPECT_EQ(load_yaml(GetParam().text).messages(), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Each, CompositeMistake,
    testing::Values(
        Mistake{"composites: {C: {parameters: {speed: }}}\ncomponents: {a: {model: C}}\n",
                "robot.yaml:1:31: error: composite 'C': parameter 'speed' has no value\n"},
        Mistake{"composites: {C: {parameters: {speed: 1}}}\n"
                "components: {a: {model: C, properties: {sped: 1}}}\n",
                "robot.yaml:2:41: error: component 'a': composite 'C' has no parameter 'sped' "
                "(did you mean 'speed'?)\n"},
        Mistake{"composites: {C: {component: {}}}\n",
                "robot.yaml:1:18: error: composite 'C': unknown key 'component' (did you mean "
                "'components'?)\n"},
        Mistake{"composites: {C: {components: []}}\n",
                "robot.yaml:1:30: error: composite 'C': components must be a map, found a list\n"},
        Mistake{"composites: {C: {components: {x: {model: C}}}}\ncomponents: {a: {model: C}}\n",
                "robot.yaml:1:31: error: composite 'C' contains itself (remove it from the "
                "composites inside it)\n"},
        Mistake{"composites: {C: {components: {left: {model: M}}, exports: {ports: {P: lft.O}}}}\n"
                "components: {a: {model: C}}\n",
                "robot.yaml:1:71: error: composite 'C' has no part 'lft' to export 'P' from (did "
                "you mean 'left'?)\n"},
        Mistake{"composites: {C: {exports: {ports: {P: left}}}}\ncomponents: {a: {model: C}}\n",
                "robot.yaml:1:39: error: composite 'C': export 'P' must be part.left, found "
                "'left'\n"},
        Mistake{"composites: {C: {components: {p: {model: M}}, exports: {ports: {Out: p.O}}}}\n"
                "components: {a: {model: C}}\nconnections: [a.Otu -> B.In]\n",
                "robot.yaml:3:15: error: composite 'a' exports no port 'Otu' (did you mean "
                "'Out'?)\n"},
        Mistake{"composites: {C: {components: {p: {model: M}}}}\n"
                "components: {a: {model: C}}\nconnections: [B.Out -> a.p.In]\n",
                "robot.yaml:3:24: error: 'p' is a part of composite 'a', which hides it (use what "
                "the composite exports, or export more)\n"},
        Mistake{"composites: {C: {components: {p: {model: M}}}}\n"
                "components: {a: {model: C}, B: {model: M, peers: [a]}}\n",
                "robot.yaml:2:51: error: composite 'a' exports no operation, event or property for "
                "its peers\n"},
        Mistake{"composites: {C: {components: {p: {model: M}}}}\n"
                "components: {a: {model: C, activity: triggered}}\n",
                "robot.yaml:2:28: error: component 'a': unknown key 'activity' (known: model, "
                "properties)\n"},
        Mistake{"parameters: {bus: x}\ncomposites: {C: {components: {p: {model: \"${bus}\"}}}}\n"
                "components: {a: {model: C}, b: {model: C}}\n",
                "robot.yaml:2:42: error: composite 'C' has no parameter 'bus' (declare it under "
                "parameters:)\n"}));

}  // namespace
}  // namespace armature::deploy
