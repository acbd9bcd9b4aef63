// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/set_value.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::make_list;
using document::make_text;
using document::Value;

const Node* find_peers(const Entry& entry) { return find_value(entry.value, "peers"); }

/// The peer in a list, or under its own name in a map.
const Node* find_peer(const Entry& entry, const std::string& peer) {
  for (const char* key : {"peers", "superiors"}) {
    for (const Node* item : items_of(find_value(entry.value, key))) {
      if (item->kind == Node::Kind::kScalar && item->text == peer) return item;
      if (const Node* named = find_value(item, peer)) return named;
    }
  }
  return nullptr;
}

/// One more in a list, which is made of a single one if need be.
void add_to_list(const Entry& entry, const Node& list, const std::string& peer, Workshop& shop) {
  Layout& layout = shop.layout(*entry.file);
  if (list.kind == Node::Kind::kList) return layout.add_item(list, make_text(peer));
  if (list.kind == Node::Kind::kMap) return layout.add_entry(list, peer, make_text(peer));
  if (list.kind == Node::Kind::kAlias) {
    shop.refuse(entry.file->place_of(list), "the peers are an alias", "write them out there first");
    return;
  }
  Value both = make_list();
  if (!list.is_empty()) both.items.push_back(make_text(list.text));
  both.items.push_back(make_text(peer));
  if (list.is_empty()) return layout.fill(list, both, 0);
  layout.replace(list, both);
}

void begin_list(const Entry& entry, const std::string& peer, Workshop& shop) {
  Value list = make_list();
  list.items.push_back(make_text(peer));
  shop.layout(*entry.file).add_entry(*entry.value, "peers", list, 0, "model");
}

const document::Component* find_component_in(const Document& document, const std::string& name) {
  const auto found = std::find_if(document.components.begin(), document.components.end(),
                                  [&](const auto& one) { return one.name == name; });
  return found == document.components.end() ? nullptr : &*found;
}

/// Each of the targets has more peers, behind those that it had, and all of them are there.
Expectation expect_peer(const State& before, const Targets& targets, const AddPeer& add) {
  return [&before, targets, add](const State& after, base::Diagnostics& diagnostics) {
    const std::set<std::string> known = names_in(after.document);
    Document expected = before.document;
    for (auto& component : expected.components) {
      const auto* found = find_component_in(after.document, component.name);
      if (!targets.has(component.name) || found == nullptr) continue;
      for (std::size_t i = component.peers.size(); i < found->peers.size(); ++i) {
        const document::Peer& peer = found->peers[i];
        component.peers.push_back(peer);
        if (known.contains(peer.component)) continue;
        diagnostics.error({before.file, 0, 0},
                          refusal_of(add, "unknown component '" + peer.component + "'"),
                          base::suggestion(peer.component, {known.begin(), known.end()}));
      }
    }
    return expected;
  };
}

using IsRemoved = std::function<bool(const document::Peer& peer)>;

/// Each of the targets has the others in their order.
Expectation expect_no_peer(const State& before, const Targets& targets,
                           const IsRemoved& is_removed) {
  return [&before, targets, is_removed](const State&, base::Diagnostics&) {
    Document expected = before.document;
    for (auto& component : expected.components) {
      if (targets.has(component.name)) std::erase_if(component.peers, is_removed);
    }
    return expected;
  };
}

/// The peers that the only target has, as a list of its own may say it.
std::optional<Value> peers_of(const Targets& targets, Workshop& shop) {
  if (targets.names.size() > 1) {
    shop.refuse("peers of several components are not overridden at once",
                "change them where they are, with --in, or override one component after the other");
    return std::nullopt;
  }
  Value list = make_list();
  const document::Component* component = find_component_in(shop.document(), targets.names.front());
  if (component == nullptr) return list;
  for (const document::Peer& peer : component->peers) {
    if (peer.superior) continue;
    Value item = make_text(peer.component);
    if (peer.name != peer.component) {
      item = document::make_map();
      item.entries.push_back({peer.name, make_text(peer.component), {}, {}});
    }
    list.items.push_back(std::move(item));
  }
  return list;
}

/// A list in the deployment's own file takes the place of the one that is there.
void override_peers(const Targets& targets, const Value& peers, Workshop& shop) {
  if (const Entry* entry = find_override(targets, shop)) {
    shop.layout(*entry->file).add_entry(*entry->value, "peers", peers);
  } else {
    add_override(targets, "peers", peers, shop);
  }
}

bool is_called(const Value& item, const std::string& peer) {
  return item.text == peer || document::find(item.entries, peer) != nullptr;
}

void refuse_unknown_peer(const std::string& name, const std::string& peer, Workshop& shop) {
  std::vector<std::string> known;
  if (const auto* component = find_component_in(shop.document(), name)) {
    for (const auto& one : component->peers) known.push_back(one.name);
  }
  shop.refuse("'" + name + "' has no peer '" + peer + "'", base::suggestion(peer, known));
}

