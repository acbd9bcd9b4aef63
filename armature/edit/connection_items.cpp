// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/connection_items.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/reader.hpp"
#include "armature/document/tree.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"
#include "armature/edit/internal/set_value.hpp"

namespace armature::edit::internal {

using document::Connection;
using document::make_map;
using document::make_text;
using document::Value;

namespace {

/// An end without the blanks that the file may have around it.
std::string trimmed_text(const std::string& text) { return std::string(document::trimmed(text)); }

const Node* end_at(const Node& item, const char* key, const char* other) {
  const Node* value = find_value(&item, key);
  return value == nullptr ? find_value(&item, other) : value;
}

std::string text_at(const Node& item, const char* key, const char* other) {
  const Node* value = end_at(item, key, other);
  return value == nullptr ? "" : trimmed_text(value->text);
}

bool is_meant(const WantedConnection& wanted, const WrittenEnds& ends) {
  if (wanted.to.empty()) return ends.name == wanted.from && !ends.name.empty();
  return ends.from == wanted.from && ends.to == wanted.to;
}

bool is_meant(const WantedConnection& wanted, const Connection& one) {
  if (wanted.to.empty()) return one.name == wanted.from;
  return document::to_text(one.from) == wanted.from && document::to_text(one.to) == wanted.to;
}

bool is_command(const Value& settings) {
  return document::find(settings.entries, "name") != nullptr ||
         document::find(settings.entries, "with") != nullptr;
}

}  // namespace

WrittenEnds ends_of(const Node& item) {
  if (item.kind == Node::Kind::kMap) {
    return {text_at(item, "from", "on"), text_at(item, "to", "do"), text_at(item, "name", "")};
  }
  const std::size_t arrow = item.text.find("->");
  if (arrow == item.text.npos) return {};
  return {trimmed_text(item.text.substr(0, arrow)), trimmed_text(item.text.substr(arrow + 2)), {}};
}

void write_ends(const ConnectionEntry& entry, const std::string& from, const std::string& to,
                Workshop& shop) {
  Layout& layout = shop.layout(*entry.file);
  const Node& item = *entry.item;
  if (item.kind != Node::Kind::kMap) return layout.replace(item, make_text(from + " -> " + to));
  const auto write = [&](const char* key, const char* other, const std::string& text) {
    const Node* end = end_at(item, key, other);
    if (end != nullptr && trimmed_text(end->text) != text) layout.replace(*end, make_text(text));
  };
  write("from", "on", from);
  write("to", "do", to);
}

std::vector<const ConnectionEntry*> find_items(const WantedConnection& wanted,
                                               const Workshop& shop) {
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

void refuse_unknown(const WantedConnection& wanted, Workshop& shop) {
  std::vector<std::string> known;
  for (const Connection& one : shop.document().connections) {
    known.push_back(document::to_text(one.from) + " -> " + document::to_text(one.to));
  }
  shop.refuse("there is no such connection", base::suggestion(wanted.text(), known));
}

bool is_wanted(const WantedConnection& wanted, const ConnectionEntry& entry,
               const Connection& one) {
  return is_meant(wanted, ends_of(*entry.item)) || is_meant(wanted, one);
}

bool is_all_wanted(const WantedConnection& wanted, const ConnectionEntry& entry,
                   const Workshop& shop) {
  const auto& all = shop.document().connections;
  return std::all_of(all.begin(), all.end(), [&](const Connection& one) {
    return shop.map().entry_of(one) != &entry || is_wanted(wanted, entry, one);
  });
}

Value connection_item(const std::string& from, const std::string& to, const Value& settings) {
  if (settings.entries.empty()) return make_text(from + " -> " + to);
  Value map = make_map();
  const bool command = is_command(settings);
  map.entries.push_back({command ? "on" : "from", make_text(from), {}, {}});
  map.entries.push_back({command ? "do" : "to", make_text(to), {}, {}});
  for (const document::Property& setting : settings.entries) map.entries.push_back(setting);
  return map;
}

std::optional<Value> connection_settings(const std::string& written, Workshop& shop) {
  if (written.empty()) return make_map();
  const bool in_braces = written.starts_with('{');
  const std::string text = in_braces ? written : "{" + written + "}";
  std::optional<Value> settings = value_of(text, "the connection", shop);
  if (settings && settings->kind == Value::Kind::kMap) return settings;
  if (settings)
    shop.refuse("settings of a connection must be keys with values", "policy: {fifo: 8}");
  return std::nullopt;
}

std::optional<Connection> plain_settings(const Value& settings) {
  if (has_braces(settings)) return std::nullopt;
  base::Diagnostics ignored;  // the new text is read with the same reader
  Value item = make_map();
  item.entries = settings.entries;
  item.entries.push_back({"from", make_text("A.x"), {}, {}});
  item.entries.push_back({"to", make_text("A.y"), {}, {}});
  const auto read = document::read_connection(item, ignored);
  const auto* directed = read ? std::get_if<Connection>(&*read) : nullptr;
  return directed == nullptr ? std::nullopt : std::optional(*directed);
}

bool has_settings(const Connection& connection, const std::optional<Connection>& settings) {
  if (!settings) return true;
  Value found = make_map();
  Value wanted = make_map();
  document::add_policy(connection.policy, found);
  document::add_policy(settings->policy, wanted);
  return document::flow_text(found) == document::flow_text(wanted) &&
         connection.name == settings->name && connection.with.size() == settings->with.size();
}

}  // namespace armature::edit::internal
