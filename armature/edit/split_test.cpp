// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/edit/internal/in_memory.hpp"

namespace armature::edit {
namespace {

using internal::edited;
using internal::Files;
using internal::refusal;

constexpr const char* kArm = R"(components:
  # A drive for each joint.
  Joint{1..5}:
    model: Joint  # of any size
    peers: ["card{i}"]
    properties: {PeerName: "card{i}", Next: "{i+1}", Ratio: 0.01}  # of the gears
  card{1..5}: {model: Card, properties: {Number: "{i}"}}
  Sensor: {model: Sensor, peers: ["Joint{1..5}"]}

connections:
  - Joint{i}.Position -> Sensor.Position{i}  # all
  - {from: "card{i}.Out", to: "Joint{i}.In", max_age: 30 ms}
  - Joint{i}.Brake -> Joint{i+1}.Release
modes:
  a: ["Joint{1..5}"]
)";

TEST(Split, GivesOneOfARangeAnEntryOfItsOwn) {
  EXPECT_EQ(edited(kArm, Split{"Joint{1..5}", "3"}), R"(components:
  # A drive for each joint.
  Joint{1..2}:
    model: Joint  # of any size
    peers: ["card{i}"]
    properties: {PeerName: "card{i}", Next: "{i+1}", Ratio: 0.01}  # of the gears
  Joint3:
    model: Joint  # of any size
    peers: [card3]
    properties: {PeerName: card3, Next: 4, Ratio: 0.01}
  Joint{4..5}:
    model: Joint  # of any size
    peers: ["card{i}"]
    properties: {PeerName: "card{i}", Next: "{i+1}", Ratio: 0.01}
  card{1..5}: {model: Card, properties: {Number: "{i}"}}
  Sensor: {model: Sensor, peers: ["Joint{1..5}"]}

connections:
  - Joint{1..5}.Position -> Sensor.Position{i}  # all
  - {from: "card{1..5}.Out", to: "Joint{i}.In", max_age: 30 ms}
  - Joint{1..4}.Brake -> Joint{i+1}.Release
modes:
  a: ["Joint{1..5}"]
)");
}

TEST(Split, GivesSomeOfARangeAnEntryOfTheirOwn) {
  const std::string text =
      "components: {\"A{1..4}\": {model: M, properties: {N: \"{i}\"}}, B: {model: M}}\n";
  EXPECT_EQ(
      edited(text, Split{"A{1..4}", "1..2"}),
      "components: {\"A{1..2}\": {model: M, properties: {N: \"{i}\"}}, \"A{3..4}\": {model: M, "
      "properties: {N: \"{i}\"}}, B: {model: M}}\n");
  EXPECT_EQ(edited(text, Split{"A{1..4}", "4"}),
            "components: {\"A{1..3}\": {model: M, properties: {N: \"{i}\"}}, A4: {model: M, "
            "properties: {N: 4}}, B: {model: M}}\n");
}

TEST(Split, KeepsTheParameterOfARangeWhereItCan) {
  const std::string text =
      "parameters: {n: 3}\n"
      "components:\n"
      "  A{1..${n}}: {model: M}\n"
      "  B: {model: M}\n"
      "connections:\n"
      "  - A{i}.x -> B.y{i}\n";
  EXPECT_EQ(edited(text, Split{"A{1..${n}}", "1"}),
            "parameters: {n: 3}\n"
            "components:\n"
            "  A1: {model: M}\n"
            "  A{2..${n}}: {model: M}\n"
            "  B: {model: M}\n"
            "connections:\n"
            "  - A{1..${n}}.x -> B.y{i}\n");
  EXPECT_EQ(edited(text, Split{"A{1..3}", "3"}),
            "parameters: {n: 3}\n"
            "components:\n"
            "  A{1..2}: {model: M}\n"
            "  A3: {model: M}\n"
            "  B: {model: M}\n"
            "connections:\n"
            "  - A{1..3}.x -> B.y{i}\n");
}

TEST(Split, OfAPartChangesTheCompositesDefinition) {
  const std::string text =
      "composites:\n"
      "  C:\n"
      "    components:\n"
      "      w{1..2}: {model: M}\n"
      "      m: {model: M}\n"
      "    connections: [\"m.out{i} -> w{i}.in\"]\n"
      "components:\n"
      "  R{1..2}: {model: C}\n";
  EXPECT_EQ(edited(text, Split{"C.w{1..2}", "2"}),
            "composites:\n"
            "  C:\n"
            "    components:\n"
            "      w1: {model: M}\n"
            "      w2: {model: M}\n"
            "      m: {model: M}\n"
            "    connections: [\"m.out{1..2} -> w{i}.in\"]\n"
            "components:\n"
            "  R{1..2}: {model: C}\n");
}

TEST(Split, KeepsAnAnchorOnceAndLineEndsOfWindows) {
  EXPECT_EQ(edited("components:\r\n  A{1..2}: &a {model: M}\r\n  B: *a", Split{"A{1..2}", "2"}),
            "components:\r\n  A1: &a {model: M}\r\n  A2: {model: M}\r\n  B: *a");
}

TEST(Split, LeavesWhatOverridesTheRange) {
  const Files files = {
      {"robot.yaml", "include: arm.yaml\ncomponents:\n  A{1..3}: {override: true, peers: [B]}\n"},
      {"arm.yaml", "components:\n  A{1..3}: {model: M}\n  B: {model: M}\n"}};
  EXPECT_NE(refusal(files, Split{"A{1..3}", "2"}).find("--in arm.yaml"), std::string::npos);
  const Outcome outcome = internal::outcome_of(files, {{Split{"A{1..3}", "2"}, {"arm.yaml"}}});
  ASSERT_TRUE(outcome.ok()) << outcome.diagnostics.to_text();
  ASSERT_EQ(outcome.files.size(), 1u);
  EXPECT_EQ(outcome.files[0].after,
            "components:\n  A1: {model: M}\n  A2: {model: M}\n  A3: {model: M}\n  B: {model: M}\n");
}

TEST(Split, RefusesWhatIsNoPartOfARange) {
  const std::string text =
      "components:\n  A{1..3}: {model: M}\n  B{1..3}: {model: M}\n  C: {model: M}\n"
      "connections:\n  - A{i+1}.x -> B{i+1}.y\n";
  const auto reason = [&](const std::string& name, const std::string& part) {
    return refusal(text, Split{name, part});
  };
  EXPECT_NE(reason("C", "1").find("'C' is no range"), std::string::npos);
  EXPECT_NE(reason("A2", "2").find("'A2' is not all of an entry: it stands in 'A{1..3}'"),
            std::string::npos);
  EXPECT_NE(reason("A{1..3}", "1..3").find("is all of {1..3}"), std::string::npos);
  for (const char* part :
       {"4", "0", "x", "", "2..", "3..2", "-1", "99999999999999999999", "1..4"}) {
    EXPECT_NE(reason("A{1..3}", part).find("is no number and no part of {1..3}"), std::string::npos)
        << part;
  }
  EXPECT_NE(reason("A{1..3}", "2").find("no end has a plain {i}"), std::string::npos);
}

}  // namespace
}  // namespace armature::edit
