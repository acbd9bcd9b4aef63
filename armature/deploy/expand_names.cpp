// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/expand_names.hpp"

#include <algorithm>
#include <initializer_list>
#include <unordered_map>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/deploy/internal/once_per_place.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::deploy::internal {

using namespace document;
namespace {

/// What an entry refers to: a component and what it has.
struct Member {
  std::string& component;
  std::string& name;
  const base::Location& where;
};

class Resolver {
 public:
  Resolver(Document& document, const NameTable& names, base::Diagnostics& diagnostics)
      : document_(document), names_(names), reports_(diagnostics) {
    for (Composite& composite : document.composites) {
      if (names.contains(composite.name)) composites_[composite.name] = &composite;
    }
    for (const Component& component : document.components) add_part(component.name);
  }

  /// What gives a command is a part of the composite whose connection it is.
  void name_part(Connection& connection, const std::string& scope) {
    if (connection.name.empty()) return;
    connection.name = full_name(scope, connection.name);
    add_part(connection.name);
  }

  /// Innermost first, so that an export of an export leads to a component.
  void resolve_exports() {
    for (auto it = document_.composites.rbegin(); it != document_.composites.rend(); ++it) {
      if (composites_.count(it->name) == 0) continue;
      for (Export& one : it->exports) resolve_export(*it, one);
      report();
    }
  }

  void resolve_component(Component& component, const std::string& scope) {
    std::vector<Peer> peers;
    for (const Peer& peer : component.peers) resolve_peer(peer, scope, peers);
    component.peers = std::move(peers);
    for (Binding& binding : component.bindings) {
      resolve_member(scope, {ExportKind::kOperation, ExportKind::kEvent},
                     {binding.component, binding.member, binding.where});
    }
    for (Call& call : component.calls) {
      resolve_member(scope, {ExportKind::kOperation},
                     {call.to.component, call.to.port, call.to.where});
      for (Property& parameter : call.with) resolve_parameter(parameter.value, scope);
    }
    std::vector<Reference> delays;
    for (const Reference& delay : component.delays) resolve_delay(delay, scope, delays);
    component.delays = std::move(delays);
    report();
  }

  /// A composite in a mode stands for its parts.
  void resolve_mode(Mode& mode) {
    std::vector<Reference> components;
    for (const Reference& each : mode.components) {
      if (check_visible({}, each.name, each.where)) resolve_delay(each, {}, components);
    }
    mode.components = std::move(components);
    report();
  }

  void resolve_endpoint(Endpoint& endpoint, const std::string& scope) {
    resolve_member(scope, {ExportKind::kPort}, {endpoint.component, endpoint.port, endpoint.where});
    report();
  }

  /// Its ends may be an event and a command, and then parameters come from ports.
  void resolve_connection(Connection& connection, const std::string& scope) {
    resolve_member(scope, {ExportKind::kPort, ExportKind::kEvent},
                   {connection.from.component, connection.from.port, connection.from.where});
    resolve_member(scope, {ExportKind::kPort, ExportKind::kOperation},
                   {connection.to.component, connection.to.port, connection.to.where});
    for (Property& parameter : connection.with) resolve_parameter(parameter.value, scope);
    report();
  }

 private:
  /// Of all composites that it is in.
  void add_part(const std::string& name) {
    std::string owner = names_.parent_of(name);
    for (; !owner.empty(); owner = names_.parent_of(owner)) {
      parts_[owner].push_back(name.substr(owner.size() + 1));
    }
  }

  void resolve_parameter(Value& value, const std::string& scope) {
    if (value.kind != Value::Kind::kText || value.literal) return;
    auto [component, port] = split_last_dot(value.text);
    if (!names_.contains(names_.resolve(scope, component))) return;  // a constant
    resolve_member(scope, {ExportKind::kPort}, {component, port, value.where});
    value.text = component + "." + port;
  }

  const Composite* composite(const std::string& name) const {
    const auto found = composites_.find(name);
    return found == composites_.end() ? nullptr : found->second;
  }

  void resolve_export(const Composite& owner, Export& one) {
    const std::string part = full_name(owner.name, one.component);
    if (names_.contains(part)) {
      one.component = part;
      follow_export({one.kind}, {one.component, one.member, one.where});
      return;
    }
    found_.error(one.where,
                 "composite " + in_quotes(owner.model) + " has no part " +
                     in_quotes(one.component) + " to export " + in_quotes(one.name) + " from",
                 base::suggestion(one.component, parts_of(owner)));
    one.component = owner.name;  // no component: what uses the export is not reported again
  }

  const std::vector<std::string>& parts_of(const Composite& owner) { return parts_[owner.name]; }

  /// An entry of a range or a composite that is used often meets the same mistake each time.
  void report() {
    if (found_.empty()) return;
    reports_.add(found_);
    found_ = {};
  }

