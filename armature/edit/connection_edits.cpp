// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/reader.hpp"
#include "armature/document/tree.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"
#include "armature/edit/internal/set_value.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {
namespace {

using document::Connection;
using document::Document;
using document::make_map;
using document::make_text;
using document::Value;

bool is_command(const Value& settings) {
  return document::find(settings.entries, "name") != nullptr ||
         document::find(settings.entries, "with") != nullptr;
}

/// `A.x -> B.y`, or a map if there is more to say.
Value item_of(const Connect& connect, const Value& settings) {
  if (settings.entries.empty()) return make_text(connect.from + " -> " + connect.to);
  Value map = make_map();
  const bool command = is_command(settings);
  map.entries.push_back({command ? "on" : "from", make_text(connect.from), {}, {}});
  map.entries.push_back({command ? "do" : "to", make_text(connect.to), {}, {}});
  for (const document::Property& setting : settings.entries) map.entries.push_back(setting);
  return map;
}

/// `policy: {fifo: 8}, max_age: 30 ms` as a map.
std::optional<Value> settings_of(const Connect& connect, Workshop& shop) {
  if (connect.settings.empty()) return make_map();
  const bool in_braces = connect.settings.starts_with('{');
  const std::string text = in_braces ? connect.settings : "{" + connect.settings + "}";
  std::optional<Value> settings = value_of(text, "the connection", shop);
  if (settings && settings->kind == Value::Kind::kMap) return settings;
  if (settings) shop.refuse("settings of a connection must be keys with values", "policy: {fifo: 8}");
  return std::nullopt;
}

/// The item that the edit has added: the last one of the list.
const Node* added_item(const SourceMap& map, const std::string& path) {
  const SourceText* file = map.file(path);
  const auto items =
      items_of(find_value(file == nullptr ? nullptr : file->root(), "connections"));
  return items.empty() ? nullptr : items.back();
}

void check_end(const document::Endpoint& end, const std::set<std::string>& known,
               const std::string& what, base::Diagnostics& diagnostics) {
  if (known.contains(end.component)) return;
  diagnostics.error({}, what + " is refused: unknown component '" + end.component + "'",
                    base::suggestion(end.component, {known.begin(), known.end()}));
}

/// All as before, and connections from that item, between components that there are.
Expectation expect_connected(const State& before, const Connect& connect, const std::string& path) {
  return [&before, connect, path](const State& after, base::Diagnostics& diagnostics) {
    const std::string what = to_text(Change(connect));
    const Node* item = added_item(*after.map, path);
    const std::set<std::string> known = names_in(after.document);
    Document others = after.document;
    const std::size_t count = others.connections.size();
    std::erase_if(others.connections, [&](const Connection& one) {
      const ConnectionEntry* entry = after.map->entry_of(one);
      if (item == nullptr || entry == nullptr || entry->item != item) return false;
      check_end(one.from, known, what, diagnostics);
      check_end(one.to, known, what, diagnostics);
      return true;
    });
    const bool several = has_braces(make_text(connect.from + connect.to));
    const std::size_t added = count - others.connections.size();
    if (added == 0 || (added > 1 && !several)) {
      diagnostics.error({}, what + " is refused: " + std::to_string(added) +
                                " connections would come of it");
    }
    for (const std::string& other : differences(before.document, others)) {
      diagnostics.error({}, what + " is refused: " + other + " would change");
    }
    return after.document;
  };
}

/// An end without the blanks that the file may have around it.
std::string trimmed_text(const std::string& text) { return std::string(document::trimmed(text)); }

/// The ends of an item as written, or its name; empty if it has none.
struct WrittenEnds {
  std::string from;
  std::string to;
  std::string name;
};

std::string text_at(const Node* item, const char* key, const char* other) {
  const Node* value = find_value(item, key);
  if (value == nullptr) value = find_value(item, other);
  return value == nullptr ? "" : trimmed_text(value->text);
}

WrittenEnds ends_of(const Node& item) {
  if (item.kind == Node::Kind::kMap) {
    return {text_at(&item, "from", "on"), text_at(&item, "to", "do"), text_at(&item, "name", "")};
  }
  const std::size_t arrow = item.text.find("->");
  if (arrow == item.text.npos) return {};
  return {trimmed_text(item.text.substr(0, arrow)), trimmed_text(item.text.substr(arrow + 2)), {}};
}

bool is_meant(const Disconnect& wanted, const WrittenEnds& ends) {
  if (wanted.to.empty()) return ends.name == wanted.from && !ends.name.empty();
  return ends.from == wanted.from && ends.to == wanted.to;
}

bool is_meant(const Disconnect& wanted, const Connection& one) {
  if (wanted.to.empty()) return one.name == wanted.from;
  return document::to_text(one.from) == wanted.from && document::to_text(one.to) == wanted.to;
}

/// The items that have or make the connection, each once.
std::vector<const ConnectionEntry*> find_items(const Disconnect& wanted, const Workshop& shop) {
  std::vector<const ConnectionEntry*> found;
  for (const ConnectionEntry& entry : shop.map().connections()) {
    const bool removal = find_value(entry.item, "remove") != nullptr;
    if (!removal && is_meant(wanted, ends_of(*entry.item))) found.push_back(&entry);
  }
  if (!found.empty()) return found;
  for (const Connection& one : shop.document().connections) {
    const ConnectionEntry* entry = is_meant(wanted, one) ? shop.map().entry_of(one) : nullptr;
    const bool known = std::find(found.begin(), found.end(), entry) != found.end();
    if (entry != nullptr && !known) found.push_back(entry);
  }
  return found;
}

void refuse_unknown(const Disconnect& wanted, Workshop& shop) {
  std::vector<std::string> known;
  for (const Connection& one : shop.document().connections) {
    known.push_back(document::to_text(one.from) + " -> " + document::to_text(one.to));
  }
  const std::string text = wanted.from + (wanted.to.empty() ? "" : " -> " + wanted.to);
  shop.refuse("there is no such connection", base::suggestion(text, known));
}

/// The connections of the document that the edit is about, whichever items make them.
bool concerns(const Disconnect& wanted, const ConnectionEntry& entry, const Connection& one) {
  return is_meant(wanted, ends_of(*entry.item)) || is_meant(wanted, one);
}

Expectation expect_disconnected(const State& before, const Disconnect& wanted,
                                const std::vector<const ConnectionEntry*>& items) {
  return [&before, wanted, items](const State&, base::Diagnostics&) {
    Document expected = before.document;
    const auto is_of_items = [&](const ConnectionEntry* entry) {
      return std::find(items.begin(), items.end(), entry) != items.end();
    };
    std::erase_if(expected.connections, [&](const Connection& one) {
      const ConnectionEntry* entry = before.map->entry_of(one);
      return entry != nullptr && is_of_items(entry) && concerns(wanted, *entry, one);
    });
    std::erase_if(expected.named_connections, [&](const document::NamedConnection& one) {
      return wanted.to.empty() && one.name == wanted.from && is_of_items(before.map->entry_of(one));
    });
    return expected;
  };
}

/// `{from: A.Out, to: B.In, remove: true}`.
Value removal_of(const Disconnect& wanted) {
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

/// Whether all that the item makes is meant.
bool is_all_meant(const Disconnect& wanted, const ConnectionEntry& entry, const Workshop& shop) {
  const auto& all = shop.document().connections;
  return std::all_of(all.begin(), all.end(), [&](const Connection& one) {
    return shop.map().entry_of(one) != &entry || concerns(wanted, entry, one);
  });
}

}  // namespace

void draft(const Connect& connect, Workshop& shop) {
  const std::optional<Value> settings = settings_of(connect, shop);
  const SourceText* file = shop.file_for_new();
  if (!settings || file == nullptr) return;
  shop.add_item_to_section(*file, "connections", item_of(connect, *settings));
  shop.expect(expect_connected(shop.before(), connect, file->path()));
}

void draft(const Disconnect& disconnect, Workshop& shop) {
  const std::vector<const ConnectionEntry*> items = find_items(disconnect, shop);
  if (items.empty()) return refuse_unknown(disconnect, shop);
  shop.expect(expect_disconnected(shop.before(), disconnect, items));
  for (const ConnectionEntry* entry : items) {
    const bool all = is_all_meant(disconnect, *entry, shop);
    if (shop.overrides() && (!all || !shop.may_change(*entry->file))) {
      return shop.add_item_to_section(shop.map().main(), "connections", removal_of(disconnect));
    }
    const std::string text = entry->file->text().substr(entry->item->begin,
                                                        entry->item->end - entry->item->begin);
    if (!shop.require(*entry->file, *entry->item, "the connection")) return;
    if (!all) {
      return shop.refuse(entry->file->place_of(*entry->item),
                         "'" + text + "' makes others, too",
                         "name it as it is written, or remove one alone with --override");
    }
    shop.layout(*entry->file).remove(*entry->item);
  }
}

}  // namespace armature::edit::internal
