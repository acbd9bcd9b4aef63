// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "armature/edit/source_text.hpp"

namespace armature::edit::internal {

/// What a definition's `exports` show, as its file has them.
class ShownMembers {
 public:
  /// @param exports  their map, nullptr if it has none
  explicit ShownMembers(const Node* exports) : exports_(exports) {}

  /// `mixer.Forward` for `Forward`, `Joint{1..3}.Position` for `Position{1..3}`; nothing if it
  /// shows no such member.
  std::optional<std::string> find(const std::string& member) const;

 private:
  const Node* exports_;
};

}  // namespace armature::edit::internal
