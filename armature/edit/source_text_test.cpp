// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/source_text.hpp"

#include <gtest/gtest.h>

namespace armature::edit {
namespace {

std::string bytes(const SourceText& file, const Node& node) {
  return file.text().substr(node.begin, node.end - node.begin);
}

/// The bytes of each node in a text, joined by lines.
std::string nodes(const std::string& text) {
  base::Diagnostics diagnostics;
  const SourceText file("a.yaml", text, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  std::string all;
  for (const Node& node : file.nodes()) all += "|" + bytes(file, node);
  return all;
}

TEST(SourceText, KnowsTheBytesOfEachPart) {
  EXPECT_EQ(nodes("a: [1, b]  # comment\n"), "|a: [1, b]|a|[1, b]|1|b");
  EXPECT_EQ(nodes("a:\n  b: c\n\n# comment\nd: 'e'\n"),
            "|a:\n  b: c\n\n# comment\nd: 'e'|a|b: c|b|c|d|'e'");
  EXPECT_EQ(nodes("- - a\n  - b\n"), "|- - a\n  - b|- a\n  - b|a|b");
}

TEST(SourceText, CountsBytesWhereLibyamlCountsCharacters) {
  EXPECT_EQ(nodes("ä: ü\n日: {ö: x}\n"), "|ä: ü\n日: {ö: x}|ä|ü|日|{ö: x}|ö|x");
}

TEST(SourceText, LeavesAByteOrderMarkOutOfPlaces) {
  base::Diagnostics diagnostics;
  const SourceText file("a.yaml",
                        "\xef\xbb\xbf"
                        "a: b\nc: d\n",
                        diagnostics);
  const Node* a = find_key(file.root(), "a");
  const Node* c = find_key(file.root(), "c");
  EXPECT_EQ(bytes(file, *a), "a");
  EXPECT_EQ(file.place_of(*a), (base::Location{"a.yaml", 1, 1}));
  EXPECT_EQ(file.place_of(*c), (base::Location{"a.yaml", 2, 1}));
}

TEST(SourceText, GivesPartsTheirTagsAndAnchors) {
  EXPECT_EQ(nodes("a: !double 1\nb: &x {c: d}\ne: *x\n"),
            "|a: !double 1\nb: &x {c: d}\ne: *x|a|!double 1|b|&x {c: d}|c|d|e|*x");
}

TEST(SourceText, EndsTextsOfSeveralLinesWithTheirLastWord) {
  EXPECT_EQ(nodes("a: |\n  one\n\n  two\n\n\nb: c\n"),
            "|a: |\n  one\n\n  two\n\n\nb: c|a||\n  one\n\n  two|b|c");
}

TEST(SourceText, HasNothingWhereAKeyHasNoValue) {
  base::Diagnostics diagnostics;
  const SourceText file("a.yaml", "a:  # none\nb:\n", diagnostics);
  const Node* none = find_value(file.root(), "a");
  EXPECT_TRUE(none->is_empty());
  EXPECT_EQ(none->begin, 2u);
  EXPECT_TRUE(items_of(none).empty());
}

TEST(SourceText, RefusesWhatLibyamlCannotRead) {
  base::Diagnostics diagnostics;
  const SourceText file("a.yaml", "a: [\n", diagnostics);
  EXPECT_FALSE(diagnostics.ok());
  EXPECT_EQ(file.root(), nullptr);
  EXPECT_NE(diagnostics.to_text().find("libyaml cannot read the file"), std::string::npos);
}

}  // namespace
}  // namespace armature::edit
