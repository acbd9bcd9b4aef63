// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/edit/edit.hpp"
#include "armature/edit/internal/in_memory.hpp"

/// YAML as hardly anybody writes it.
namespace armature::edit {
namespace {

using internal::edited;
using internal::refusal;

TEST(Hostile, LinesThatEndAsOnWindows) {
  const std::string text = "components:\r\n  A: {model: M}\r\n  B:\r\n    model: M\r\n";
  EXPECT_EQ(edited(text, AddComponent{"C", "N"}), text + "  C:\r\n    model: N\r\n");
  EXPECT_EQ(edited(text, Set{"B.N", "1"}), text + "    properties: {N: 1}\r\n");
  EXPECT_EQ(edited(text, RemoveComponent{"A"}), "components:\r\n  B:\r\n    model: M\r\n");
  EXPECT_EQ(edited(text, Connect{"A.x", "B.y"}), text + "connections:\r\n  - A.x -> B.y\r\n");
}

TEST(Hostile, AFileWhoseLastLineHasNoEnd) {
  const std::string text = "components:\n  A: {model: M}\n  B: {model: M}";
  EXPECT_EQ(edited(text, AddComponent{"C", "N"}), text + "\n  C: {model: N}");
  EXPECT_EQ(edited(text, RemoveComponent{"B"}), "components:\n  A: {model: M}");
  EXPECT_EQ(edited(text, Connect{"A.x", "B.y"}), text + "\nconnections:\n  - A.x -> B.y");
  const std::string windows = "components:\r\n  A: {model: M}\r\n  B: {model: M}";
  EXPECT_EQ(edited(windows, RemoveComponent{"B"}), "components:\r\n  A: {model: M}");
}

TEST(Hostile, AByteOrderMarkAndLettersOfSeveralBytes) {
  const std::string text =
      "\xef\xbb\xbf{application: Größe, components: {A: {model: M, properties: {N: ü}}}}\n";
  EXPECT_EQ(
      edited(text, Set{"A.N", "ß"}),
      "\xef\xbb\xbf{application: Größe, components: {A: {model: M, properties: {N: \"ß\"}}}}\n");
  const std::string lines =
      "\xef\xbb\xbf"
      "components:  # äöü\n  A: {model: M}  # 日本\n";
  EXPECT_EQ(edited(lines, AddComponent{"B", "N"}), lines + "  B: {model: N}\n");
  EXPECT_EQ(edited(lines, Rename{"A", "C"}),
            "\xef\xbb\xbf"
            "components:  # äöü\n  C: {model: M}  # 日本\n");
}

TEST(Hostile, FilesWithoutAnything) {
  for (const std::string text : {"", "\n", "# only a comment\n", "---\n", "# no end"}) {
    const std::string end = text == "# no end" ? "\n" : "";
    EXPECT_EQ(edited(text, AddComponent{"A", "M"}), text + end + "components:\n  A: {model: M}\n");
  }
  EXPECT_EQ(edited("{}\n", AddComponent{"A", "M"}), "{components: {A: {model: M}}}\n");
  EXPECT_EQ(edited("connections: []\ncomponents: {A: {model: M}}\n", Connect{"A.x", "A.y"}),
            "connections: [A.x -> A.y]\ncomponents: {A: {model: M}}\n");
  EXPECT_EQ(
      edited("connections:  # none yet\ncomponents: {A: {model: M}}\n", Connect{"A.x", "A.y"}),
      "connections:  # none yet\n  - A.x -> A.y\ncomponents: {A: {model: M}}\n");
}

TEST(Hostile, AnchorsStayWhereTheyAre) {
  const std::string text =
      "components:\n  A: &a {model: M, properties: {N: &n 1, P: *n}}\n  B: *a\n";
  EXPECT_NE(refusal(text, Set{"A.N", "2"}).find("more than that would change"), std::string::npos);
  EXPECT_NE(refusal(text, Set{"B.N", "2"}).find("is an alias"), std::string::npos);
  const std::string own = "components:\n  A: {model: M, properties: {N: &n 1, P: *n, Q: &q [1]}}\n";
  EXPECT_EQ(edited(own, Set{"A.P", "7"}),
            "components:\n  A: {model: M, properties: {N: &n 1, P: 7, Q: &q [1]}}\n");
  EXPECT_EQ(edited(own, Set{"A.Q", "[7]"}),
            "components:\n  A: {model: M, properties: {N: &n 1, P: *n, Q: &q [7]}}\n");
}

TEST(Hostile, MergedKeysAreOverriddenAndNotChanged) {
  const std::string text =
      "components:\n  A: &a {model: M, properties: {N: 1}}\n  B:\n    <<: *a\n    autosave: "
      "false\n";
  EXPECT_NE(refusal(text, Set{"B.Q", "2"}).find("more than that would change: component 'B'"),
            std::string::npos);
  EXPECT_NE(refusal(text, Set{"A.N", "2"}).find("component 'B'"), std::string::npos);
  EXPECT_EQ(edited(text, Set{"B.activity", "triggered"}), text + "    activity: triggered\n");
}

TEST(Hostile, TextsOfSeveralLines) {
  const std::string text = R"(components:
  A:
    model: M
    properties:
      Script: |
        one
          two

      Folded: >-
        three
        four
      Quoted: "five
        six"
  B: {model: M}
)";
  EXPECT_EQ(edited(text, Set{"A.Script", "short"}), R"(components:
  A:
    model: M
    properties:
      Script: short

      Folded: >-
        three
        four
      Quoted: "five
        six"
  B: {model: M}
)");
  EXPECT_NE(edited(text, Set{"A.N", "1"}).find("        six\"\n      N: 1\n  B:"),
            std::string::npos);
  EXPECT_EQ(edited(text, Unset{"A.Folded"}).find("three"), std::string::npos);
  EXPECT_EQ(edited(text, RemoveComponent{"A"}), "components:\n  B: {model: M}\n");
  EXPECT_NE(edited("components:\n  A: {model: M}\n", Set{"A.Text", "\"a\\nb\""}).find("\"a\\nb\""),
            std::string::npos);
}

TEST(Hostile, BracketsOverSeveralLinesWithComments) {
  const std::string text = R"(components:
  A:
    model: M
    peers: [
      B,  # first
      C   # second
    ]
  B: {model: M,  # a model
      properties: {N: 1}}
  C: {model: M}
)";
  EXPECT_NE(edited(text, AddPeer{"A", "A"}).find("C,   # second\n      A\n    ]"),
            std::string::npos);
  EXPECT_NE(edited(text, RemovePeer{"A", "C"}).find("B  # first\n         # second\n    ]"),
            std::string::npos);
  EXPECT_NE(edited(text, RemovePeer{"A", "B"}).find("peers: [\n      C   # second"),
            std::string::npos);
  EXPECT_NE(edited(text, Set{"B.P", "2"}).find("{N: 1, P: 2}}"), std::string::npos);
  EXPECT_NE(edited(text, Set{"B.activity", "triggered"}).find("{N: 1}},"), 0u);
  EXPECT_NE(edited("components: {A: {model: M, }, }\n", AddComponent{"B", "M"})
                .find("{A: {model: M, }, B: {model: M}, }"),
            std::string::npos);
}

