// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/source_text.hpp"

/// Where in the bytes of a file the parts of its YAML stand.
namespace armature::edit {

/// A scalar, list, map or alias of a YAML file, from byte `begin` to `end`, with its tag and
/// anchor. Blanks, line ends and comments behind it do not belong to it.
struct Node {
  /// What it is.
  enum class Kind { kScalar, kList, kMap, kAlias };
  /// How a scalar is written.
  enum class Style { kPlain, kSingleQuoted, kDoubleQuoted, kBlock };

  Kind kind = Kind::kScalar;
  Style style = Style::kPlain;
  bool flow = false;  ///< of a list or map: in brackets
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;               ///< of a scalar: its value; of an alias: the anchor's name
  std::string anchor;             ///< empty: none
  Node* parent = nullptr;         ///< list or map around it
  std::vector<Node*> children{};  ///< of a list: its items; of a map: keys and values in turns

  bool is_empty() const { return kind == Kind::kScalar && begin == end; }
};

/// The text of a file and the tree of its YAML; no aliases are followed, nothing is merged.
class SourceText {
 public:
  /// Errors if `text` is not one YAML document, as libyaml reads it; the tree is empty then.
  SourceText(std::string path, std::string text, base::Diagnostics& diagnostics);
  SourceText(const SourceText&) = delete;
  SourceText& operator=(const SourceText&) = delete;

  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }
  /// nullptr if the file has no content.
  const Node* root() const { return root_; }
  /// All nodes, in the order in which they begin.
  const std::deque<Node>& nodes() const { return nodes_; }

  /// Where it begins, as diagnostics and `document::Document` count it: without a byte order mark.
  base::Location place_of(const Node& node) const;

  std::size_t line_begin(std::size_t offset) const;
  /// Of the line's text, without its end.
  std::size_t line_end(std::size_t offset) const;
  /// Bytes from the line's beginning.
  std::size_t column(std::size_t offset) const { return offset - line_begin(offset); }
  /// How its lines end: as the first one does.
  std::string_view end_of_line() const;

 private:
  friend class TreeReader;

  std::string path_;
  std::string text_;
  std::size_t mark_size_;  ///< of a byte order mark
  document::LineIndex lines_;
  std::deque<Node> nodes_;
  Node* root_ = nullptr;
};

/// The value of a map's own key, nullptr if it has none. Keys that `<<` merges are not its own.
const Node* find_value(const Node* map, std::string_view key);

/// Likewise the key itself.
const Node* find_key(const Node* map, std::string_view key);

/// The items of a list, or the node itself; nothing for none or an empty scalar.
std::vector<const Node*> items_of(const Node* node);

}  // namespace armature::edit
