// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/edit/source_map.hpp"

/// Where files name components.
namespace armature::edit::internal {

/// A text that names a component, or two.
struct Mention {
  /// `A`, `A.x`, `A.x -> B.y`, or a value that may be `A.x`.
  enum class Form { kName, kMember, kArrow, kParameter };

  const SourceText* file = nullptr;
  const Node* node = nullptr;
  Form form = Form::kName;
  std::string composite;  ///< in whose definition it stands; empty: none
  /// What goes with the component: the item or entry, of a connection the whole of it.
  const Node* whole = nullptr;
  bool in_connection = false;  ///< of `connections`

  /// The parts of the text that are names, as written: one or two, or none.
  std::vector<std::string> names() const;

  /// The text with each name replaced by what `replacement` gives for it.
  template <typename Replace>
  std::string replaced_names(const Replace& replacement) const;

 private:
  struct Part {
    std::size_t begin;
    std::size_t size;
  };
  std::vector<Part> parts() const;
};

/// The last dot that is not in braces, npos if there is none.
std::size_t last_dot(std::string_view text);

/// All of them in files that can be edited. Names that components are declared by are not among
/// them.
std::vector<Mention> mentions_in(const SourceMap& map);

template <typename Replace>
std::string Mention::replaced_names(const Replace& replacement) const {
  std::string text = node->text;
  const std::vector<Part> all = parts();
  for (auto part = all.rbegin(); part != all.rend(); ++part) {
    text.replace(part->begin, part->size, replacement(text.substr(part->begin, part->size)));
  }
  return text;
}

}  // namespace armature::edit::internal