  bool check_visible(const std::string& scope, const std::string& name,
                     const base::Location& where) {
    if (!names_.contains(name) || names_.visible(scope, name)) return true;
    const std::string owner = names_.parent_of(name);
    found_.error(where,
                 in_quotes(name.substr(owner.size() + 1)) + " is a part of composite " +
                     in_quotes(owner) + ", which hides it",
                 "use what the composite exports, or export more");
    return false;
  }

  void resolve_member(const std::string& scope, std::initializer_list<ExportKind> kinds,
                      Member member) {
    member.component = names_.resolve(scope, member.component);
    if (!check_visible(scope, member.component, member.where)) return;
    follow_export(kinds, member);
  }

  /// If the component is a composite, the part that has what it exports.
  void follow_export(std::initializer_list<ExportKind> kinds, Member member) {
    const Composite* owner = composite(member.component);
    if (owner == nullptr) return;
    std::vector<std::string> known;
    for (const Export& one : owner->exports) {
      if (std::find(kinds.begin(), kinds.end(), one.kind) == kinds.end()) continue;
      if (one.name == member.name) {
        member.component = one.component;
        member.name = one.member;
        return;
      }
      known.push_back(one.name);
    }
    found_.error(member.where,
                 "composite " + in_quotes(owner->name) + " exports no " +
                     std::string(name_of(*kinds.begin())) + " " + in_quotes(member.name),
                 base::suggestion(member.name, known));
  }

  /// A composite as a peer stands for the parts that serve what it exports.
  void resolve_peer(const Peer& peer, const std::string& scope, std::vector<Peer>& peers) {
    const std::string name = names_.resolve(scope, peer.component);
    if (!check_visible(scope, name, peer.where)) return;
    const Composite* owner = composite(name);
    if (owner == nullptr) {
      peers.push_back({peer.name, name, peer.where, peer.superior});
      return;
    }
    const std::size_t before = peers.size();
    for (const Export& one : owner->exports) {
      const bool known = std::any_of(peers.begin(), peers.end(), [&](const Peer& earlier) {
        return earlier.component == one.component;
      });
      if (one.kind != ExportKind::kPort && !known) {
        peers.push_back({one.component, one.component, peer.where, peer.superior});
      }
    }
    if (peers.size() > before) return;
    found_.error(peer.where, "composite " + in_quotes(name) +
                                 " exports no operation, event or property for its peers");
  }

  void resolve_delay(const Reference& delay, const std::string& scope,
                     std::vector<Reference>& delays) {
    const std::string name = names_.resolve(scope, delay.name);
    const Composite* owner = composite(name);
    if (owner == nullptr) {
      delays.push_back({name, delay.where});
      return;
    }
    for (const std::string& part : parts_of(*owner)) {
      delays.push_back({full_name(owner->name, part), delay.where});
    }
  }

  Document& document_;
  const NameTable& names_;
  OncePerPlace reports_;
  base::Diagnostics found_;
  std::unordered_map<std::string, std::vector<std::string>> parts_;
  std::unordered_map<std::string, const Composite*> composites_;
};

}  // namespace

std::string full_name(std::string_view scope, const std::string& name) {
  return scope.empty() ? name : std::string(scope) + "." + name;
}

bool NameTable::add(const std::string& name, const std::string& parent,
                    const base::Location& where) {
  return places_.emplace(name, Place{parent, where}).second;
}

std::string NameTable::resolve(std::string_view scope, const std::string& name) const {
  while (true) {
    if (std::string full = full_name(scope, name); contains(full)) return full;
    if (scope.empty()) return name;
    const std::size_t dot = scope.rfind('.');
    scope = dot == std::string_view::npos ? std::string_view{} : scope.substr(0, dot);
  }
}

bool NameTable::visible(std::string_view scope, const std::string& name) const {
  const std::string& parent = places_.at(name).parent;
  if (parent.empty() || scope == parent) return true;
  return scope.size() > parent.size() && scope[parent.size()] == '.' &&
         scope.substr(0, parent.size()) == parent;
}

void resolve_names(Document& document, const Scopes& scopes, const NameTable& names,
                   base::Diagnostics& diagnostics) {
  Resolver resolver(document, names, diagnostics);
  for (std::size_t i = 0; i < document.connections.size(); ++i) {
    resolver.name_part(document.connections[i], scopes.connections[i]);
  }
  resolver.resolve_exports();
  for (std::size_t i = 0; i < document.components.size(); ++i) {
    resolver.resolve_component(document.components[i], scopes.components[i]);
  }
  for (std::size_t i = 0; i < document.connections.size(); ++i) {
    resolver.resolve_connection(document.connections[i], scopes.connections[i]);
  }
  for (std::size_t i = 0; i < document.named_connections.size(); ++i) {
    for (Endpoint& port : document.named_connections[i].ports) {
      resolver.resolve_endpoint(port, scopes.named_connections[i]);
    }
  }
  for (Mode& mode : document.modes) resolver.resolve_mode(mode);
}

}  // namespace armature::deploy::internal
