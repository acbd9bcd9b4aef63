// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

#include "armature/document/limits.hpp"
#include "armature/document/ranges.hpp"
#include "armature/document/tree.hpp"
#include "armature/document/yaml.hpp"

namespace armature::document {
namespace {

constexpr std::size_t kLineWidth = 100;
constexpr int kIndentation = 2;

bool is_alphanumeric(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// True if YAML reads the unquoted text back as it is, in every place where we write texts.
bool is_plain(std::string_view text) {
  if (text.empty() || text.back() == ' ') return false;
  const bool signed_number = text.size() > 1 && (text[0] == '-' || text[0] == '+') &&
                             (is_alphanumeric(text[1]) || text[1] == '.');
  const bool begins_plainly = is_alphanumeric(text[0]) || text[0] == '_' || text[0] == '/' ||
                              (text[0] == '.' && text.substr(0, 3) != "...") || signed_number;
  const bool means_nothing = text == "null" || text == "Null" || text == "NULL";
  constexpr std::string_view kHarmless = "_./+-^*()%> ";
  return begins_plainly && !means_nothing && std::all_of(text.begin(), text.end(), [&](char c) {
           return is_alphanumeric(c) || kHarmless.find(c) != std::string_view::npos;
         });
}

std::string escaped(char c) {
  switch (c) {
    case '"':
      return "\\\"";
    case '\\':
      return "\\\\";
    case '\n':
      return "\\n";
    case '\t':
      return "\\t";
    case '\r':
      return "\\r";
    default:
      break;
  }
  const auto byte = static_cast<unsigned char>(c);
  if (byte >= 0x20 && byte != 0x7f) return {c};
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "\\x%02x", static_cast<unsigned>(byte));
  return text.data();
}

/// True if the text would be taken for a range, a number or a parameter.
bool needs_literal(std::string_view text) {
  return text.find("${") != std::string_view::npos || has_range(text) ||
         !number_offsets(text).empty();
}

std::string scalar_text(std::string_view text, InBraces in_braces = InBraces::kText) {
  const bool as_text = in_braces == InBraces::kText && needs_literal(text);
  const std::string tag = as_text ? "!literal " : "";
  if (is_plain(text)) return tag + std::string(text);
  std::string quoted = tag + "\"";
  for (const char c : text) quoted += escaped(c);
  return quoted + "\"";
}

std::string tag_of(const Value& value) {
  if (value.type.empty()) return {};
  const bool of_struct = value.kind == Value::Kind::kMap;
  return "!" + (of_struct ? std::string(kStructTag) : "") + value.type;
}

/// Appends YAML on one line; gives up once it is longer than `limit`.
bool append_flow(const Value& value, std::size_t limit, std::string& line,
                 InBraces in_braces = InBraces::kText) {
  if (value.literal) in_braces = InBraces::kText;
  if (!value.type.empty()) line += tag_of(value) + " ";
  switch (value.kind) {
    case Value::Kind::kNone:
      line += "~";
      break;
    case Value::Kind::kText:
      line += scalar_text(value.text, in_braces);
      break;
    case Value::Kind::kList:
      line += "[";
      for (std::size_t i = 0; i < value.items.size(); ++i) {
        if (i > 0) line += ", ";
        if (!append_flow(value.items[i], limit, line, in_braces)) return false;
      }
      line += "]";
      break;
    case Value::Kind::kMap:
      line += "{";
      for (std::size_t i = 0; i < value.entries.size(); ++i) {
        line += (i > 0 ? ", " : "") + scalar_text(value.entries[i].name, in_braces) + ": ";
        if (!append_flow(value.entries[i].value, limit, line, in_braces)) return false;
      }
      line += "}";
      break;
  }
  return line.size() <= limit;
}

/// How many levels of a document's section get a line for each entry: components for each of their
/// keys, other sections for each entry.
int block_levels(const std::string& section) {
  if (section == "components") return 2;
  return section == "libraries" ? 0 : 1;
}

void append_block(const Value& value, int indent, int levels, std::string& text);

/// What follows `beginning`: on its line if it fits and `levels` is 0, else on lines of their own.
void append_after(const std::string& beginning, const Value& value, int indent, int levels,
                  std::string& text) {
  std::string line = beginning + " ";
  const bool empty = value.items.empty() && value.entries.empty();
  if (empty || levels == 0) {
    if (append_flow(value, kLineWidth, line) || empty) {
      text += line + "\n";
      return;
    }
  }
  text += beginning + (value.type.empty() ? "" : " " + tag_of(value)) + "\n";
  append_block(value, indent + kIndentation, std::max(levels - 1, 0), text);
}

/// A map that does not fit on the line of its dash begins there.
void append_item(const std::string& margin, const Value& item, int indent, int levels,
                 std::string& text) {
  std::string line = margin + "- ";
  const bool fits = levels == 0 && append_flow(item, kLineWidth, line);
  if (fits || item.kind != Value::Kind::kMap || !item.type.empty() || item.entries.empty()) {
    append_after(margin + "-", item, indent, levels, text);
    return;
  }
  const std::size_t begin = text.size();
  append_block(item, indent + kIndentation, std::max(levels - 1, 0), text);
  text[begin + margin.size()] = '-';
}

void append_block(const Value& value, int indent, int levels, std::string& text) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  for (const Property& entry : value.entries) {
    append_after(margin + scalar_text(entry.name) + ":", entry.value, indent, levels, text);
  }
  for (const Value& item : value.items) append_item(margin, item, indent, levels, text);
}

}  // namespace

std::string flow_text(const Value& value, InBraces in_braces) {
  std::string line;
  append_flow(value, std::string::npos, line, in_braces);
  return line;
}

std::string block_text(const Value& map) {
  std::string text;
  for (const Property& entry : map.entries) {
    append_after(scalar_text(entry.name) + ":", entry.value, 0, block_levels(entry.name), text);
  }
  return text;
}

std::string to_text(const Value& value) { return flow_text(value); }

std::string write_yaml(const Document& document) { return block_text(to_tree(document)); }

}  // namespace armature::document
