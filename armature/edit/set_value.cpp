// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/set_value.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/ranges.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"
#include "armature/edit/internal/activity_edits.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {

using document::Document;
using document::make_map;
using document::Value;

namespace {

/// Where the property stands in an entry's own map; nested ones below the names before them.
const Node* find_property_node(const Entry& entry, const std::string& path) {
  const Node* map = find_map(entry, "properties");
  std::string rest = path;
  while (map != nullptr) {
    if (const Node* value = find_value(map, rest)) return value;
    const std::size_t dot = rest.find('.');
    if (dot == rest.npos) return nullptr;
    map = find_value(map, rest.substr(0, dot));
    rest = rest.substr(dot + 1);
  }
  return nullptr;
}

/// `a.b` and a value as {a: {b: value}}.
document::Property nested(const std::string& path, const Value& value) {
  const std::size_t dot = path.find('.');
  if (dot == path.npos) return {path, value, {}, {}};
  Value map = make_map();
  map.entries.push_back(nested(path.substr(dot + 1), value));
  return {path.substr(0, dot), std::move(map), {}, {}};
}

/// Adds the property below those names of its path that the entry has already.
void add_property(const Entry& entry, const std::string& path, const Value& value, Workshop& shop) {
  const Node* map = find_map(entry, "properties");
  std::string rest = path;
  for (std::size_t dot = rest.find('.'); map != nullptr && dot != rest.npos; dot = rest.find('.')) {
    const Node* inner = find_value(map, rest.substr(0, dot));
    if (inner == nullptr || inner->kind != Node::Kind::kMap) break;
    map = inner;
    rest = rest.substr(dot + 1);
  }
  const Node* there = find_value(map, rest.substr(0, rest.find('.')));
  if (there != nullptr) {
    shop.refuse(entry.file->place_of(*there), "the value here is no map to add '" + rest + "' to");
    return;
  }
  const document::Property property = nested(rest, value);
  if (map != nullptr && rest != path) {
    shop.layout(*entry.file).add_entry(*map, property.name, property.value);
  } else {
    add_to_entry(entry, "properties", property.name, property.value, shop);
  }
}

/// What the command line would set to give the document the same.
Expectation expect_settings(const State& before, const Targets& targets, const Value& value,
                            const std::string& text) {
  return [&before, targets, value, text](const State& after, base::Diagnostics&) {
    std::vector<std::string> settings;
    for (const std::string& name : targets.names) {
      const Value* found = find_property(after.document, name, targets.rest);
      const bool computed = has_braces(value) && found != nullptr;
      settings.push_back(
          setting(name, targets.rest, computed ? document::flow_text(*found) : text));
    }
    return before.with(settings);
  };
}

void override_property(const Targets& targets, const Value& value, Workshop& shop) {
  const document::Property property = nested(targets.rest, value);
  if (const Entry* entry = find_override(targets, shop)) {
    add_property(*entry, targets.rest, value, shop);
    return;
  }
  Value properties = make_map();
  properties.entries.push_back(property);
  add_override(targets, "properties", properties, shop);
}

/// Writes the property where it stands, or where something new of the component may stand.
void write_property(const Targets& targets, const Value& value, Workshop& shop) {
  std::vector<std::string> fresh;
  const auto find = [&](const Entry& entry) { return find_property_node(entry, targets.rest); };
  const std::vector<Site> sites = sites_in_force(targets, find, shop, fresh);
  if (needs_override(sites, fresh, targets, shop)) return override_property(targets, value, shop);
  for (const Site& site : sites) {
    if (!is_open(site, targets, shop)) return refuse_site(site, targets, shop);
    shop.layout(*site.entry->file).replace(*site.node, value);
  }
  for (const Entry* entry : entries_for_new(fresh, targets, shop)) {
    add_property(*entry, targets.rest, value, shop);
  }
}

/// The file with the last word on a parameter, and the key there.
std::pair<const SourceText*, const Node*> find_parameter(const std::string& name,
                                                         const SourceMap& map) {
  const auto& files = map.files();
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    const Node* key = find_key(find_value((*file)->root(), "parameters"), name);
    if (key != nullptr) return {file->get(), key};
  }
  return {nullptr, nullptr};
}

