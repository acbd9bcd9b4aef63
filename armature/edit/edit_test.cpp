// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/edit.hpp"

#include <gtest/gtest.h>

#include "armature/edit/internal/in_memory.hpp"

namespace armature::edit {
namespace {

using internal::edited;
using internal::Files;
using internal::refusal;

constexpr const char* kWave = R"(# What it is for.
application: wave
components:
  Source: {model: Source, properties: {Frequency: 2 Hz}}

  # Smooths.
  Filter:
    model: LowPass  # of first order
    properties:
      Weight: 0.2   # more is faster
connections:
  - Source.Position -> Filter.Raw
)";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Edit, SetsAPropertyAndKeepsTheCommentBehindIt) {
  EXPECT_EQ(edited(kWave, Set{"Filter.Weight", "0.5"}), changed(kWave, "0.2", "0.5"));
}

TEST(Edit, AddsAPropertyInTheStyleOfItsNeighbours) {
  EXPECT_EQ(edited(kWave, Set{"Filter.Gain", "45 deg"}),
            changed(kWave, "# more is faster\n", "# more is faster\n      Gain: 45 deg\n"));
  EXPECT_EQ(edited(kWave, Set{"Source.Gain", "[1, 2]"}),
            changed(kWave, "2 Hz}", "2 Hz, Gain: [1, 2]}"));
}

TEST(Edit, SetsAPropertyInsideAnother) {
  EXPECT_EQ(edited("components:\n  A: {model: M, properties: {G: {Kp: 1}}}\n", Set{"A.G.Kp", "2"}),
            "components:\n  A: {model: M, properties: {G: {Kp: 2}}}\n");
  EXPECT_EQ(edited("components:\n  A: {model: M, properties: {G: {Kp: 1}}}\n", Set{"A.G.Ki", "2"}),
            "components:\n  A: {model: M, properties: {G: {Kp: 1, Ki: 2}}}\n");
  EXPECT_EQ(edited("components:\n  A: {model: M}\n", Set{"A.G.Ki", "2"}),
            "components:\n  A: {model: M, properties: {G: {Ki: 2}}}\n");
}

TEST(Edit, RefusesAPropertyInsideOneThatIsNoMap) {
  EXPECT_EQ(
      refusal(kWave, Set{"Filter.Weight.x", "1"}),
      "robot.yaml:10:15: error: set Filter.Weight.x is refused: the value here is no map to add "
      "'Weight.x' to\n");
}

TEST(Edit, KeepsTheKindOfQuotes) {
  EXPECT_EQ(edited("components:\n  A: {model: M, properties: {N: 'a b'}}\n", Set{"A.N", "c"}),
            "components:\n  A: {model: M, properties: {N: 'c'}}\n");
  EXPECT_EQ(edited("components:\n  A: {model: M, properties: {N: \"a\"}}\n", Set{"A.N", "'c: d'"}),
            "components:\n  A: {model: M, properties: {N: \"c: d\"}}\n");
  EXPECT_EQ(edited("components:\n  A: {model: M, properties: {N: a}}\n", Set{"A.N", "'c: d'"}),
            "components:\n  A: {model: M, properties: {N: \"c: d\"}}\n");
}

TEST(Edit, SetsWhatParametersAndRangesStandFor) {
  const std::string text = "parameters: {p: 3}\ncomponents:\n  A{1..2}: {model: M}\n";
  EXPECT_EQ(edited(text, Set{"A{1..2}.N", "\"x{i}-${p}\""}),
            changed(text, "{model: M}", "{model: M, properties: {N: \"x{i}-${p}\"}}"));
  EXPECT_EQ(edited(text, Set{"A{1..2}.N", "!literal \"x{i}\""}),
            changed(text, "{model: M}", "{model: M, properties: {N: !literal \"x{i}\"}}"));
  EXPECT_EQ(edited(text, Set{"p", "4"}), changed(text, "3", "4"));
}

