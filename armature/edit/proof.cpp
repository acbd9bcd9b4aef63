// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <set>
#include <unordered_map>

#include "armature/document/tree.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"
#include "armature/edit/internal/workshop.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::Property;
using document::Value;

/// What a part of a document is called, and what it says.
struct Part {
  std::string name;
  std::string text;
};

/// Properties are known by name: the order in which files give them does not count.
Value with_sorted_properties(Value body) {
  Property* properties = document::find(body.entries, "properties");
  if (properties != nullptr) {
    std::ranges::sort(properties->value.entries, std::less<>(), &Property::name);
  }
  return body;
}

std::string called(const std::string& kind, const std::string& name) {
  return kind + " '" + name + "'";
}

void add_parts(std::vector<Part>& parts, const std::string& kind, const Value& section) {
  for (const Property& entry : section.entries) {
    const std::string text = document::flow_text(with_sorted_properties(entry.value));
    parts.push_back({called(kind, entry.name), text});
  }
  for (const Value& item : section.items) {
    const std::string text = document::flow_text(item);
    parts.push_back({called(kind, text), text});
  }
}

/// The document in the order of its file: each component, connection, mode, and so on.
std::vector<Part> parts_of(const Document& document) {
  static const std::unordered_map<std::string, std::string> kNouns = {
      {"components", "component"}, {"connections", "connection"},
      {"composed", "composite"},   {"parameters", "parameter"},
      {"modes", "mode"},           {"libraries", "library"}};
  std::vector<Part> parts;
  for (const Property& section : document::to_tree(document).entries) {
    const auto kind = kNouns.find(section.name);
    if (kind != kNouns.end()) {
      add_parts(parts, kind->second, section.value);
    } else {
      parts.push_back({section.name, document::flow_text(section.value)});
    }
  }
  return parts;
}

using TextsByName = std::unordered_map<std::string, std::string>;

TextsByName texts_of(const std::vector<Part>& parts) {
  TextsByName texts;
  for (const Part& part : parts) texts.emplace(part.name, part.text);
  return texts;
}

/// Names of parts that `other` has, too, in order.
std::vector<std::string> common(const std::vector<Part>& parts, const TextsByName& other) {
  std::vector<std::string> names;
  for (const Part& part : parts) {
    if (other.contains(part.name)) names.push_back(part.name);
  }
  return names;
}

}  // namespace

std::vector<std::string> differences(const Document& expected, const Document& found) {
  const std::vector<Part> one = parts_of(expected);
  const std::vector<Part> other = parts_of(found);
  const TextsByName in_one = texts_of(one);
  const TextsByName in_other = texts_of(other);
  std::vector<std::string> names;
  const auto add_missing = [&](const std::vector<Part>& parts, const TextsByName& others) {
    for (const Part& part : parts) {
      const auto same = others.find(part.name);
      const bool differs = same == others.end() || same->second != part.text;
      const bool is_new = std::find(names.begin(), names.end(), part.name) == names.end();
      if (differs && is_new) names.push_back(part.name);
    }
  };
  add_missing(one, in_other);
  add_missing(other, in_one);
  if (names.empty() && common(one, in_other) != common(other, in_one)) {
    names.emplace_back("the order of components and connections");
  }
  if (names.empty() && one.size() != other.size())
    names.emplace_back("how often something is said");
  return names;
}

}  // namespace armature::edit::internal
