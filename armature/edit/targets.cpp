// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/targets.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/ranges.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::Property;
using document::Value;

/// Positions of dots that are not in braces, the last one first.
std::vector<std::size_t> dots_of(const std::string& path) {
  std::vector<std::size_t> dots;
  int depth = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '{') ++depth;
    if (path[i] == '}') --depth;
    if (path[i] == '.' && depth == 0) dots.insert(dots.begin(), i);
  }
  return dots;
}

std::vector<std::string> known_components(const Document& document) {
  std::vector<std::string> names;
  for (const auto& one : document.components) names.push_back(one.name);
  for (const auto& one : document.composites) names.push_back(one.name);
  return names;
}

/// Names of the entries that the files have under that key.
std::vector<std::string> names_of_key(const std::string& key, const SourceMap& map) {
  std::vector<std::string> names;
  for (const Entry& entry : map.entries()) {
    const std::string whole =
        (entry.composite.empty() ? "" : entry.composite + ".") + entry.key->text;
    if (whole != key || entry.changes) continue;
    names.insert(names.end(), entry.names.begin(), entry.names.end());
  }
  return names;
}

std::vector<std::string> names_of_range(const std::string& written, const Document& document) {
  const std::vector<std::string> known = known_components(document);
  const std::set<std::string> all(known.begin(), known.end());
  if (all.contains(written)) return {written};
  base::Diagnostics ignored;
  const auto range = document::find_range(written, {}, ignored);
  if (!range) return {};
  std::vector<std::string> names;
  for (int number = range->range.first; number <= range->range.last; ++number) {
    std::string name = written;
    name.replace(range->begin, range->end - range->begin, std::to_string(number));
    if (!all.contains(name)) return {};
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<std::string> components_named(const std::string& written, const Workshop& shop) {
  std::vector<std::string> names = names_of_key(written, shop.map());
  return names.empty() ? names_of_range(written, shop.document()) : names;
}

const Value* find_value_at(const std::vector<Property>& properties, const std::string& path) {
  if (const Property* whole = document::find(properties, path)) return &whole->value;
  const std::size_t dot = path.find('.');
  if (dot == path.npos) return nullptr;
  const Property* outer = document::find(properties, path.substr(0, dot));
  return outer == nullptr ? nullptr : find_value_at(outer->value.entries, path.substr(dot + 1));
}

std::string names_beside(const Entry& entry, const Targets& targets) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> others;
  for (const std::string& name : entry.names) {
    if (!targets.has(name)) others.push_back("'" + name + "'");
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, others.size()); ++i) {
    text += (i > 0 ? ", " : "") + others[i];
  }
  return others.size() > kMost ? text + " and " + std::to_string(others.size() - kMost) + " more"
                               : text;
}

std::string key_of(const Entry& entry) {
  return (entry.composite.empty() ? "" : entry.composite + ".") + entry.key->text;
}

}  // namespace

