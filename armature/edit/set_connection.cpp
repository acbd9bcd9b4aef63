// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>

#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/connection_items.hpp"

namespace armature::edit::internal {
namespace {

using document::Connection;
using document::Document;
using document::Value;

bool is_end(std::string_view key) {
  return key == "from" || key == "to" || key == "on" || key == "do";
}

/// Each key of the settings as it is to be, without those that they do not have.
void write_settings(const ConnectionEntry& entry, const SetConnection& set, const Value& settings,
                    Workshop& shop) {
  Layout& layout = shop.layout(*entry.file);
  const Node& item = *entry.item;
  if (item.kind != Node::Kind::kMap) {
    const std::size_t arrow = item.text.find("->");
    const std::string from{document::trimmed(item.text.substr(0, arrow))};
    const std::string to{document::trimmed(item.text.substr(arrow + 2))};
    return layout.replace(item, connection_item(from, to, settings));
  }
  for (std::size_t i = 0; i + 1 < item.children.size(); i += 2) {
    const Node& key = *item.children[i];
    const bool stays = is_end(key.text) || document::find(settings.entries, key.text) != nullptr;
    if (!stays) layout.remove(key);
  }
  for (const document::Property& setting : settings.entries) {
    const Node* there = find_value(&item, setting.name);
    if (is_end(setting.name)) {
      return shop.refuse("'" + setting.name + "' is an end of the connection, no setting of it",
                         "disconnect " + set.from + " and connect another");
    }
    if (there != nullptr) {
      layout.replace(*there, setting.value);
    } else {
      layout.add_entry(item, setting.name, setting.value);
    }
  }
}

/// The same connections in the same order, those of the items with their new settings.
Expectation expect_settings_of(const State& before,
                               const std::vector<const ConnectionEntry*>& items,
                               const SetConnection& set, const Value& settings) {
  return [&before, items, set, wanted = plain_settings(settings)](const State& after,
                                                                  base::Diagnostics& diagnostics) {
    Document expected = before.document;
    const auto& found = after.document.connections;
    for (std::size_t i = 0; i < std::min(found.size(), expected.connections.size()); ++i) {
      Connection& one = expected.connections[i];
      const ConnectionEntry* entry = before.map->entry_of(one);
      if (std::find(items.begin(), items.end(), entry) == items.end()) continue;
      if (!has_settings(found[i], wanted)) {
        diagnostics.error({before.file, 0, 0}, refusal_of(set, "it would have other settings"));
      }
      one.policy = found[i].policy;
      one.name = found[i].name;
      one.with = found[i].with;
    }
    return expected;
  };
}

}  // namespace

void draft(const SetConnection& set, Workshop& shop) {
  const WantedConnection wanted{set.from, set.to};
  const std::optional<Value> settings = connection_settings(set.settings, shop);
  if (!settings) return;
  const std::vector<const ConnectionEntry*> items = find_items(wanted, shop);
  if (items.empty()) return refuse_unknown(wanted, shop);
  shop.expect(expect_settings_of(shop.before(), items, set, *settings));
  for (const ConnectionEntry* entry : items) {
    if (!shop.require(*entry->file, *entry->item, "the connection")) return;
    if (!is_all_wanted(wanted, *entry, shop)) {
      return shop.refuse(entry->file->place_of(*entry->item), "it makes others, too",
                         "name the connection as it is written");
    }
    write_settings(*entry, set, *settings, shop);
  }
}

}  // namespace armature::edit::internal