/// The first file, in the order in which their words count, that names the library.
std::pair<const SourceText*, const Node*> find_library(const std::string& name,
                                                       const SourceMap& map) {
  for (const auto& file : map.files()) {
    for (const Node* item : items_of(find_value(file->root(), "libraries"))) {
      if (item->text == name) return {file.get(), item};
    }
  }
  return {nullptr, nullptr};
}

}  // namespace

void draft(const AddPeer& add, Workshop& shop) {
  const std::optional<Targets> targets = find_targets(add.component, shop);
  if (!targets) return;
  std::vector<std::string> fresh;
  const std::vector<Site> sites = sites_in_force(*targets, find_peers, shop, fresh);
  shop.expect(expect_peer(shop.before(), *targets, add));
  if (needs_override(sites, fresh, *targets, shop)) {
    std::optional<Value> peers = peers_of(*targets, shop);
    if (!peers) return;
    peers->items.push_back(make_text(add.peer));
    return override_peers(*targets, *peers, shop);
  }
  for (const Site& site : sites) {
    if (!is_open(site, *targets, shop)) return refuse_site(site, *targets, shop);
    add_to_list(*site.entry, *site.node, add.peer, shop);
  }
  for (const Entry* entry : entries_for_new(fresh, *targets, shop)) {
    begin_list(*entry, add.peer, shop);
  }
}

void draft(const RemovePeer& remove, Workshop& shop) {
  const std::optional<Targets> targets = find_targets(remove.component, shop);
  if (!targets) return;
  std::vector<std::string> without;
  const auto find = [&](const Entry& entry) { return find_peer(entry, remove.peer); };
  const std::vector<Site> sites = sites_in_force(*targets, find, shop, without);
  if (!without.empty()) return refuse_unknown_peer(without.front(), remove.peer, shop);
  if (needs_override(sites, {}, *targets, shop)) {
    std::optional<Value> peers = peers_of(*targets, shop);
    if (!peers) return;
    std::erase_if(peers->items, [&](const Value& item) { return is_called(item, remove.peer); });
    shop.expect(expect_no_peer(shop.before(), *targets, [name = remove.peer](const auto& peer) {
      return peer.name == name;
    }));
    return override_peers(*targets, *peers, shop);
  }
  std::vector<base::Location> removed;
  for (const Site& site : sites) {
    if (!is_open(site, *targets, shop)) return refuse_site(site, *targets, shop);
    shop.layout(*site.entry->file).remove(*site.node);
    removed.push_back(site.entry->file->place_of(*site.node));
  }
  shop.expect(expect_no_peer(shop.before(), *targets, [removed](const document::Peer& peer) {
    return std::find(removed.begin(), removed.end(), peer.where) != removed.end();
  }));
}

void draft(const AddParameter& add, Workshop& shop) {
  const std::optional<Value> value = value_of(add.value, "parameter '" + add.name + "'", shop);
  const SourceText& file = shop.file_for_new();
  if (!value) return;
  if (document::find(shop.document().parameters, add.name) != nullptr) {
    return shop.refuse("parameter '" + add.name + "' is there already", "set changes it");
  }
  shop.add_to_section(file, "parameters", add.name, *value, 0);
  shop.expect([&before = shop.before(), add](const State& after, base::Diagnostics&) {
    Document expected = before.document;
    const auto* found = document::find(after.document.parameters, add.name);
    if (found != nullptr) expected.parameters.push_back(*found);
    return expected;
  });
}

void draft(const AddLibrary& add, Workshop& shop) {
  const SourceText& file = shop.file_for_new();
  if (const auto [there, item] = find_library(add.name, shop.map()); there != nullptr) {
    return shop.refuse(there->place_of(*item), "library '" + add.name + "' is there already");
  }
  shop.add_item_to_section(file, "libraries", make_text(add.name));
  shop.expect([&before = shop.before(), add](const State&, base::Diagnostics&) {
    Document expected = before.document;
    expected.libraries.push_back({add.name, {}});
    return expected;
  });
}

void draft(const RemoveLibrary& remove, Workshop& shop) {
  const auto [file, item] = find_library(remove.name, shop.map());
  if (file == nullptr) {
    std::vector<std::string> known;
    for (const auto& library : shop.document().libraries) known.push_back(library.name);
    return shop.refuse("unknown library '" + remove.name + "'",
                       base::suggestion(remove.name, known));
  }
  if (!shop.require(*file, *item, "library '" + remove.name + "'")) return;
  const Node* list = find_value(file->root(), "libraries");
  if (list == item) {
    shop.layout(*file).remove(*find_key(file->root(), "libraries"));
  } else {
    shop.layout(*file).remove(*item);
  }
  shop.expect([&before = shop.before(), remove](const State&, base::Diagnostics&) {
    Document expected = before.document;
    std::erase_if(expected.libraries, [&](const auto& one) { return one.name == remove.name; });
    return expected;
  });
}

}  // namespace armature::edit::internal
