// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/instance.hpp"

#include <algorithm>

#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {

using document::Property;
using document::Value;

namespace {

const document::Composite* find_composite(const std::string& name,
                                          const document::Document& document) {
  const auto found = std::find_if(document.composites.begin(), document.composites.end(),
                                  [&](const auto& one) { return one.name == name; });
  return found == document.composites.end() ? nullptr : &*found;
}

bool is_usable(const Entry& entry, const std::string& name, Workshop& shop) {
  const base::Location where = entry.file->place_of(*entry.key);
  if (!entry.composite.empty()) {
    shop.refuse(where, "'" + name + "' is a part of composite '" + entry.composite + "'",
                "dissolve that one first");
  } else if (entry.names.size() != 1) {
    shop.refuse(where, "'" + name + "' is a range", "split it first");
  } else if (shop.map().entries_of(name).size() != 1) {
    shop.refuse(where, "'" + name + "' is overridden elsewhere", "write that at its parts first");
  } else {
    return shop.require(*entry.file, *entry.key, "'" + name + "'");
  }
  return false;
}

/// True if it, or something in it, uses parameters.
bool is_computed(const Node& node) {
  return node.text.find("${") != node.text.npos ||
         std::ranges::any_of(node.children, [](const Node* child) { return is_computed(*child); });
}

}  // namespace

bool Instance::find_definition(Workshop& shop) {
  for (const auto& file : shop.map().files()) {
    const Node* key = find_key(find_value(file->root(), "composites"), model());
    if (key == nullptr) continue;
    definition_file = file.get();
    definition = key;
  }
  if (definition == nullptr) {
    shop.refuse("its composite '" + model() + "' is in no file that is edited");
    return false;
  }
  const Node* body = find_value(definition->parent, model());
  shown = ShownMembers(find_value(body, "exports"));
  for (const Entry& one : shop.map().entries()) {
    if (one.composite != model()) continue;
    parts.push_back(&one);
    if (!one.changes && one.file == definition_file) continue;
    shop.refuse(one.file->place_of(*one.key), "the composite's part is changed here",
                "write it at the part first");
    return false;
  }
  for (const ConnectionEntry& one : shop.map().connections()) {
    if (one.composite == model()) connections.push_back(&one);
  }
  const Node* components = find_value(body, "components");
  const bool lines = components != nullptr && components->kind == Node::Kind::kMap;
  if (lines && (components->flow || !entry->key->parent->flow)) return !parts.empty();
  shop.refuse(definition_file->place_of(*definition), "its parts do not fit into brackets",
              "write 'components' without brackets first");
  return false;
}

/// What the instance gives, or the definition.
bool Instance::find_parameters(Workshop& shop) {
  const Node* given = find_map(*entry, "properties");
  for (const Property& parameter : composite->parameters) {
    const Node* written = find_value(given, parameter.name);
    const bool computed = written != nullptr && is_computed(*written);
    if (computed && written->kind != Node::Kind::kScalar) {
      shop.refuse(entry->file->place_of(*written),
                  "its parameter '" + parameter.name + "' is computed inside a list or map",
                  "write it at the parts first");
      return false;
    }
    parameters.emplace_back(parameter.name,
                            computed ? document::make_text(written->text) : parameter.value);
  }
  for (std::size_t i = 0; given != nullptr && i + 1 < given->children.size(); i += 2) {
    const Node& key = *given->children[i];
    if (document::find(composite->parameters, key.text) != nullptr) continue;
    shop.refuse(entry->file->place_of(key), "'" + key.text + "' is a property of its part",
                "set it at the part in the composite, and unset it here first");
    return false;
  }
  return true;
}

bool Instance::is_free(Workshop& shop) const {
  const std::set<std::string> taken = names_in(shop.document());
  for (const std::string& part : part_names()) {
    if (!taken.contains(part)) continue;
    shop.refuse(entry->file->place_of(*entry->key), "'" + part + "' is there already",
                "rename the part first: " + model() + "." + part);
    return false;
  }
  return true;
}

std::optional<Instance> Instance::find(const std::string& name, Workshop& shop) {
  Instance instance;
  instance.entry = find_whole_entry(name, shop);
  if (instance.entry == nullptr || !is_usable(*instance.entry, name, shop)) return std::nullopt;
  instance.composite = find_composite(instance.entry->names.front(), shop.document());
  if (instance.composite == nullptr) {
    shop.refuse("'" + name + "' is no composite");
    return std::nullopt;
  }
  const auto& all = shop.document().composites;
  const auto is_its = [&](const auto& one) { return one.model == instance.model(); };
  instance.is_last = std::count_if(all.begin(), all.end(), is_its) == 1;
  const bool possible =
      instance.find_definition(shop) && instance.find_parameters(shop) && instance.is_free(shop);
  return possible ? std::optional(std::move(instance)) : std::nullopt;
}

std::optional<Value> Instance::without_parameters(const std::string& text) const {
  std::string result = text;
  for (const auto& [name, value] : parameters) {
    const std::string use = "${" + name + "}";
    if (text == use) return value;
    for (std::size_t at = result.find(use); at != result.npos; at = result.find(use, at)) {
      result.replace(at, use.size(), value.text);
      at += value.text.size();
    }
  }
  return result == text ? std::nullopt : std::optional(document::make_text(result));
}

std::vector<std::string> Instance::part_names() const {
  std::vector<std::string> names;
  const std::string before = name() + ".";
  for (const Entry* part : parts) {
    for (const std::string& full : part->names) {
      if (full.starts_with(before)) names.push_back(full.substr(before.size()));
    }
  }
  for (const ConnectionEntry* one : connections) {
    const Node* own = find_value(one->item, "name");
    if (own != nullptr) names.push_back(own->text);
  }
  return names;
}

std::vector<std::string> Instance::serving_parts() const {
  std::vector<std::string> names;
  for (const document::Export& one : composite->exports) {
    const std::string part =
        one.component.substr(std::min(name().size() + 1, one.component.size()));
    const bool known = std::find(names.begin(), names.end(), part) != names.end();
    if (one.kind != document::ExportKind::kPort && !known) names.push_back(part);
  }
  return names;
}

bool Instance::makes(const document::Connection& one) const {
  const std::string before = name() + ".";
  return one.from.component.starts_with(before) || one.to.component.starts_with(before);
}

}  // namespace armature::edit::internal
