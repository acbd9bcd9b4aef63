// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/edit/source_map.hpp"
#include "tests/edit/tree.hpp"

namespace armature::edit::tests {
namespace {

/// The bytes of a node.
std::string bytes(const SourceText& file, const Node& node) {
  return file.text().substr(node.begin, node.end - node.begin);
}

bool is_plain_line(const Node& node, const std::string& text) {
  return node.kind == Node::Kind::kScalar && node.style == Node::Style::kPlain &&
         node.anchor.empty() && !text.starts_with('!') && text.find('\n') == text.npos;
}

TEST(Places, PlainTextsStandInTheirBytes) {
  std::size_t plain = 0;
  for (const std::string& deployment : Tree::deployments()) {
    Tree tree;
    base::Diagnostics diagnostics;
    const SourceText file(deployment, tree.text(deployment), diagnostics);
    ASSERT_TRUE(diagnostics.ok()) << diagnostics.to_text();
    for (const Node& node : file.nodes()) {
      const std::string text = bytes(file, node);
      if (!is_plain_line(node, text)) continue;
      EXPECT_EQ(text, node.text) << deployment;
      ++plain;
    }
  }
  EXPECT_GT(Tree::deployments().size(), 100u);
  EXPECT_GT(plain, 3000u);
}

TEST(Places, ListsAndMapsBeginAndEndWithWhatTheyHave) {
  for (const std::string& deployment : Tree::deployments()) {
    Tree tree;
    base::Diagnostics diagnostics;
    const SourceText file(deployment, tree.text(deployment), diagnostics);
    for (const Node& node : file.nodes()) {
      if (node.children.empty()) continue;
      const std::string text = bytes(file, node);
      if (node.flow) {
        EXPECT_TRUE(text.ends_with('}') || text.ends_with(']')) << deployment << ": " << text;
      } else {
        EXPECT_EQ(node.end, node.children.back()->end) << deployment << ": " << text;
      }
      EXPECT_LE(node.begin, node.children.front()->begin);
    }
  }
}

TEST(Places, EveryComponentHasTheEntryThatMakesIt) {
  std::size_t components = 0;
  for (const std::string& deployment : Tree::deployments()) {
    Tree tree;
    base::Diagnostics diagnostics;
    const document::Document document = tree.load(deployment);
    const SourceMap map(deployment, tree.reader(), document, diagnostics);
    ASSERT_TRUE(diagnostics.ok()) << diagnostics.to_text();
    for (const auto& component : document.components) {
      if (is_orocos_file(component.where.file)) continue;
      const auto entries = map.entries_of(component.name);
      ASSERT_FALSE(entries.empty()) << deployment << ": " << component.name;
      EXPECT_FALSE(entries.front()->changes);
      EXPECT_EQ(entries.front()->file->place_of(*entries.front()->key), component.where);
      ++components;
    }
  }
  EXPECT_GT(components, 800u);
}

TEST(Places, EveryConnectionHasItsItem) {
  std::size_t connections = 0;
  for (const std::string& deployment : Tree::deployments()) {
    Tree tree;
    base::Diagnostics diagnostics;
    const document::Document document = tree.load(deployment);
    const SourceMap map(deployment, tree.reader(), document, diagnostics);
    for (const auto& connection : document.connections) {
      if (is_orocos_file(connection.where.file)) continue;
      const ConnectionEntry* entry = map.entry_of(connection);
      ASSERT_NE(entry, nullptr) << deployment << ": " << document::to_text(connection.from);
      EXPECT_EQ(entry->file->place_of(*entry->item), connection.where);
      ++connections;
    }
  }
  EXPECT_GT(connections, 1000u);
}

}  // namespace
}  // namespace armature::edit::tests