void refuse_unknown_parameter(const std::string& name, Workshop& shop) {
  std::vector<std::string> known;
  for (const auto& parameter : shop.document().parameters) known.push_back(parameter.name);
  const std::string near = base::suggestion(name, known).text;
  shop.refuse("unknown parameter '" + name + "'",
              (near.empty() ? "" : near + "; ") +
                  "a new one is an edit of its own, and properties are Component.Property");
}

Expectation expect_parameter(const State& before, const std::string& name) {
  return [&before, name](const State& after, base::Diagnostics&) {
    const auto* found = document::find(after.document.parameters, name);
    if (found != nullptr) return before.with({name + "=" + document::flow_text(found->value)});
    Document expected = before.document;
    std::erase_if(expected.parameters, [&](const auto& one) { return one.name == name; });
    return expected;
  };
}

void set_parameter(const Set& set, const Value& value, Workshop& shop) {
  const auto [file, key] = find_parameter(set.path, shop.map());
  if (file == nullptr) return refuse_unknown_parameter(set.path, shop);
  const SourceText& main = shop.map().main();
  if (shop.overrides() && !shop.may_change(*file)) {
    shop.add_to_section(main, "parameters", set.path, value, 0);
  } else if (shop.require(*file, *key, "parameter '" + set.path + "'")) {
    const Node* parameters = find_value(file->root(), "parameters");
    shop.layout(*file).replace(*find_value(parameters, set.path), value);
  }
  shop.expect([&before = shop.before(), set, value](const State& after, base::Diagnostics&) {
    const auto* found = document::find(after.document.parameters, set.path);
    const bool computed = has_braces(value) && found != nullptr;
    return before.with(
        {set.path + "=" + (computed ? document::flow_text(found->value) : set.value)});
  });
}

void unset_parameter(const std::string& name, Workshop& shop) {
  const auto [file, key] = find_parameter(name, shop.map());
  if (file == nullptr) return refuse_unknown_parameter(name, shop);
  if (!shop.require(*file, *key, "parameter '" + name + "'")) return;
  shop.layout(*file).remove(*key);
  shop.expect(expect_parameter(shop.before(), name));
}

/// Takes the value at the path out, and maps that have nothing then.
void erase_at(std::vector<document::Property>& properties, const std::string& path) {
  const std::size_t dot = path.find('.');
  const bool whole = document::find(properties, path) != nullptr || dot == path.npos;
  if (!whole) {
    auto* outer = document::find(properties, path.substr(0, dot));
    if (outer == nullptr) return;
    erase_at(outer->value.entries, path.substr(dot + 1));
    if (!outer->value.entries.empty()) return;
  }
  const std::string name = whole ? path : path.substr(0, dot);
  std::erase_if(properties, [&](const auto& one) { return one.name == name; });
}

/// A value of a composite is that of its part, if it exports it.
void erase_property(Document& document, const std::string& name, const std::string& path) {
  for (auto& component : document.components) {
    if (component.name == name) erase_at(component.properties, path);
  }
  for (const auto& composite : document.composites) {
    if (composite.name != name) continue;
    for (const auto& one : composite.exports) {
      if (one.name == path) erase_property(document, one.component, one.member);
    }
  }
}

/// What the component has without the property: what another entry says, or nothing.
Expectation expect_unset(const State& before, const Targets& targets) {
  return [&before, targets](const State& after, base::Diagnostics& diagnostics) {
    std::vector<std::string> settings;
    std::vector<std::string> gone;
    for (const std::string& name : targets.names) {
      const Value* found = find_property(after.document, name, targets.rest);
      if (found == nullptr) {
        gone.push_back(name);
      } else {
        settings.push_back(setting(name, targets.rest, document::flow_text(*found)));
        diagnostics.note(found->where,
                         setting(name, targets.rest, document::to_text(*found)) + " is seen now");
      }
    }
    Document expected = settings.empty() ? before.document : before.with(settings);
    for (const std::string& name : gone) erase_property(expected, name, targets.rest);
    return expected;
  };
}

