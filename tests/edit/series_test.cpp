// SPDX-License-Identifier: Apache-2.0
#include <random>

#include <gtest/gtest.h>

#include "tests/edit/tree.hpp"

namespace armature::edit::tests {
namespace {

using document::Document;

constexpr unsigned kSeed = 20261125;
constexpr int kEdits = 12;

/// Some edit of what the document has.
class Chooser {
 public:
  explicit Chooser(unsigned seed) : random_(seed) {}

  Edit choose(const Document& document, const SourceMap& map,
              const std::vector<std::string>& files) {
    return {change(document, map), files, below(4) == 0};
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }

  std::string component(const Document& document) {
    return document.components[below(document.components.size())].name;
  }

  std::string written(const SourceMap& map) {
    const std::vector<Entry> entries = entries_of(map);
    const Entry& entry = entries[below(entries.size())];
    return (entry.composite.empty() ? "" : entry.composite + ".") + entry.key->text;
  }

  Change change(const Document& document, const SourceMap& map) {
    const std::string number = std::to_string(below(1000));
    switch (below(14)) {
      case 0:
        return Set{written(map) + ".P" + number, "[1, 2]"};
      case 1:
        return Set{written(map) + ".activity.periodic", number + " ms"};
      case 2:
        return AddComponent{"Added" + number, "Model"};
      case 3:
        return RemoveComponent{written(map)};
      case 4: {
        const std::string name = written(map);
        const std::size_t dot = name.rfind('.');
        const bool part = dot != name.npos && name.find('{') == name.npos;
        const std::size_t at = part ? dot + 1 : 0;
        return Rename{name, name.substr(0, at) + "R" + number + name.substr(at)};
      }
      case 5:
        return Connect{component(document) + ".Out" + number, component(document) + ".In"};
      case 6:
        return AddPeer{written(map), component(document)};
      case 7:
        return AddParameter{"parameter" + number, "text with spaces"};
      case 8:
        return Split{written(map), std::to_string(1 + below(3))};
      case 9:
        return Group{"G" + number, {written(map)}};
      case 10:
        return AddToMode{"mode" + std::to_string(below(2)), written(map)};
      case 11:
        if (document.composites.empty()) return RemoveMode{"mode1"};
        return Dissolve{document.composites[below(document.composites.size())].name};
      default:
        return removal(document, map);
    }
  }

  Change removal(const Document& document, const SourceMap& map) {
    if (!document.connections.empty() && below(2) == 0) {
      const auto& one = document.connections[below(document.connections.size())];
      return Disconnect{document::to_text(one.from), document::to_text(one.to)};
    }
    const auto& component = document.components[below(document.components.size())];
    if (component.properties.empty()) return RemoveLibrary{"nothing"};
    const auto& property = component.properties[below(component.properties.size())];
    const auto entries = map.entries_of(component.name);
    const bool known = !entries.empty() && entries.front()->composite.empty();
    const std::string name = known ? entries.front()->key->text : component.name;
    return Unset{name + "." + property.name};
  }

  std::mt19937 random_;
};

TEST(Series, EndsWhereItBeganWhenAllIsUndone) {
  std::size_t made = 0;
  Chooser chooser(kSeed);
  for (const std::string& deployment : Tree::deployments()) {
    Tree tree;
    std::vector<Outcome> outcomes;
    std::vector<Edit> edits;
    const std::vector<std::string> files = files_of(deployment);
    for (int i = 0; i < kEdits; ++i) {
      const Document document = tree.load(deployment);
      if (document.components.empty()) break;
      base::Diagnostics diagnostics;
      const SourceMap map(deployment, tree.reader(), document, diagnostics);
      const Edit edit = chooser.choose(document, map, files);
      SCOPED_TRACE(deployment + ": " + to_text(edit.change));
      Outcome outcome = apply_edits(deployment, {edit}, tree.reader());
      if (!outcome.ok()) continue;
      check_replacements(outcome, tree);
      tree.apply(outcome);
      outcomes.push_back(std::move(outcome));
      edits.push_back(edit);
      ++made;
    }
    Tree untouched;
    const Outcome at_once = apply_edits(deployment, edits, untouched.reader());
    ASSERT_TRUE(at_once.ok()) << deployment << at_once.diagnostics.to_text();
    check_replacements(at_once, untouched);
    for (const FileChange& file : at_once.files) EXPECT_EQ(file.after, tree.text(file.file));
    for (auto outcome = outcomes.rbegin(); outcome != outcomes.rend(); ++outcome) {
      tree.undo(*outcome);
    }
    for (const std::string& file : files) EXPECT_EQ(tree.text(file), untouched.text(file));
  }
  EXPECT_GT(made, 800u);
}

}  // namespace
}  // namespace armature::edit::tests