TEST(Edit, RefusesOneOfARangeUnlessItMayOverride) {
  const std::string text = "components:\n  A{1..3}: {model: M, properties: {N: 1}}\n";
  EXPECT_EQ(
      refusal(text, Set{"A2.N", "2"}),
      "robot.yaml:2:39: error: set A2.N is refused: 'A{1..3}' says it for 'A1', 'A3', too (name "
      "'A{1..3}', or change 'A2' alone with --override)\n");
  EXPECT_EQ(edited(text, {Set{"A2.N", "2"}, {}, true}),
            text + "  A2: {override: true, properties: {N: 2}}\n");
}

TEST(Edit, UnsetsAPropertyAndWhatHasNothingThen) {
  EXPECT_EQ(edited(kWave, Unset{"Filter.Weight"}),
            changed(kWave, "    properties:\n      Weight: 0.2   # more is faster\n", ""));
  EXPECT_EQ(edited(kWave, Unset{"Source.Frequency"}),
            changed(kWave, ", properties: {Frequency: 2 Hz}", ""));
}

TEST(Edit, ChangesOneSettingOfAnActivity) {
  const std::string text =
      "components:\n  A: {model: M, activity: {periodic: 1 ms, priority: 5}}\n";
  EXPECT_EQ(edited(text, Set{"A.activity.periodic", "2 ms"}), changed(text, "1 ms", "2 ms"));
  EXPECT_EQ(edited(text, Set{"A.activity.triggered", "true"}),
            changed(text, "periodic: 1 ms", "triggered: true"));
  EXPECT_EQ(edited(text, Unset{"A.activity.priority"}), changed(text, ", priority: 5", ""));
  EXPECT_EQ(edited("components:\n  A: {model: M, activity: triggered}\n",
                   Set{"A.activity.priority", "5"}),
            "components:\n  A: {model: M, activity: {triggered: true, priority: 5}}\n");
  EXPECT_EQ(edited("components:\n  A: {model: M}\n", Set{"A.activity.periodic", "5 ms"}),
            "components:\n  A: {model: M, activity: {periodic: 5 ms}}\n");
  EXPECT_NE(refusal(text, Set{"A.activity.priority", "500"}).find("from 1 to 99"),
            std::string::npos);
}

TEST(Edit, AddsAComponentAsTheLastOneIsWritten) {
  EXPECT_EQ(edited(kWave, AddComponent{"Log", "Watcher"}),
            changed(kWave, "faster\n", "faster\n\n  Log:\n    model: Watcher\n"));
  EXPECT_EQ(edited("components:\n  A:    {model: M}\n  Long: {model: M}\n", AddComponent{"B", "N"}),
            "components:\n  A:    {model: M}\n  Long: {model: M}\n  B:    {model: N}\n");
  EXPECT_EQ(edited("application: a\n", AddComponent{"B", "N"}),
            "application: a\ncomponents:\n  B: {model: N}\n");
  EXPECT_EQ(edited("components:\n", AddComponent{"B", "N"}), "components:\n  B: {model: N}\n");
  EXPECT_EQ(edited("components: {}\n", AddComponent{"B", "N"}), "components: {B: {model: N}}\n");
}

TEST(Edit, RemovesAComponentWithAllThatRefersToIt) {
  const std::string text = R"(components:
  A: {model: M, peers: [B, C]}
  B: {model: M, peers: [B, A]}
  C: {model: M, bind: {x: B.y}}
connections:
  - A.Out -> B.In
  - A.Out -> C.In
before_stop: [B.rest, C.rest]
modes: {one: [A, B], two: [C]}
)";
  EXPECT_EQ(edited(text, RemoveComponent{"B"}), R"(components:
  A: {model: M, peers: [C]}
  C: {model: M}
connections:
  - A.Out -> C.In
before_stop: [C.rest]
modes: {one: [A], two: [C]}
)");
}

TEST(Edit, TellsWhatGoesWithAComponent) {
  const Outcome outcome = internal::outcome_of(
      "components: {A: {model: M}, B: {model: M}}\nconnections: [A.x -> B.y]\n"
      "before_stop: [A.rest]\n",
      {{RemoveComponent{"A"}}});
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.diagnostics.to_text(), "robot.yaml:3:15: note: 'A.rest' goes with 'A'\n");
}

