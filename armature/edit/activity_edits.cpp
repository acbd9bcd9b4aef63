// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/activity_edits.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "armature/document/reader.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/set_value.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::make_map;
using document::make_text;
using document::Value;

constexpr const char* kActivity = "activity";
constexpr std::array<const char*, 3> kKinds = {"periodic", "triggered", "sequential"};

bool is_kind(const std::string& key) {
  return std::find(kKinds.begin(), kKinds.end(), key) != kKinds.end();
}

/// `priority` of `activity.priority`; empty for the whole activity.
std::string key_in(const Targets& targets) {
  const std::size_t dot = targets.rest.find('.');
  return dot == targets.rest.npos ? "" : targets.rest.substr(dot + 1);
}

/// As the document would have the activity as a whole.
document::Activity activity_of(const Value& value, document::Priorities priorities,
                               base::Diagnostics& diagnostics) {
  document::Activity activity;
  const document::ValueReader reader(kActivity, diagnostics);
  document::read_activity(value, reader, priorities, activity);
  return activity;
}

/// Their activities are what the files say then, and all else is as before.
Document with_activities_of(const Document& after, Document before, const Targets& targets) {
  for (auto& component : before.components) {
    if (!targets.has(component.name)) continue;
    const auto found = std::find_if(after.components.begin(), after.components.end(),
                                    [&](const auto& one) { return one.name == component.name; });
    if (found != after.components.end()) component.activity = found->activity;
  }
  return before;
}

Expectation expect_activity(const State& before, const Targets& targets, const Value& value,
                            const std::string& text) {
  return [&before, targets, value, text](const State& after, base::Diagnostics& diagnostics) {
    if (has_braces(value)) return with_activities_of(after.document, before.document, targets);
    std::vector<std::string> settings;
    for (const std::string& name : targets.names) {
      settings.push_back(setting(name, targets.rest, text));
    }
    if (!key_in(targets).empty()) return before.with(settings);
    Document expected = before.document;
    for (auto& component : expected.components) {
      if (!targets.has(component.name)) continue;
      component.activity = activity_of(value, expected.priorities, diagnostics);
    }
    return expected;
  };
}

/// The activity's map with one setting more, of an activity that is a word: `triggered`.
Value with_setting(const Node& word, const std::string& key, const Value& value) {
  Value map = make_map();
  if (!is_kind(key)) map.entries.push_back({word.text, make_text("true"), {}, {}});
  map.entries.push_back({key, value, {}, {}});
  return map;
}

void write_setting(const Site& site, const std::string& key, const Value& value, Workshop& shop) {
  Layout& layout = shop.layout(*site.entry->file);
  const Node& activity = *site.node;
  if (activity.kind == Node::Kind::kScalar) {
    return layout.replace(activity, with_setting(activity, key, value));
  }
  if (activity.kind != Node::Kind::kMap) {
    return shop.refuse(site.entry->file->place_of(activity), "the activity is an alias",
                       "write it out there first");
  }
  const Node* there = find_key(&activity, key);
  for (const char* kind : kKinds) {
    if (is_kind(key) && there == nullptr) there = find_key(&activity, kind);
  }
  if (there == nullptr) return layout.add_entry(activity, key, value);
  if (there->text != key) layout.replace(*there, make_text(key));
  layout.replace(*find_value(&activity, there->text), value);
}

void add_activity(const Entry& entry, const Value& activity, Workshop& shop) {
  if (entry.value->kind != Node::Kind::kMap) {
    shop.refuse(entry.file->place_of(*entry.value), "the entry is an alias",
                "write it out there first");
    return;
  }
  shop.layout(*entry.file).add_entry(*entry.value, kActivity, activity, 0, "model");
}

const Node* find_activity(const Entry& entry) { return find_value(entry.value, kActivity); }

/// Whether each of the targets is a component; composites have no activity.
bool require_components(const Targets& targets, Workshop& shop) {
  for (const auto& composite : shop.document().composites) {
    if (!targets.has(composite.name)) continue;
    shop.refuse("'" + composite.name + "' is a composite, whose parts have activities");
    return false;
  }
  return true;
}

}  // namespace

bool is_activity(const std::string& path) {
  return path == kActivity || path.starts_with(std::string(kActivity) + ".");
}

void set_activity(const Targets& targets, const Value& value, const std::string& text,
                  Workshop& shop) {
  if (!require_components(targets, shop)) return;
  const std::string key = key_in(targets);
  std::vector<std::string> fresh;
  const std::vector<Site> sites = sites_in_force(targets, find_activity, shop, fresh);
  shop.expect(expect_activity(shop.before(), targets, value, text));
  Value whole = key.empty() ? value : make_map();
  if (!key.empty()) whole.entries.push_back({key, value, {}, {}});
  if (needs_override(sites, fresh, targets, shop)) {
    if (!key.empty() && !sites.empty()) {
      return shop.refuse(
          "an activity is overridden as a whole",
          "for example --set '" + targets.written + ".activity={periodic: 10 ms, priority: 70}'");
    }
    const Entry* entry = find_override(targets, shop);
    if (entry == nullptr) return add_override(targets, kActivity, whole, shop);
    return add_activity(*entry, whole, shop);
  }
  for (const Site& site : sites) {
    if (!is_open(site, targets, shop)) return refuse_site(site, targets, shop);
    if (key.empty()) {
      shop.layout(*site.entry->file).replace(*site.node, value);
    } else {
      write_setting(site, key, value, shop);
    }
  }
  for (const Entry* entry : entries_for_new(fresh, targets, shop)) {
    add_activity(*entry, whole, shop);
  }
}

void unset_activity(const Targets& targets, Workshop& shop) {
  if (!require_components(targets, shop)) return;
  const std::string key = key_in(targets);
  std::vector<std::string> without;
  const auto find = [&](const Entry& entry) {
    const Node* activity = find_activity(entry);
    return key.empty() ? activity : find_value(activity, key);
  };
  const std::vector<Site> sites = sites_in_force(targets, find, shop, without);
  if (!without.empty()) {
    return shop.refuse("no file sets '" + targets.rest + "' of '" + without.front() + "'");
  }
  for (const Site& site : sites) {
    if (!is_open(site, targets, shop)) return refuse_site(site, targets, shop);
    shop.layout(*site.entry->file).remove(*site.node);
  }
  shop.expect([&before = shop.before(), targets](const State& after, base::Diagnostics&) {
    return with_activities_of(after.document, before.document, targets);
  });
}

}  // namespace armature::edit::internal
