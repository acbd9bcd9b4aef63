// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "armature/edit/edit.hpp"
#include "armature/edit/source_map.hpp"

namespace armature::edit::tests {

/// The deployments of this tree and the files they include, held in memory while they are edited.
class Tree {
 public:
  /// Those that can be read without mistakes, and have components.
  static const std::vector<std::string>& deployments();

  deploy::FileReader reader();
  std::string text(const std::string& file);
  document::Document load(const std::string& file, const std::vector<std::string>& settings = {});

  void apply(const Outcome& outcome);
  /// Takes `outcome` back by its inverse replacements.
  void undo(const Outcome& outcome);

 private:
  std::map<std::string, std::string> changed_;
};

/// What `document` says, places and the order of properties aside.
std::string yaml(document::Document document);

/// Every file the deployment includes, so that an edit may change all of them.
std::vector<std::string> files_of(const std::string& deployment);

/// The entries that make components, once for each key.
std::vector<Entry> entries_of(const SourceMap& map);

/// Fails the test if the outcome's replacements do not make its texts of one another.
void check_replacements(const Outcome& outcome, Tree& tree);

}  // namespace armature::edit::tests
