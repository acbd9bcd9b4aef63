// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "armature/document/document.hpp"
#include "armature/edit/source_text.hpp"

/// Entries and items as their file has them, to be written in other places.
namespace armature::edit::internal {

/// What becomes of a scalar; nothing if it stays.
using NewValue = std::function<std::optional<document::Value>(const Node& scalar)>;

/// How a copy of an element differs.
struct CopyChanges {
  NewValue new_value;           ///< of each scalar but those of `!literal` values
  bool anchors = true;          ///< the copy has them, too
  bool comment_behind = false;  ///< on its last line, in block style
};

/// The text of an item of a list or, with its key, of an entry of a map.
/// @param first  the item, or the key
std::string copied_element(const SourceText& file, const Node& first, const CopyChanges& changes);

/// True if braces in the node mean nothing: `!literal "{i}"`.
bool is_literal(const SourceText& file, const Node& node);

/// The value of a key, the item itself in a list.
const Node& value_of_element(const Node& first);

/// Where the comments above an element begin, or it itself: at its own column, without empty lines.
std::size_t begin_with_comments(const SourceText& file, const Node& first);

/// Those comments, without their indentation.
std::vector<std::string> comments_above(const SourceText& file, const Node& first);

/// Lines of `text` but the first, moved from one column to another.
std::string moved_lines(const std::string& text, std::size_t from, std::size_t to);

}  // namespace armature::edit::internal