TEST(Hostile, CommentsAroundWhatIsRemoved) {
  const std::string text =
      "components:\n  # of A\n  A: {model: M}  # is A\n\n  # of B\n  B: {model: M}\n  # the end\n";
  EXPECT_EQ(edited(text, RemoveComponent{"A"}),
            "components:\n  # of A\n\n  # of B\n  B: {model: M}\n  # the end\n");
  EXPECT_EQ(edited(text, RemoveComponent{"B"}),
            "components:\n  # of A\n  A: {model: M}  # is A\n\n  # of B\n  # the end\n");
}

TEST(Hostile, ListsInTheColumnOfTheirKey) {
  const std::string text =
      "components:\n  A: {model: M}\nconnections:\n- A.x -> A.y\n- A.p -> A.q\n";
  EXPECT_EQ(edited(text, Connect{"A.a", "A.b"}), text + "- A.a -> A.b\n");
  EXPECT_EQ(edited(text, Disconnect{"A.x", "A.y"}),
            "components:\n  A: {model: M}\nconnections:\n- A.p -> A.q\n");
  EXPECT_EQ(edited("components:\n  A: {model: M}\nconnections:\n- A.x -> A.y\n",
                   Disconnect{"A.x", "A.y"}),
            "components:\n  A: {model: M}\n");
  const std::string maps = "components:\n  A: {model: M}\nconnections:\n- from: A.x\n  to: A.y\n";
  EXPECT_EQ(edited(maps, Disconnect{"A.x", "A.y"}), "components:\n  A: {model: M}\n");
}

