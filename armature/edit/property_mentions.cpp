// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <set>

#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/definition_text.hpp"

namespace armature::edit::internal {

using document::Value;

namespace {

/// True if one of the names stands in `text` as a word, or begins with a word before a `*`.
bool has_name(const std::string& text, const std::vector<std::string>& names) {
  const auto in_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && in_name(text[end])) ++end;
    const std::string word = text.substr(at, end - at);
    const bool begins = !word.empty() && end < text.size() && text[end] == '*';
    for (const std::string& name : names) {
      if (!word.empty() && (word == name || (begins && name.starts_with(word)))) return true;
    }
    at = end + 1;
  }
  return false;
}

bool mentions(const Value& value, const std::vector<std::string>& names) {
  return has_name(value.text, names) ||
         std::any_of(value.items.begin(), value.items.end(),
                     [&](const Value& item) { return mentions(item, names); });
}

}  // namespace

void warn_of_properties(const std::vector<std::string>& names, Workshop& shop) {
  std::set<std::string> told;
  for (const auto& component : shop.document().components) {
    for (const auto& property : component.properties) {
      if (!mentions(property.value, names)) continue;
      if (!told.insert(document::place_text(property.where)).second) continue;
      shop.diagnostics().warning(
          property.where,
          "property '" + property.name + "' of '" + component.name +
              "' may name it, and stays: " + document::to_text(property.value),
          "change it with set, if it does");
    }
  }
}

}  // namespace armature::edit::internal
