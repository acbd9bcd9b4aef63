// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/connection_items.hpp"

namespace armature::edit::internal {
namespace {

using document::Connection;
using document::Document;
using document::make_map;
using document::make_text;
using document::Value;

Expectation expect_disconnected(const State& before, const WantedConnection& wanted,
                                const std::vector<const ConnectionEntry*>& items) {
  return [&before, wanted, items](const State&, base::Diagnostics&) {
    Document expected = before.document;
    const auto is_of_items = [&](const ConnectionEntry* entry) {
      return std::find(items.begin(), items.end(), entry) != items.end();
    };
    std::erase_if(expected.connections, [&](const Connection& one) {
      const ConnectionEntry* entry = before.map->entry_of(one);
      return entry != nullptr && is_of_items(entry) && is_wanted(wanted, *entry, one);
    });
    std::erase_if(expected.named_connections, [&](const document::NamedConnection& one) {
      return wanted.to.empty() && one.name == wanted.from && is_of_items(before.map->entry_of(one));
    });
    return expected;
  };
}

/// `{from: A.Out, to: B.In, remove: true}`.
Value removal_of(const WantedConnection& wanted) {
  Value map = make_map();
  if (wanted.to.empty()) {
    map.entries.push_back({"name", make_text(wanted.from), {}, {}});
  } else {
    map.entries.push_back({"from", make_text(wanted.from), {}, {}});
    map.entries.push_back({"to", make_text(wanted.to), {}, {}});
  }
  map.entries.push_back({"remove", make_text("true"), {}, {}});
  return map;
}

}  // namespace

void draft(const Disconnect& disconnect, Workshop& shop) {
  const WantedConnection wanted{disconnect.from, disconnect.to};
  const std::vector<const ConnectionEntry*> items = find_items(wanted, shop);
  if (items.empty()) return refuse_unknown(wanted, shop);
  shop.expect(expect_disconnected(shop.before(), wanted, items));
  for (const ConnectionEntry* entry : items) {
    const bool all = is_all_wanted(wanted, *entry, shop);
    if (shop.overrides() && (!all || !shop.may_change(*entry->file))) {
      return shop.add_item_to_section(shop.map().main(), "connections", removal_of(wanted));
    }
    const std::string text =
        entry->file->text().substr(entry->item->begin, entry->item->end - entry->item->begin);
    if (!shop.require(*entry->file, *entry->item, "the connection")) return;
    if (!all) {
      return shop.refuse(entry->file->place_of(*entry->item), "'" + text + "' makes others, too",
                         "name it as it is written, or remove one alone with --override");
    }
    shop.layout(*entry->file).remove(*entry->item);
  }
}

}  // namespace armature::edit::internal
