// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using internal::load_yaml;
using internal::Loaded;

std::string names(const Document& document) {
  std::string text;
  for (const Component& component : document.components) text += component.name + " ";
  return text;
}

std::string wires(const Document& document) {
  std::string text;
  for (const Connection& one : document.connections) {
    text +=
        one.from.component + "." + one.from.port + ">" + one.to.component + "." + one.to.port + " ";
  }
  return text;
}

/// The text of `A`'s property `x`, written as `x: <value>` under `parameters`.
std::string property(const std::string& value, const std::string& parameters = "{}") {
  const Loaded loaded =
      load_yaml("parameters: " + parameters +
                "\ncomponents: {A: {model: M, properties: {x: " + value + "}}}\n");
  EXPECT_EQ(loaded.messages(), "");
  return to_text(loaded.document.components.at(0).properties.at(0).value);
}

TEST(Range, RepeatsAComponent) {
  EXPECT_EQ(names(load_yaml("components:\n  Joint{1..3}: {model: Joint}\n").document),
            "Joint1 Joint2 Joint3 ");
}

TEST(Range, MayBeInTheMiddleOfAName) {
  EXPECT_EQ(names(load_yaml("components:\n  J{9..10}_x: {model: M}\n").document), "J9_x J10_x ");
}

TEST(Range, NumberIsReplacedInEveryTextOfTheEntry) {
  const Loaded loaded = load_yaml(
      "components:\n"
      "  J{1..2}: {model: M, peers: [\"a{i}\"], properties: {n: \"{i}\", l: [\"x{i}\"], "
      "m: {k: \"{i}/{i}\"}}}\n");
  EXPECT_EQ(loaded.messages(), "");
  const Component& second = loaded.document.components.at(1);
  EXPECT_EQ(second.peers.at(0).name, "a2");
  EXPECT_EQ(second.properties.at(0).value.text, "2");
  EXPECT_EQ(second.properties.at(1).value.items.at(0).text, "x2");
  EXPECT_EQ(second.properties.at(2).value.entries.at(0).value.text, "2/2");
}

TEST(Range, NumberTakesSimpleArithmetic) {
  const Loaded loaded =
      load_yaml("components:\n  J{1..2}: {model: M, properties: {a: \"{i+1}\", b: \"{i-1}\"}}\n");
  EXPECT_EQ(loaded.document.components.at(1).properties.at(0).value.text, "3");
  EXPECT_EQ(loaded.document.components.at(1).properties.at(1).value.text, "1");
}

TEST(Range, RepeatsListItemsAndKeys) {
  const Loaded loaded = load_yaml(
      "components: {A: {model: M, peers: [\"J{1..3}\"], properties: {\"K{1..2}\": \"g{i}\"}}}\n");
  EXPECT_EQ(loaded.messages(), "");
  const Component& it = loaded.document.components.at(0);
  EXPECT_EQ(it.peers.size(), 3u);
  EXPECT_EQ(it.peers.at(2).name, "J3");
  EXPECT_EQ(it.properties.at(1).name, "K2");
  EXPECT_EQ(it.properties.at(1).value.text, "g2");
}

TEST(Range, InnermostOneGivesTheNumber) {
  const Loaded loaded =
      load_yaml("components:\n  A{1..2}: {model: M, properties: {l: [\"{8..9}-{i}\", \"{i}\"]}}\n");
  EXPECT_EQ(to_text(loaded.document.components.at(0).properties.at(0).value), "[8-8, 9-9, 1]");
}

TEST(Range, BoundsMayBeParameters) {
  const Loaded loaded =
      load_yaml("parameters: {joints: 2}\ncomponents:\n  J{1..${joints}}: {model: M}\n");
  EXPECT_EQ(names(loaded.document), "J1 J2 ");
}

TEST(Range, OtherBracesAreOrdinaryText) {
  EXPECT_EQ(property("\"{a} {} {{1} } {\""), "\"{a} {} {{1} } {\"");
  EXPECT_EQ(property("\"{i}\""), "!literal \"{i}\"") << "outside a range";
}

