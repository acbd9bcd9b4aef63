// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "tests/edit/tree.hpp"

namespace armature::edit::tests {

/// Makes edits on each deployment, and counts which of them are made and which are refused.
class EveryDeployment : public testing::Test {
 protected:
  using Edits = std::vector<Change>;
  using Check = std::function<void(const document::Document& before,
                                   const document::Document& after, const Tree& tree)>;

  /// @param visit  called with the document and its places
  void each(const std::function<void(const document::Document&, const SourceMap&)>& visit) {
    for (const std::string& deployment : Tree::deployments()) {
      deployment_ = deployment;
      files_ = files_of(deployment);
      Tree tree;
      base::Diagnostics diagnostics;
      const document::Document document = tree.load(deployment);
      const SourceMap map(deployment, tree.reader(), document, diagnostics);
      ASSERT_TRUE(diagnostics.ok());
      visit(document, map);
    }
  }

  /// Makes one edit where it stands. If it is made, looks at what has become of the document.
  void try_edit(const Change& change, const Check& check) {
    SCOPED_TRACE(deployment_ + ": " + to_text(change));
    Tree tree;
    const Outcome outcome = apply_edits(deployment_, {{change, files_}}, tree.reader());
    if (!outcome.ok()) {
      EXPECT_TRUE(outcome.files.empty());
      const std::string why = outcome.diagnostics.to_text();
      EXPECT_NE(why.find(" is refused: "), why.npos) << why;
      reasons_.insert(why);
      ++refused_;
      return;
    }
    ++made_;
    const document::Document before = tree.load(deployment_);
    check_replacements(outcome, tree);
    tree.apply(outcome);
    check(before, tree.load(deployment_), tree);
    tree.undo(outcome);
    for (const FileChange& file : outcome.files) EXPECT_EQ(tree.text(file.file), file.before);
  }

  /// Of a file that several deployments include, the entries are tried in the first of them.
  std::vector<Entry> entries_to_try(const SourceMap& map) {
    std::vector<Entry> entries = entries_of(map);
    std::erase_if(entries, [&](const Entry& entry) {
      return entry.file != &map.main() &&
             !tried_.emplace(entry.file->path(), entry.key->begin).second;
    });
    return entries;
  }

  const std::string& deployment() const { return deployment_; }
  std::size_t made() const { return made_; }
  std::size_t refused() const { return refused_; }
  std::string reasons() const {
    std::string all;
    for (const std::string& reason : reasons_) all += reason + "\n";
    return all;
  }

 private:
  void TearDown() override {
    RecordProperty("made", static_cast<int>(made_));
    RecordProperty("refused", static_cast<int>(refused_));
  }
  std::string deployment_;
  std::vector<std::string> files_;
  std::size_t made_ = 0;
  std::size_t refused_ = 0;
  std::set<std::string> reasons_;
  std::set<std::pair<std::string, std::size_t>> tried_;
};

inline const document::Component* find(const document::Document& document,
                                       const std::string& name) {
  for (const auto& component : document.components) {
    if (component.name == name) return &component;
  }
  return nullptr;
}

inline std::string written(const Entry& entry) {
  return (entry.composite.empty() ? "" : entry.composite + ".") + entry.key->text;
}

}  // namespace armature::edit::tests