TEST(Edit, RenamesAComponentInAllThatRefersToIt) {
  const std::string text = R"(components:
  A: {model: M, peers: [B, {other: B}], delays: B}
  B: {model: B}
  C: {model: M, bind: {x: B.y, z: B}}
connections:
  - A.Out   ->   B.In
  - {on: B.Event, do: A.act, with: {x: B.Out, y: B}}
  - {name: bus, ports: [A.P, B.P]}
before_stop: [B.rest]
grants: {script: [B.arm]}
operator_inputs: ["B.Open"]
modes: {one: [A, B], two: [C]}
)";
  EXPECT_EQ(edited(text, Rename{"B", "Drive"}), R"(components:
  A: {model: M, peers: [Drive, {other: Drive}], delays: Drive}
  Drive: {model: B}
  C: {model: M, bind: {x: Drive.y, z: Drive}}
connections:
  - A.Out   ->   Drive.In
  - {on: Drive.Event, do: A.act, with: {x: Drive.Out, y: B}}
  - {name: bus, ports: [A.P, Drive.P]}
before_stop: [Drive.rest]
grants: {script: [Drive.arm]}
operator_inputs: ["Drive.Open"]
modes: {one: [A, Drive], two: [C]}
)");
}

TEST(Edit, RenamesARangeAndAPartOfAComposite) {
  EXPECT_EQ(
      edited("components:\n  J{1..2}: {model: M, peers: [\"J{i}\"]}\n  J2: {override: true}\n"
             "connections:\n  - J{i}.Out -> J1.In{i}\n",
             Rename{"J{1..2}", "Axis{1..2}"}),
      "components:\n  Axis{1..2}: {model: M, peers: [\"Axis{i}\"]}\n  Axis2: {override: true}\n"
      "connections:\n  - Axis{i}.Out -> Axis1.In{i}\n");
  const std::string composite = R"(composites:
  Pair:
    components: {left: {model: M}, right: {model: M, peers: [left]}}
    exports: {ports: {Out: left.Out}}
components:
  P: {model: Pair}
  left: {model: M}
  Q: {model: M, peers: [left]}
)";
  EXPECT_EQ(edited(composite, Rename{"Pair.left", "Pair.first"}), R"(composites:
  Pair:
    components: {first: {model: M}, right: {model: M, peers: [first]}}
    exports: {ports: {Out: first.Out}}
components:
  P: {model: Pair}
  left: {model: M}
  Q: {model: M, peers: [left]}
)");
  EXPECT_EQ(edited(composite, Rename{"left", "own"}),
            changed(changed(composite, "  left: {model: M}\n  Q", "  own: {model: M}\n  Q"),
                    "Q: {model: M, peers: [left]}", "Q: {model: M, peers: [own]}"));
  EXPECT_NE(internal::outcome_of(composite, {{Rename{"Pair.left", "Other.left"}}})
                .diagnostics.to_text()
                .find("'Other.left' has a dot"),
            std::string::npos);
}

TEST(Edit, WarnsOfPropertiesThatMayNameWhatIsRenamed) {
  const Outcome outcome = internal::outcome_of(
      "components:\n  card1: {model: M}\n  A: {model: M, properties: {PeerName: card1}}\n",
      {{Rename{"card1", "card"}}});
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.diagnostics.to_text(),
            "robot.yaml:3:30: warning: property 'PeerName' of 'A' may name it, and stays: card1 "
            "(change it with set, if it does)\n");
}

TEST(Edit, ConnectsInTheStyleOfItsNeighbours) {
  EXPECT_EQ(edited(kWave, Connect{"Filter.Out", "Source.In"}),
            std::string(kWave) + "  - Filter.Out -> Source.In\n");
  EXPECT_EQ(
      edited(kWave, Connect{"Filter.Done", "Source.go", "name: Go, max_age: 30 ms"}),
      std::string(kWave) + "  - {on: Filter.Done, do: Source.go, name: Go, max_age: 30 ms}\n");
  const std::string flow = "components: {A: {model: M}}\nconnections: [A.Out -> A.In]\n";
  EXPECT_EQ(edited(flow, Connect{"A.P", "A.Q"}), changed(flow, "A.In]", "A.In, A.P -> A.Q]"));
}

