// SPDX-License-Identifier: Apache-2.0
// What a file takes out of those that it includes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"

namespace armature::deploy::internal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kArm = R"(components:
  "J{1..3}": {model: Joint, properties: {Sign: -1, Gear: 2}, bind: {read: C.read}}
  C: {model: Card}
  Log: {model: Logger}
connections:
  - J{i}.Position -> C.Position{i}
  - C.Load -> Log.Load
  - {name: bus, ports: [C.x, Log.x, J1.x]}
)";

Loaded arm_with(const std::string& own) {
  return load_files("own.yaml", {{"own.yaml", "include: arm.yaml\n" + own}, {"arm.yaml", kArm}});
}

std::vector<std::string> components_of(const Loaded& loaded) {
  std::vector<std::string> names;
  for (const Component& each : loaded.document.components) names.push_back(each.name);
  return names;
}

std::vector<std::string> connections_of(const Loaded& loaded) {
  std::vector<std::string> wires;
  for (const Connection& each : loaded.document.connections) {
    wires.push_back(to_text(each.from) + ">" + to_text(each.to));
  }
  return wires;
}

TEST(Removal, OfAComponentTakesItsConnectionsWithIt) {
  const Loaded loaded = arm_with("components: {Log: {remove: true}}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_THAT(components_of(loaded), ElementsAre("J1", "J2", "J3", "C"));
  EXPECT_THAT(
      connections_of(loaded),
      ElementsAre("J1.Position>C.Position1", "J2.Position>C.Position2", "J3.Position>C.Position3"));
  ASSERT_EQ(loaded.document.named_connections.size(), 1u);
  EXPECT_EQ(loaded.document.named_connections[0].ports.size(), 2u);
}

TEST(Removal, MayHaveARange) {
  const Loaded loaded = arm_with("components: {\"J{2..3}\": {remove: true}}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_THAT(components_of(loaded), ElementsAre("J1", "C", "Log"));
  EXPECT_THAT(connections_of(loaded), ElementsAre("J1.Position>C.Position1", "C.Load>Log.Load"));
}

TEST(Removal, OfAConnectionNamesItsEnds) {
  const Loaded loaded = arm_with(
      "connections: [{from: \"J{2..3}.Position\", to: \"C.Position{i}\", remove: true}]\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_THAT(connections_of(loaded), ElementsAre("J1.Position>C.Position1", "C.Load>Log.Load"));
}

TEST(Removal, OfANamedConnectionNamesIt) {
  const Loaded loaded = arm_with("connections: [{name: bus, remove: true}]\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_TRUE(loaded.document.named_connections.empty());
}

TEST(Removal, OfAPropertyLeavesItsDefault) {
  const Loaded loaded =
      arm_with("components: {J2: {override: true, properties: {Sign: {remove: true}, Gear: 3}}}\n");
  EXPECT_EQ(loaded.messages(), "");
  const Component& joint = loaded.document.components.at(1);
  ASSERT_EQ(joint.properties.size(), 1u);
  EXPECT_EQ(joint.properties[0].name, "Gear");
  EXPECT_EQ(joint.properties[0].value.text, "3");
}

TEST(Removal, OfWhatIsNotThereIsAMistake) {
  EXPECT_THAT(arm_with("components: {Lgo: {remove: true}}\n").messages(),
              HasSubstr("component 'Lgo' is marked remove: true but does not exist"));
  EXPECT_THAT(arm_with("connections: [{from: C.Load, to: J1.Load, remove: true}]\n").messages(),
              HasSubstr("own.yaml:2:15: error: connection 'C.Load -> J1.Load' is marked remove: "
                        "true but does not exist"));
  EXPECT_THAT(arm_with("connections: [{name: bsu, remove: true}]\n").messages(),
              HasSubstr("connection 'bsu' is marked remove: true but does not exist"));
  EXPECT_THAT(arm_with("components: {J2: {override: true, properties: {Sgin: {remove: true}}}}\n")
                  .messages(),
              HasSubstr("'Sgin' is marked remove: true but does not exist"));
}

TEST(Removal, SaysNothingElseOfAComponent) {
  EXPECT_THAT(arm_with("components: {Log: {remove: true, model: Joint}}\n").messages(),
              HasSubstr("component 'Log' is both removed and changed (write either remove: true or "
                        "the changes)"));
}

}  // namespace
}  // namespace armature::deploy::internal