TEST(Range, LiteralTextIsLeftAlone) {
  const Loaded loaded =
      load_yaml("components:\n  J{1..1}: {model: M, properties: {a: !literal \"{i} ${x}\"}}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.components.at(0).properties.at(0).value.text, "{i} ${x}");
}

TEST(Range, OfAComponentCountsInConnections) {
  const Loaded loaded = load_yaml(
      "components:\n  J{1..2}: {model: M}\n  S: {model: M}\n"
      "connections:\n  - J{i}.Position -> S.Position{i}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(wires(loaded.document), "J1.Position>S.Position1 J2.Position>S.Position2 ");
}

TEST(Range, MayBeWrittenInTheConnection) {
  const Loaded loaded = load_yaml(
      "connections:\n  - J{2..3}.Out -> S.In{i-1}\n  - {from: \"S.Out{1..2}\", to: \"J{i}.In\"}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(wires(loaded.document), "J2.Out>S.In1 J3.Out>S.In2 S.Out1>J1.In S.Out2>J2.In ");
}

TEST(Range, MayBeWrittenAtBothEndsIfItIsTheSame) {
  EXPECT_EQ(wires(load_yaml("connections:\n  - J{1..2}.Out -> S.In{1..2}\n").document),
            "J1.Out>S.In1 J2.Out>S.In2 ");
}

TEST(Range, ChainConnectsNeighboursThatExist) {
  const Loaded loaded =
      load_yaml("components:\n  J{1..3}: {model: M}\nconnections:\n  - J{i}.Out -> J{i+1}.In\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(wires(loaded.document), "J1.Out>J2.In J2.Out>J3.In ");
}

TEST(Range, NumberIsReplacedInAllKeysOfAConnection) {
  const Loaded loaded = load_yaml(
      "connections:\n  - {from: \"J{1..2}.Out\", to: \"S.In{i}\", max_age: \"{i}0 ms\"}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.connections.at(1).policy.max_age, std::chrono::milliseconds(20));
}

TEST(Range, RepeatsPortsOfANamedConnection) {
  const Loaded loaded = load_yaml("connections:\n  - {name: n, ports: [S.Out, \"J{1..2}.In\"]}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.named_connections.at(0).ports.size(), 3u);
}

TEST(Range, MistakeInARepeatedEntryIsReportedOnce) {
  EXPECT_EQ(load_yaml("components:\n  J{1..100}: {model: M, actvity: x}\n").messages(),
            "robot.yaml:2:25: error: component 'J1': unknown key 'actvity', likewise 99 others, "
            "'J2' to 'J100' (did you mean 'activity'?)\n");
}

TEST(Range, MistakeOfOneRepetitionIsReported) {
  EXPECT_EQ(load_yaml("components:\n"
                      "  J{1..3}: {model: M, activity: {triggered: true, priority: \"{i}9\"}}\n"
                      "  K{9..10}: {model: M, activity: {triggered: true, priority: \"{i}0\"}}\n")
                .messages(),
            "robot.yaml:3:62: error: component 'K10': priority must be a whole number from 1 to "
            "99, found '100'\n");
}

TEST(Override, ChangesOneOfManyComponents) {
  const Loaded loaded = load_yaml(
      "components:\n"
      "  J{1..3}: {model: M, activity: triggered, properties: {a: 1, b: 2}}\n"
      "  J2: {override: true, activity: sequential, properties: {b: 3, c: 4}}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(names(loaded.document), "J1 J2 J3 ");
  const Component& second = loaded.document.components.at(1);
  EXPECT_EQ(second.activity.kind, Activity::Kind::kSequential);
  ASSERT_EQ(second.properties.size(), 3u);
  EXPECT_EQ(second.properties[0].value.text, "1");
  EXPECT_EQ(second.properties[1].value.text, "3");
  EXPECT_EQ(second.properties[2].value.text, "4");
  EXPECT_EQ(loaded.document.components.at(2).properties.size(), 2u);
}

TEST(Parameter, IsReplacedInTexts) {
  EXPECT_EQ(property("\"a ${b} c ${b}\"", "{b: can0}"), "a can0 c can0");
}

TEST(Parameter, AloneMayBeAListOrAMap) {
  EXPECT_EQ(property("\"${g}\"", "{g: [1, {a: 2}]}"), "[1, {a: 2}]");
}

TEST(Parameter, MayUseOthersInAnyOrder) {
  EXPECT_EQ(property("\"${a}\"", "{a: \"${b}${b}\", b: \"x${c}\", c: y}"), "xyxy");
}

TEST(Parameter, FinalValuesAreKept) {
  const Loaded loaded = load_yaml("parameters: {n: 2, t: \"n=${n}\"}\n");
  EXPECT_EQ(loaded.document.parameters.at(1).name, "t");
  EXPECT_EQ(loaded.document.parameters.at(1).value.text, "n=2");
}

TEST(Parameter, IsReplacedInNamesModelsAndConnections) {
  const Loaded loaded = load_yaml(
      "parameters: {side: left, kind: Motor}\n"
      "components:\n  ${side}_motor: {model: \"${kind}\"}\n"
      "connections:\n  - ${side}_motor.Out -> S.${side}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.components.at(0).name, "left_motor");
  EXPECT_EQ(loaded.document.components.at(0).model, "Motor");
  EXPECT_EQ(wires(loaded.document), "left_motor.Out>S.left ");
}

}  // namespace
}  // namespace armature::deploy
