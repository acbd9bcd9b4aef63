// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/scalar_text.hpp"

#include <algorithm>
#include <cctype>

#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"
#include "armature/edit/internal/layout.hpp"

namespace armature::edit::internal {
namespace {

using document::Value;

/// True if the text needs no quotes in block style: `Joint{1..3}`, `Joint{i}.Out -> Sensor.In{i}`.
bool is_plain_in_block(const std::string& text) {
  if (text.empty() || text.back() == ' ' || text.back() == ':') return false;
  if (std::isalpha(static_cast<unsigned char>(text[0])) == 0) return false;
  if (text == "null" || text == "Null" || text == "NULL") return false;
  constexpr std::string_view kHarmless = "_./+-^*()%> {}$";
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || kHarmless.find(c) != kHarmless.npos;
  });
}

bool is_plain_in_flow(const std::string& text) {
  return written_in_flow(document::make_text(text)) == text;
}

std::string in_single_quotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

bool is_one_line(const std::string& text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

}  // namespace

std::string written_in_flow(const Value& value) {
  return document::flow_text(value, document::InBraces::kMeant);
}

std::string written_in_block(const Value& value) {
  const bool plain = value.kind == Value::Kind::kText && !value.literal && value.type.empty() &&
                     is_plain_in_block(value.text);
  return plain ? value.text : written_in_flow(value);
}

std::string text_in_place_of(const Node& node, const Value& value) {
  const std::string anchor = node.anchor.empty() ? "" : "&" + node.anchor + " ";
  const std::string usual = is_in_flow(node) ? written_in_flow(value) : written_in_block(value);
  const bool bare = value.kind == Value::Kind::kText && !value.literal && value.type.empty();
  const bool needs_quotes = usual.starts_with('"');
  const bool quotes_all = needs_quotes || is_plain_in_flow(node.text);
  if (!bare || !quotes_all) return anchor + usual;
  if (node.style == Node::Style::kSingleQuoted && is_one_line(value.text)) {
    return anchor + in_single_quotes(value.text);
  }
  if (node.style == Node::Style::kDoubleQuoted && !needs_quotes) {
    return anchor + "\"" + value.text + "\"";
  }
  return anchor + usual;
}

}  // namespace armature::edit::internal
