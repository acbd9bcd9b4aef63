// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/edit/internal/references.hpp"
#include "armature/edit/internal/workshop.hpp"
#include "armature/edit/internal/written_name.hpp"

namespace armature::edit::internal {

/// The entries that become a composite, in the order of their file.
class GroupMembers {
 public:
  /// Those of the edit; errors and nothing if they cannot stand in a definition by themselves.
  static std::optional<GroupMembers> find(const Group& group, Workshop& shop);

  const std::vector<const Entry*>& entries() const { return entries_; }
  const SourceText& file() const { return *entries_.front()->file; }

  /// True if a name in the files means one of them.
  bool has(const std::string& written, const std::string& composite, const Workshop& shop) const;
  /// Likewise for a full name in the document.
  bool has(const std::string& name) const;
  /// True if the node stands in one of the entries.
  bool contains(const Node& node) const;

 private:
  bool is_part_of_file(const Group& group, Workshop& shop) const;
  bool is_free_of_changes(Workshop& shop) const;
  bool stand_together(Workshop& shop) const;

  std::vector<const Entry*> entries_;
  std::vector<EntryNames> names_;
};

}  // namespace armature::edit::internal