TEST(Hostile, KeysInQuotesAndTags) {
  const std::string text =
      "\"components\":\n  'A': {\"model\": M, 'properties': {N: !double 1, T: !literal '{i}'}}\n";
  EXPECT_NE(edited(text, Set{"A.N", "2"}).find("{N: 2, T"), std::string::npos);
  EXPECT_NE(edited(text, Set{"A.T", "x"}).find("T: x}"), std::string::npos);
  EXPECT_NE(edited(text, Rename{"A", "B"}).find("  'B': {"), std::string::npos);
}

TEST(Hostile, TabsAndOddBlanks) {
  const std::string text = "components:\n  A:\t{model: M,\tproperties: { N: 1 }}\t# tab\n";
  EXPECT_EQ(edited(text, Set{"A.N", "2"}),
            "components:\n  A:\t{model: M,\tproperties: { N: 2 }}\t# tab\n");
  EXPECT_EQ(edited(text, Set{"A.P", "2"}),
            "components:\n  A:\t{model: M,\tproperties: { N: 1, P: 2 }}\t# tab\n");
}

TEST(Hostile, MistakesAreNotEdited) {
  EXPECT_NE(refusal("components:\n  A: {model: M}\n  A: {model: N}\n", Set{"A.N", "1"})
                .find("'A' is given twice"),
            std::string::npos);
  EXPECT_NE(refusal("components: [\n", Set{"A.N", "1"}).find("is not closed"), std::string::npos);
  EXPECT_NE(refusal("- a\n- b\n", AddComponent{"A", "M"}).find("error"), std::string::npos);
  EXPECT_NE(refusal("a\xff", AddComponent{"A", "M"}).find("not valid UTF-8"), std::string::npos);
}

TEST(Hostile, ValuesAndNamesThatAreNone) {
  const std::string text = "components:\n  A: {model: M}\n";
  EXPECT_NE(refusal(text, Set{"A.N", "[1"}).find("is not closed"), std::string::npos);
  EXPECT_NE(refusal(text, Set{"A.N", ""}).find("has no value"), std::string::npos);
  EXPECT_NE(refusal(text, Set{"A.N", "~"}).find("has no value"), std::string::npos);
  EXPECT_NE(refusal(text, Set{"A.", "1"}).find("unknown component"), std::string::npos);
  EXPECT_NE(refusal(text, Set{"", "1"}).find("unknown parameter"), std::string::npos);
  EXPECT_NE(refusal(text, AddComponent{"a b", "M"}).find("not a valid name"), std::string::npos);
  EXPECT_NE(refusal(text, AddComponent{"B: {model: X}\n  C", "M"}).find("error"),
            std::string::npos);
  EXPECT_NE(refusal(text, AddComponent{"B", "M}, C: {model: X"}).find("not a valid name"),
            std::string::npos);
  EXPECT_NE(refusal(text, Rename{"A", "x y"}).find("not a valid name"), std::string::npos);
  EXPECT_NE(refusal(text, Connect{"A.x", "A.y\n  - A.p -> A.q"}).find("error"), std::string::npos);
  EXPECT_NE(refusal(text, Connect{"A.x", "A.y", "policy: {fifo: 0}"}).find("error"),
            std::string::npos);
}

}  // namespace
}  // namespace armature::edit
