// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"
#include "armature/edit/internal/element_text.hpp"
#include "armature/edit/internal/set_value.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {
namespace {

using document::Call;
using document::Document;
using document::Value;

constexpr const char* kCalls = "calls";

const Node* find_calls(const Entry& entry) { return find_value(entry.value, kCalls); }

std::vector<Value> calls_in(const Value& value) {
  return value.kind == Value::Kind::kList ? value.items : std::vector<Value>{value};
}

/// The value on one line, so that it can be compared.
std::string meant(const Value& value) {
  return document::flow_text(value, document::InBraces::kMeant);
}

/// Likewise of an item as its file has it.
std::string meant(const SourceText& file, const Node& item, const document::Limits& limits) {
  const std::string text = file.text().substr(item.begin, item.end - item.begin);
  base::Diagnostics ignored;  // the file has been read without mistakes
  return meant(document::parse_yaml_value(moved_lines(text, file.column(item.begin), 0), {}, limits,
                                          ignored));
}

/// Those of a list that differ become the new ones; comments at the others stay.
void rewrite_items(const SourceText& file, const Node& list, const std::vector<Value>& calls,
                   Workshop& shop) {
  Layout& layout = shop.layout(file);
  const std::vector<const Node*> items = items_of(&list);
  const auto same = [&](std::size_t item, std::size_t call) {
    return meant(file, *items[item], shop.before().limits) == meant(calls[call]);
  };
  const std::size_t most = std::min(items.size(), calls.size());
  std::size_t head = 0;
  while (head < most && same(head, head)) ++head;
  std::size_t tail = 0;
  while (tail < most - head && same(items.size() - 1 - tail, calls.size() - 1 - tail)) ++tail;
  const std::size_t both = most - head - tail;
  for (std::size_t i = head; i < head + both; ++i) layout.replace(*items[i], calls[i]);
  for (std::size_t i = head + both; i < items.size() - tail; ++i) layout.remove(*items[i]);
  for (std::size_t i = head + both; i < calls.size() - tail; ++i) {
    layout.insert_item(list, head + both, calls[i]);
  }
}

/// Without calls the key goes, too, unless another entry's would be seen then.
void write_calls(const Site& site, const Value& value, const std::vector<Value>& calls,
                 Workshop& shop) {
  const SourceText& file = *site.entry->file;
  if (site.node->kind == Node::Kind::kAlias) {
    return shop.refuse(file.place_of(*site.node), "the calls are an alias",
                       "write them out there first");
  }
  if (calls.empty() && !site.entry->changes) return shop.layout(file).remove(*site.node);
  if (calls.empty() || value.kind != Value::Kind::kList || site.node->kind != Node::Kind::kList ||
      site.node->children.empty()) {
    return shop.layout(file).replace(*site.node, value);
  }
  rewrite_items(file, *site.node, calls, shop);
}

void begin_calls(const Entry& entry, const Value& value, Workshop& shop) {
  if (entry.value->kind != Node::Kind::kMap) {
    return shop.refuse(entry.file->place_of(*entry.value), "the entry is an alias",
                       "write it out there first");
  }
  const bool own_lines = value.items.size() > 1;
  const bool has_activity = find_key(entry.value, "activity") != nullptr;
  shop.layout(*entry.file)
      .add_entry(*entry.value, kCalls, value, own_lines ? 1 : 0,
                 has_activity ? "activity" : "model");
}

void override_calls(const Targets& targets, const Value& value, Workshop& shop) {
  const Entry* entry = find_override(targets, shop);
  if (entry == nullptr) return add_override(targets, kCalls, value, shop);
  const Node* there = find_calls(*entry);
  Layout& layout = shop.layout(*entry->file);
  if (there != nullptr) return layout.replace(*there, value);
  layout.add_entry(*entry->value, kCalls, value);
}

/// Whether as many calls, with the same parameters, are there; whom they call is said by the scope.
bool are_as_asked(const std::vector<Call>& found, const std::vector<Value>& asked) {
  return std::equal(found.begin(), found.end(), asked.begin(), asked.end(),
                    [](const Call& call, const Value& value) {
                      const auto* with = document::find(value.entries, "with");
                      const std::size_t given = with == nullptr ? 0 : with->value.entries.size();
                      return call.with.size() == given;
                    });
}

/// The targets call what the files say then, and all else is as before.
Expectation expect_calls(const State& before, const Targets& targets,
                         const std::vector<Value>& asked, const std::string& refusal) {
  return [&before, targets, asked, refusal](const State& after, base::Diagnostics& diagnostics) {
    Document expected = before.document;
    for (auto& component : expected.components) {
      if (!targets.has(component.name)) continue;
      for (const auto& found : after.document.components) {
        if (found.name != component.name) continue;
        component.calls = found.calls;
        if (are_as_asked(found.calls, asked)) continue;
        diagnostics.error({before.file, 0, 0}, refusal + "it would have other calls");
      }
    }
    return expected;
  };
}

bool has_calls(const Targets& targets, const Document& document) {
  return std::any_of(document.components.begin(), document.components.end(),
                     [&](const auto& one) { return targets.has(one.name) && !one.calls.empty(); });
}

}  // namespace

void draft(const SetCalls& set, Workshop& shop) {
  const std::optional<Targets> targets = find_targets(set.component, shop);
  if (!targets) return;
  const auto value = value_of(set.calls, "calls of '" + set.component + "'", shop);
  if (!value) return;
  const std::vector<Value> calls = calls_in(*value);
  if (calls.empty() && !has_calls(*targets, shop.document())) {
    return shop.refuse("'" + set.component + "' has no calls");
  }
  std::vector<std::string> fresh;
  const std::vector<Site> sites = sites_in_force(*targets, find_calls, shop, fresh);
  shop.expect(expect_calls(shop.before(), *targets, calls, refusal_of(set, "")));
  if (needs_override(sites, fresh, *targets, shop)) return override_calls(*targets, *value, shop);
  for (const Site& site : sites) {
    if (!is_open(site, *targets, shop)) return refuse_site(site, *targets, shop);
    write_calls(site, *value, calls, shop);
  }
  if (calls.empty()) return;
  for (const Entry* entry : entries_for_new(fresh, *targets, shop)) {
    begin_calls(*entry, *value, shop);
  }
}

}  // namespace armature::edit::internal