bool Targets::has(const std::string& name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool Targets::has_all_of(const Entry& entry) const {
  return std::all_of(entry.names.begin(), entry.names.end(),
                     [&](const std::string& name) { return has(name); });
}

std::size_t find_dot(const std::string& path) {
  const std::vector<std::size_t> dots = dots_of(path);
  return dots.empty() ? path.npos : dots.back();
}

std::optional<Targets> find_targets(const std::string& written, Workshop& shop) {
  Targets targets{written, components_named(written, shop), {}};
  if (!targets.names.empty()) return targets;
  shop.refuse("unknown component '" + written + "'",
              base::suggestion(written, known_components(shop.document())));
  return std::nullopt;
}

std::optional<Targets> find_targets_of_path(const std::string& path, Workshop& shop) {
  for (const std::size_t dot : dots_of(path)) {
    Targets targets{path.substr(0, dot), components_named(path.substr(0, dot), shop),
                    path.substr(dot + 1)};
    if (!targets.names.empty() && !targets.rest.empty()) return targets;
  }
  const std::string name = path.substr(0, find_dot(path));
  shop.refuse("unknown component '" + name + "'",
              base::suggestion(name, known_components(shop.document())));
  return std::nullopt;
}

std::set<std::string> names_in(const Document& document) {
  const std::vector<std::string> components = known_components(document);
  std::set<std::string> names(components.begin(), components.end());
  for (const auto& connection : document.connections) {
    if (!connection.name.empty()) names.insert(connection.name);
  }
  return names;
}

const Value* find_property(const Document& document, const std::string& name,
                           const std::string& path) {
  for (const auto& component : document.components) {
    if (component.name == name) return find_value_at(component.properties, path);
  }
  for (const auto& composite : document.composites) {
    if (composite.name != name) continue;
    if (const Value* value = find_value_at(composite.parameters, path)) return value;
    for (const auto& one : composite.exports) {
      if (one.kind != document::ExportKind::kProperty || one.name != path) continue;
      return find_property(document, one.component, one.member);
    }
  }
  return nullptr;
}

std::string setting(const std::string& name, const std::string& path, const std::string& value) {
  return name + "." + path + "=" + value;
}

std::vector<Site> sites_in_force(const Targets& targets, const FindNode& find, const Workshop& shop,
                                 std::vector<std::string>& without) {
  std::vector<Site> sites;
  for (const std::string& name : targets.names) {
    Site last;
    for (const Entry* entry : shop.map().entries_of(name)) {
      if (const Node* node = find(*entry)) last = {entry, node};
    }
    const bool known = std::any_of(sites.begin(), sites.end(),
                                   [&](const Site& site) { return site.node == last.node; });
    if (last.node == nullptr) {
      without.push_back(name);
    } else if (!known) {
      sites.push_back(last);
    }
  }
  return sites;
}

bool is_open(const Site& site, const Targets& targets, const Workshop& shop) {
  return shop.may_change(*site.entry->file) && targets.has_all_of(*site.entry);
}

void refuse_site(const Site& site, const Targets& targets, Workshop& shop) {
  const Entry& entry = *site.entry;
  const Node& node = site.node == nullptr ? *entry.key : *site.node;
  if (!shop.require(*entry.file, node, "'" + key_of(entry) + "'")) return;
  shop.refuse(
      entry.file->place_of(node),
      "'" + key_of(entry) + "' says it for " + names_beside(entry, targets) + ", too",
      "name '" + key_of(entry) + "', or change '" + targets.written + "' alone with --override");
}

const Entry* find_whole_entry(const std::string& written, Workshop& shop) {
  const std::optional<Targets> targets = find_targets(written, shop);
  if (!targets) return nullptr;
  const std::vector<const Entry*> entries = shop.map().entries_of(targets->names.front());
  if (entries.empty() || entries.front()->changes) {
    shop.refuse("'" + written + "' is in an OROCOS file, which is not edited");
    return nullptr;
  }
  const Entry& entry = *entries.front();
  if (targets->has_all_of(entry) && entry.names.size() == targets->names.size()) return &entry;
  shop.refuse(entry.file->place_of(*entry.key),
              "'" + written + "' is not all of an entry: it stands in '" + entry.key->text + "'",
              "name the entry as the file has it");
  return nullptr;
}

namespace {

/// Says why nothing new of that component may be written.
void refuse_new(const std::string& name, const Targets& targets, Workshop& shop) {
  const std::vector<const Entry*> entries = shop.map().entries_of(name);
  if (entries.empty()) {
    shop.refuse("'" + name + "' is in an OROCOS file, which is not edited");
  } else {
    refuse_site({entries.back(), nullptr}, targets, shop);
  }
}

}  // namespace

const Entry* open_entry(const std::string& name, const Targets& targets, const Workshop& shop) {
  const SourceText* wanted = &shop.file_for_new();
  const auto rank = [&](const Entry& entry) {
    return std::pair(entry.file == wanted, entry.names.size());  // one for all of a range is best
  };
  const Entry* best = nullptr;
  for (const Entry* entry : shop.map().entries_of(name)) {
    if (!is_open({entry, nullptr}, targets, shop)) continue;
    if (best == nullptr || rank(*entry) >= rank(*best)) best = entry;
  }
  return best;
}

std::vector<const Entry*> entries_for_new(const std::vector<std::string>& without,
                                          const Targets& targets, Workshop& shop) {
  std::vector<const Entry*> found;
  for (const std::string& name : without) {
    const Entry* const open = open_entry(name, targets, shop);
    if (open == nullptr) {
      refuse_new(name, targets, shop);
      return {};
    }
    if (std::find(found.begin(), found.end(), open) == found.end()) found.push_back(open);
  }
  return found;
}

bool needs_override(const std::vector<Site>& sites, const std::vector<std::string>& without,
                    const Targets& targets, const Workshop& shop) {
  if (!shop.overrides()) return false;
  const bool open = std::all_of(sites.begin(), sites.end(),
                                [&](const Site& site) { return is_open(site, targets, shop); });
  return !open || std::any_of(without.begin(), without.end(), [&](const std::string& name) {
    return open_entry(name, targets, shop) == nullptr;
  });
}

const Entry* find_override(const Targets& targets, const Workshop& shop) {
  const Entry* found = nullptr;
  for (const Entry& entry : shop.map().entries()) {
    const bool same = entry.changes && entry.composite.empty() && targets.has_all_of(entry) &&
                      entry.names.size() == targets.names.size();
    if (same && entry.file == &shop.map().main()) found = &entry;
  }
  return found;
}

void add_override(const Targets& targets, const std::string& key, const Value& value,
                  Workshop& shop) {
  for (const std::string& name : targets.names) {
    const std::vector<const Entry*> entries = shop.map().entries_of(name);
    if (entries.empty() || entries.front()->composite.empty()) continue;
    shop.refuse("'" + name + "' is a part of composite '" + entries.front()->composite +
                    "', which no other file overrides",
                "change it in the composite, by --in " + entries.front()->file->path());
    return;
  }
  Value body = document::make_map();
  body.entries.push_back({"override", document::make_text("true"), {}, {}});
  body.entries.push_back({key, value, {}, {}});
  shop.add_to_section(shop.map().main(), "components", targets.written, body, 0);
}

const Node* find_map(const Entry& entry, const std::string& key) {
  const Node* map = find_value(entry.value, key);
  return map != nullptr && map->kind == Node::Kind::kMap ? map : nullptr;
}

void add_to_entry(const Entry& entry, const std::string& map, const std::string& name,
                  const Value& value, Workshop& shop) {
  const Node* there = find_value(entry.value, map);
  Value content = document::make_map();
  content.entries.push_back({name, value, {}, {}});
  Layout& layout = shop.layout(*entry.file);
  if (entry.value->kind != Node::Kind::kMap) {
    shop.refuse(entry.file->place_of(*entry.value), "'" + key_of(entry) + "' is an alias",
                "write it out there first");
  } else if (there == nullptr) {
    layout.add_entry(*entry.value, map, content);
  } else if (there->kind == Node::Kind::kMap) {
    layout.add_entry(*there, name, value);
  } else if (there->is_empty()) {
    layout.fill(*there, content, 0);
  } else {
    shop.refuse(entry.file->place_of(*there), "'" + map + "' is no map that can be added to",
                "write it out there first");
  }
}

}  // namespace armature::edit::internal