/// An entry that would override nothing any more goes as a whole.
const Node* what_to_remove(const Site& site) {
  const Node* properties = find_map(*site.entry, "properties");
  const bool last =
      properties != nullptr && properties->children.size() == 2 && site.node->parent == properties;
  const bool nothing_else = site.entry->value->children.size() == 4;
  return site.entry->changes && last && nothing_else ? site.entry->key : site.node;
}

void refuse_unset(const std::string& name, const std::string& path, Workshop& shop) {
  const Value* value = find_property(shop.document(), name, path);
  const std::string what = "no entry of '" + name + "' sets '" + path + "'";
  if (value == nullptr) return shop.refuse(what, "it has its default already");
  shop.refuse(value->where, what + ", which it has from there", "change that place");
}

void unset_property(const Targets& targets, Workshop& shop) {
  std::vector<std::string> without;
  const auto find = [&](const Entry& entry) { return find_property_node(entry, targets.rest); };
  const std::vector<Site> sites = sites_in_force(targets, find, shop, without);
  if (!without.empty()) return refuse_unset(without.front(), targets.rest, shop);
  shop.expect(expect_unset(shop.before(), targets));
  if (needs_override(sites, {}, targets, shop)) {
    Value removal = make_map();
    removal.entries.push_back({"remove", document::make_text("true"), {}, {}});
    return override_property(targets, removal, shop);
  }
  for (const Site& site : sites) {
    if (!is_open(site, targets, shop)) return refuse_site(site, targets, shop);
    shop.layout(*site.entry->file).remove(*what_to_remove(site));
  }
}

}  // namespace

bool has_braces(const Value& value) {
  if (value.literal) return false;
  const std::string& text = value.text;
  const bool own = text.find("${") != text.npos || document::has_range(text) ||
                   !document::number_offsets(text).empty();
  return own || std::any_of(value.items.begin(), value.items.end(), has_braces) ||
         std::any_of(value.entries.begin(), value.entries.end(), [](const auto& entry) {
           return has_braces(document::make_text(entry.name)) || has_braces(entry.value);
         });
}

std::optional<Value> value_of(const std::string& text, const std::string& what, Workshop& shop) {
  base::Diagnostics found;
  Value value = document::parse_yaml_value(text, {}, shop.before().limits, found);
  if (!found.ok()) {
    shop.refuse(found.all().front().message, found.all().front().hint);
    return std::nullopt;
  }
  if (value.kind != Value::Kind::kNone) return value;
  shop.refuse(what + " has no value", "an empty text is \"\"");
  return std::nullopt;
}

void draft(const Set& set, Workshop& shop) {
  const std::optional<Value> value = value_of(set.value, "'" + set.path + "'", shop);
  if (!value) return;
  if (find_dot(set.path) == set.path.npos) return set_parameter(set, *value, shop);
  const std::optional<Targets> targets = find_targets_of_path(set.path, shop);
  if (!targets) return;
  if (is_activity(targets->rest)) return set_activity(*targets, *value, set.value, shop);
  if (!document::is_dotted_name(targets->rest)) {
    return shop.refuse("property '" + targets->rest + "' is not a valid name");
  }
  shop.expect(expect_settings(shop.before(), *targets, *value, set.value));
  write_property(*targets, *value, shop);
}

void draft(const Unset& unset, Workshop& shop) {
  if (find_dot(unset.path) == unset.path.npos) return unset_parameter(unset.path, shop);
  const std::optional<Targets> targets = find_targets_of_path(unset.path, shop);
  if (!targets) return;
  if (is_activity(targets->rest)) return unset_activity(*targets, shop);
  unset_property(*targets, shop);
}

}  // namespace armature::edit::internal