TEST(Edit, GivesAConnectionOtherSettings) {
  EXPECT_EQ(edited(kWave, SetConnection{"Source.Position", "Filter.Raw", "policy: {fifo: 8}"}),
            changed(kWave, "Source.Position -> Filter.Raw",
                    "{from: Source.Position, to: Filter.Raw, policy: {fifo: 8}}"));
  const std::string map =
      "components:\n  A: {model: M}\nconnections:\n  - from: A.x\n    max_age: 3 ms  # soon\n    "
      "to: A.y\n";
  EXPECT_EQ(
      edited(map, SetConnection{"A.x", "A.y", "max_age: 5 ms, on_old: hold"}),
      changed(map, "3 ms  # soon\n    to: A.y\n", "5 ms  # soon\n    to: A.y\n    on_old: hold\n"));
  EXPECT_EQ(edited(map, SetConnection{"A.x", "A.y"}),
            changed(map, "    max_age: 3 ms  # soon\n", ""));
  EXPECT_NE(
      refusal(map, SetConnection{"A.x", "A.y", "to: A.z"}).find("is an end of the connection"),
      std::string::npos);
  EXPECT_NE(refusal(map, SetConnection{"A.x", "A.y", "max_age: soon"}).find("would have a mistake"),
            std::string::npos);
}

TEST(Edit, BindsWhatAComponentRequires) {
  const std::string text =
      "components:\n  A: {model: M, peers: [B], bind: {x: B.y}}\n  B: {model: M}\n";
  EXPECT_EQ(edited(text, Bind{"A", "x", "B.z"}), changed(text, "B.y", "B.z"));
  EXPECT_EQ(edited(text, Bind{"A", "q", "B.z"}), changed(text, "B.y}", "B.y, q: B.z}"));
  EXPECT_EQ(edited(text, Bind{"B", "q", "A.z"}),
            changed(text, "B: {model: M}", "B: {model: M, bind: {q: A.z}}"));
  EXPECT_EQ(edited(text, Unbind{"A", "x"}), changed(text, ", bind: {x: B.y}", ""));
  EXPECT_NE(refusal(text, Bind{"A", "x", "C.z"}).find("unknown component 'C'"), std::string::npos);
  EXPECT_NE(refusal(text, Unbind{"B", "x"}).find("'B' binds no 'x'"), std::string::npos);
}

TEST(Edit, RefusesConnectionsOfWhatIsNotThere) {
  EXPECT_EQ(refusal(kWave, Connect{"Filtr.Out", "Source.In"}),
            "robot.yaml: error: connect Filtr.Out -> Source.In is refused: unknown component "
            "'Filtr' (did you mean "
            "'Filter'?)\n");
  EXPECT_NE(refusal(kWave, Connect{"Source.Position", "Filter.Raw"}).find("is given twice"),
            std::string::npos);
  EXPECT_NE(refusal(kWave, Disconnect{"Source.Position", "Filter.Row"}).find("did you mean"),
            std::string::npos);
}

TEST(Edit, SeveralAreOneChange) {
  const Outcome outcome = internal::outcome_of(
      kWave, {{AddComponent{"Log", "Watcher"}}, {Set{"Log.Rate", "2"}}, {Set{"Lag.Rate", "2"}}});
  EXPECT_FALSE(outcome.ok());
  EXPECT_TRUE(outcome.files.empty());
  const Outcome good =
      internal::outcome_of(kWave, {{Set{"Filter.Weight", "1"}}, {Set{"Filter.Weight", "0.2"}}});
  EXPECT_TRUE(good.ok());
  EXPECT_TRUE(good.files.empty());  // nothing has changed
}

