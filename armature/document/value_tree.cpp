// SPDX-License-Identifier: Apache-2.0
#include "armature/document/value_tree.hpp"

#include <algorithm>
#include <utility>

namespace armature::document {

const Property* find(const std::vector<Property>& properties, std::string_view name) {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const Property& one) { return one.name == name; });
  return found == properties.end() ? nullptr : &*found;
}

Property* find(std::vector<Property>& properties, std::string_view name) {
  return const_cast<Property*>(find(std::as_const(properties), name));
}

}  // namespace armature::document

namespace armature::document {

std::string place_text(const base::Location& where) {
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  return text;
}

std::size_t depth_of(const Value& value) {
  std::size_t below = 0;
  for (const Value& item : value.items) below = std::max(below, depth_of(item));
  for (const Property& entry : value.entries) below = std::max(below, depth_of(entry.value));
  return below + 1;
}

std::size_t count_nodes(const Value& value) {
  std::size_t nodes = 1;
  for (const Value& item : value.items) nodes += count_nodes(item);
  for (const Property& entry : value.entries) nodes += count_nodes(entry.value);
  return nodes;
}

Value make_text(std::string text, base::Location where) {
  Value value;
  value.kind = Value::Kind::kText;
  value.text = std::move(text);
  value.where = std::move(where);
  return value;
}

Value make_list(base::Location where) {
  Value value;
  value.kind = Value::Kind::kList;
  value.where = std::move(where);
  return value;
}

Value make_map(base::Location where) {
  Value value;
  value.kind = Value::Kind::kMap;
  value.where = std::move(where);
  return value;
}

std::string_view name_of(Value::Kind kind) {
  switch (kind) {
    case Value::Kind::kNone:
      return "nothing";
    case Value::Kind::kText:
      return "text";
    case Value::Kind::kList:
      return "a list";
    case Value::Kind::kMap:
      return "a map";
  }
  return "nothing";
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  const bool shortened = text.size() > kLongest;
  std::string one_line(shortened ? text.substr(0, kLongest - 3) : text);
  std::replace_if(
      one_line.begin(), one_line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  return "'" + one_line + (shortened ? "...'" : "'");
}

std::string path_in_quotes(std::string_view path) { return "'" + std::string(path) + "'"; }

}  // namespace armature::document
