// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::make_list;
using document::make_text;
using document::Peer;
using document::Value;

/// Those that a component has under `peers`, or those under `superiors`.
enum class PeerKind { kPeer, kSuperior };

const char* key_of(PeerKind kind) { return kind == PeerKind::kPeer ? "peers" : "superiors"; }
const char* noun_of(PeerKind kind) { return kind == PeerKind::kPeer ? "peer" : "superior"; }
bool is_of(PeerKind kind, const Peer& peer) { return peer.superior == (kind != PeerKind::kPeer); }

/// The peer in a list, or under its own name in a map.
const Node* find_peer(const Node* list, const std::string& peer) {
  for (const Node* item : items_of(list)) {
    if (item->kind == Node::Kind::kScalar && item->text == peer) return item;
    if (const Node* named = find_value(item, peer)) return named;
  }
  return nullptr;
}

/// One more in a list, which is made of a single one if need be.
void add_to_peers(const Entry& entry, const Node& list, const std::string& peer, Workshop& shop) {
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

void begin_peers(const Entry& entry, PeerKind kind, const std::string& peer, Workshop& shop) {
  Value list = make_list();
  list.items.push_back(make_text(peer));
  shop.layout(*entry.file).add_entry(*entry.value, key_of(kind), list, 0, "model");
}

const document::Component* find_component_in(const Document& document, const std::string& name) {
  const auto found = std::find_if(document.components.begin(), document.components.end(),
                                  [&](const auto& one) { return one.name == name; });
  return found == document.components.end() ? nullptr : &*found;
}

std::vector<Peer> of_kind(const std::vector<Peer>& peers, PeerKind kind) {
  std::vector<Peer> found;
  std::copy_if(peers.begin(), peers.end(), std::back_inserter(found),
               [kind](const Peer& peer) { return is_of(kind, peer); });
  return found;
}

/// Each of the targets has more of them, behind those that it had, and all of them are there.
Expectation expect_peer(const State& before, const Targets& targets, PeerKind kind,
                        const std::string& refusal) {
  return [&before, targets, kind, refusal](const State& after, base::Diagnostics& diagnostics) {
    const std::set<std::string> known = names_in(after.document);
    Document expected = before.document;
    for (auto& component : expected.components) {
      const auto* found = find_component_in(after.document, component.name);
      if (!targets.has(component.name) || found == nullptr) continue;
      const std::vector<Peer> all = of_kind(found->peers, kind);
      for (std::size_t i = of_kind(component.peers, kind).size(); i < all.size(); ++i) {
        component.peers.push_back(all[i]);
        if (known.contains(all[i].component)) continue;
        diagnostics.error({before.file, 0, 0},
                          refusal + "unknown component '" + all[i].component + "'",
                          base::suggestion(all[i].component, {known.begin(), known.end()}));
      }
    }
    return expected;
  };
}

using IsRemoved = std::function<bool(const Peer& peer)>;

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

/// Those that the only target has, as a list of its own may say it.
std::optional<Value> peers_of(const Targets& targets, PeerKind kind, Workshop& shop) {
  if (targets.names.size() > 1) {
    shop.refuse("peers of several components are not overridden at once",
                "change them where they are, with --in, or override one component after the other");
    return std::nullopt;
  }
  Value list = make_list();
  const document::Component* component = find_component_in(shop.document(), targets.names.front());
  if (component == nullptr) return list;
  for (const Peer& peer : of_kind(component->peers, kind)) {
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
void override_peers(const Targets& targets, PeerKind kind, const Value& peers, Workshop& shop) {
  const Entry* entry = find_override(targets, shop);
  if (entry == nullptr) return add_override(targets, key_of(kind), peers, shop);
  Layout& layout = shop.layout(*entry->file);
  if (const Node* there = find_value(entry->value, key_of(kind))) {
    layout.replace(*there, peers);
  } else {
    layout.add_entry(*entry->value, key_of(kind), peers);
  }
}

bool is_called(const Value& item, const std::string& peer) {
  return item.text == peer || document::find(item.entries, peer) != nullptr;
}

void refuse_unknown_peer(const std::string& name, PeerKind kind, const std::string& peer,
                         Workshop& shop) {
  std::vector<std::string> known;
  if (const auto* component = find_component_in(shop.document(), name)) {
    for (const Peer& one : of_kind(component->peers, kind)) known.push_back(one.name);
  }
  shop.refuse("'" + name + "' has no " + noun_of(kind) + " '" + peer + "'",
              base::suggestion(peer, known));
}

void add_peer(const std::string& component, PeerKind kind, const std::string& peer,
              Workshop& shop) {
  const std::optional<Targets> targets = find_targets(component, shop);
  if (!targets) return;
  std::vector<std::string> fresh;
  const auto find = [kind](const Entry& entry) { return find_value(entry.value, key_of(kind)); };
  const std::vector<Site> sites = sites_in_force(*targets, find, shop, fresh);
  shop.expect(expect_peer(shop.before(), *targets, kind, refusal_of(shop.edit().change, "")));
  if (needs_override(sites, fresh, *targets, shop)) {
    std::optional<Value> peers = peers_of(*targets, kind, shop);
    if (!peers) return;
    peers->items.push_back(make_text(peer));
    return override_peers(*targets, kind, *peers, shop);
  }
  for (const Site& site : sites) {
    if (!is_open(site, *targets, shop)) return refuse_site(site, *targets, shop);
    add_to_peers(*site.entry, *site.node, peer, shop);
  }
  for (const Entry* entry : entries_for_new(fresh, *targets, shop)) {
    begin_peers(*entry, kind, peer, shop);
  }
}

void remove_peer(const std::string& component, PeerKind kind, const std::string& peer,
                 Workshop& shop) {
  const std::optional<Targets> targets = find_targets(component, shop);
  if (!targets) return;
  std::vector<std::string> without;
  const auto find = [&](const Entry& entry) {
    return find_peer(find_value(entry.value, key_of(kind)), peer);
  };
  const std::vector<Site> sites = sites_in_force(*targets, find, shop, without);
  if (!without.empty()) return refuse_unknown_peer(without.front(), kind, peer, shop);
  if (needs_override(sites, {}, *targets, shop)) {
    std::optional<Value> peers = peers_of(*targets, kind, shop);
    if (!peers) return;
    std::erase_if(peers->items, [&](const Value& item) { return is_called(item, peer); });
    shop.expect(expect_no_peer(shop.before(), *targets, [kind, peer](const Peer& one) {
      return is_of(kind, one) && one.name == peer;
    }));
    return override_peers(*targets, kind, *peers, shop);
  }
  std::vector<base::Location> removed;
  for (const Site& site : sites) {
    if (!is_open(site, *targets, shop)) return refuse_site(site, *targets, shop);
    shop.layout(*site.entry->file).remove(*site.node);
    removed.push_back(site.entry->file->place_of(*site.node));
  }
  shop.expect(expect_no_peer(shop.before(), *targets, [removed](const Peer& one) {
    return std::find(removed.begin(), removed.end(), one.where) != removed.end();
  }));
}

}  // namespace

void draft(const AddPeer& add, Workshop& shop) {
  add_peer(add.component, PeerKind::kPeer, add.peer, shop);
}

void draft(const RemovePeer& remove, Workshop& shop) {
  remove_peer(remove.component, PeerKind::kPeer, remove.peer, shop);
}

void draft(const AddSuperior& add, Workshop& shop) {
  add_peer(add.component, PeerKind::kSuperior, add.superior, shop);
}

void draft(const RemoveSuperior& remove, Workshop& shop) {
  remove_peer(remove.component, PeerKind::kSuperior, remove.superior, shop);
}

}  // namespace armature::edit::internal