TEST(Edit, ChangesAnIncludedFileOnlyWhenItMay) {
  const Files files = {
      {"robot.yaml", "include: part.yaml\nparameters: {q: 1}\n"},
      {"part.yaml", "parameters: {p: 1}\ncomponents:\n  A: {model: M, peers: [A]}\n"}};
  EXPECT_EQ(
      refusal(files, Set{"A.N", "1"}),
      "part.yaml:3:3: error: set A.N is refused: 'A' stands in part.yaml (change that file with "
      "--in part.yaml, or override it here with --override)\n");
  EXPECT_EQ(edited(files, {Set{"A.N", "1"}, {"part.yaml"}}, "part.yaml"),
            "parameters: {p: 1}\ncomponents:\n  A: {model: M, peers: [A], properties: {N: 1}}\n");
  EXPECT_EQ(edited(files, {Set{"A.N", "1"}, {}, true}),
            "include: part.yaml\nparameters: {q: 1}\ncomponents:\n"
            "  A: {override: true, properties: {N: 1}}\n");
  EXPECT_EQ(edited(files, {Set{"p", "5"}, {}, true}),
            "include: part.yaml\nparameters: {q: 1, p: 5}\n");
  EXPECT_EQ(edited(files, {RemoveComponent{"A"}, {}, true}),
            "include: part.yaml\nparameters: {q: 1}\ncomponents:\n  A: {remove: true}\n");
  EXPECT_NE(refusal(files, {AddComponent{"B", "M"}, {"other.yaml"}}).find("no YAML file"),
            std::string::npos);
}

TEST(Edit, TellsWhatIsSeenWhenAValueIsTakenBack) {
  const Files files = {
      {"robot.yaml",
       "include: part.yaml\ncomponents:\n  A: {override: true, properties: {N: 2}}\n"},
      {"part.yaml", "components:\n  A: {model: M, properties: {N: 1}}\n"}};
  const Outcome outcome = internal::outcome_of(files, {{Unset{"A.N"}}});
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.files[0].after, "include: part.yaml\n");
  EXPECT_EQ(outcome.diagnostics.to_text(), "part.yaml:2:33: note: A.N=1 is seen now\n");
  EXPECT_EQ(edited(files, {Unset{"A.N"}, {"part.yaml"}}), "include: part.yaml\n");
}

TEST(Edit, OverridesPeers) {
  const Files files = {{"robot.yaml", "include: part.yaml\n"},
                       {"part.yaml",
                        "components:\n  A{1..2}: {model: M, peers: [\"A{i}\", B]}\n"
                        "  B: {model: M}\n"}};
  EXPECT_EQ(edited(files, {AddPeer{"A1", "A2"}, {}, true}),
            "include: part.yaml\ncomponents:\n  A1: {override: true, peers: [A1, B, A2]}\n");
  EXPECT_EQ(edited(files, {RemovePeer{"A1", "B"}, {}, true}),
            "include: part.yaml\ncomponents:\n  A1: {override: true, peers: [A1]}\n");
}

TEST(Edit, RefusesWhatWouldChangeMore) {
  const std::string composite =
      "composites:\n  C: {components: {a: {model: M}}}\n"
      "components:\n  X: {model: C}\n  Y: {model: C}\n";
  EXPECT_NE(refusal(composite, Set{"X.a.N", "1"}).find("says it for 'Y.a', too"),
            std::string::npos);
  EXPECT_EQ(edited(composite, Set{"C.a.N", "1"}),
            changed(composite, "a: {model: M}", "a: {model: M, properties: {N: 1}}"));
  const std::string alias =
      "components:\n  A: {model: M, properties: &p {N: 1}}\n  B: {model: M, properties: *p}\n";
  EXPECT_NE(refusal(alias, Set{"A.N", "2"}).find("more than that would change: component 'B'"),
            std::string::npos);
  EXPECT_NE(refusal(alias, Set{"B.N", "2"}).find("is no map that can be added to"),
            std::string::npos);
}

TEST(Edit, RefusesDeploymentsWithMistakesAndOrocosFiles) {
  EXPECT_NE(refusal("components: {A: {model: M, modl: N}}\n", Set{"A.N", "1"})
                .find("a deployment with mistakes is not edited"),
            std::string::npos);
  EXPECT_NE(internal::outcome_of({{"robot.xml", "<properties/>"}}, {{Set{"A.N", "1"}}}, "robot.xml")
                .diagnostics.to_text()
                .find("OROCOS files are not edited"),
            std::string::npos);
}

}  // namespace
}  // namespace armature::edit
