// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "armature/document/document.hpp"
#include "armature/edit/replacement.hpp"
#include "armature/edit/source_text.hpp"

/// Changes of the YAML of a file, written as what stands beside them is.
namespace armature::edit::internal {

std::string spaces(std::size_t count);

/// What becomes of the text of one file.
class Layout {
 public:
  explicit Layout(const SourceText& file) : file_(file) {}

  /// The node's text becomes `value`, in its quotes if its author quotes what needs no quotes.
  void replace(const Node& node, const document::Value& value);

  /// Behind the last entry of a map, or behind that of the key `after` if it has one.
  /// @param levels  so many levels of `value` get lines of their own where the map has
  void add_entry(const Node& map, const std::string& key, const document::Value& value,
                 int levels = 0, std::string_view after = {});

  /// Behind the last item of a list.
  void add_item(const Node& list, const document::Value& value);

  /// Before the item at that index, or behind the last one.
  void insert_item(const Node& list, std::size_t index, const document::Value& value);

  /// What follows a key that has nothing yet.
  void fill(const Node& empty, const document::Value& value, int levels);

  /// The first section of a file without content.
  void begin_file(const std::string& key, const document::Value& value, int levels);

  /// Takes out an item of a list, or the entry of a map whose key or value this is, with comments
  /// behind it on its last line. Lists and maps that lose all they have go, too, unless they
  /// override others.
  void remove(const Node& node);

  /// In place of an entry of a map or an item of a list stand others, as texts of their own; its
  /// comments stay.
  /// @param first  the item, or the key
  void replace_element(const Node& first, const std::vector<std::string>& texts);

  /// Likewise one, with the comments above it and behind it on its last line.
  void replace_with_comments(const Node& first, const std::string& text);
  /// Takes it out with the comments above it, too. Others stay beside it.
  void remove_with_comments(const Node& first);

  /// Behind the last entry of a map in block style, or behind that of the key `after`: a text of
  /// its own, as it stands at the map's column.
  void add_entry_text(const Node& map, const std::string& text, std::string_view after = {});
  /// Behind the last item of a list: texts of their own.
  void add_item_texts(const Node& list, const std::vector<std::string>& texts);
  /// Above an entry of the file's own map, and below the comments at the head of the file.
  void add_section_text(const Node& key, const std::string& text);

  /// Takes out a section of the file, and an empty line where two would meet.
  void remove_section(const Node& key);

  /// How far the entries of a map stand behind what it belongs to.
  std::size_t step() const;
  /// Likewise the items of a list.
  std::size_t list_step() const;

  /// All of it, in the order of the text.
  std::vector<Replacement> take();

 private:
  /// An item of a list, or an entry of a map.
  struct Element {
    const Node* first;
    std::size_t begin;
    std::size_t end;
    bool removed;
  };

  std::string separator_behind(const Node& container) const;
  std::vector<Element> elements_of(const Node& container) const;
  void add_in_flow(const Node& container, const std::string& text);
  void add_in_empty_flow(const Node& container, const std::string& text);
  void add_in_block(const Node& container, const Element& behind, const std::string& rendered);
  void add_line_behind(std::size_t offset, const std::string& line);
  std::string rendered(const std::string& beginning, const document::Value& value,
                       std::size_t indent, int levels) const;
  std::string aligned_key(const Node& map, const std::string& key) const;
  bool is_spaced(const std::vector<Element>& elements) const;
  void let_empty_ones_go();
  void empty(const Node& container);
  void remove_in_flow(const std::vector<Element>& elements);
  void remove_in_block(const Node& container, const std::vector<Element>& elements);
  void remove_lines(std::size_t begin, std::size_t end);
  void put(std::size_t begin, std::size_t end, std::string text);

  const SourceText& file_;
  std::set<const Node*> removed_;  ///< items, and keys of entries
  std::vector<Replacement> replacements_;
};

/// True if it stands in brackets.
bool is_in_flow(const Node& node);

}  // namespace armature::edit::internal
