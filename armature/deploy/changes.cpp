// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/changes.hpp"

#include <algorithm>
#include <utility>

#include "armature/deploy/internal/expand_names.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::deploy::internal {

using namespace document;

namespace {

bool is_marked(const Value& body, std::string_view mark) {
  const Property* const entry = find(body.entries, mark);
  return entry != nullptr && entry->value.text == "true";
}

void remove_entry(Value& base, const Property& removal, base::Diagnostics& diagnostics) {
  const auto gone = std::erase_if(
      base.entries, [&](const Property& entry) { return entry.name == removal.name; });
  if (gone > 0) return;
  diagnostics.error(removal.where,
                    in_quotes(removal.name) + " is marked remove: true but does not exist");
}

/// Erases each element for which `gone` holds, and its neighbour in `scopes`.
template <typename Element, typename Gone>
void erase_both(std::vector<Element>& elements, std::vector<std::string>& scopes,
                const Gone& gone) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (gone(elements[i], scopes[i])) continue;
    if (kept != i) {
      elements[kept] = std::move(elements[i]);
      scopes[kept] = std::move(scopes[i]);
    }
    ++kept;
  }
  elements.resize(kept);
  scopes.resize(kept);
}

bool same_ends(const Connection& a, const Connection& b) {
  return to_text(a.from) == to_text(b.from) && to_text(a.to) == to_text(b.to);
}

}  // namespace

bool is_change(const Value& body) { return is_marked(body, "override") || is_removal(body); }

bool is_removal(const Value& value) { return is_marked(value, "remove"); }

void check_change(const std::string& name, const Value& body, base::Diagnostics& diagnostics) {
  if (!is_removal(body) || body.entries.size() == 1) return;
  diagnostics.error(body.where, "component " + in_quotes(name) + " is both removed and changed",
                    "write either remove: true or the changes");
}

bool take_removal(ChangesByName& changes, const std::string& name) {
  const auto found = changes.find(name);
  if (found == changes.end()) return false;
  const bool removes = std::any_of(found->second.begin(), found->second.end(),
                                   [](const Change& change) { return is_removal(change.body); });
  if (removes) changes.erase(found);
  return removes;
}

void apply_change(Value& base, const Value& change, base::Diagnostics& diagnostics) {
  for (const Property& entry : change.entries) {
    if (entry.name == "override") continue;
    Property* same = find(base.entries, entry.name);
    const bool by_name = entry.name == "properties" || entry.name == "bind";
    const bool both_maps = same != nullptr && same->value.kind == Value::Kind::kMap &&
                           entry.value.kind == Value::Kind::kMap;
    if (is_removal(entry.value)) {
      remove_entry(base, entry, diagnostics);
    } else if (same == nullptr) {
      base.entries.push_back(entry);
    } else if (by_name && both_maps) {
      apply_change(same->value, entry.value, diagnostics);
    } else {
      same->value = entry.value;
    }
  }
}

void Removals::add_component(const std::string& instance, const std::string& name) {
  components_.insert(full_name(instance, name));
}

void Removals::add_connection(const std::string& instance, Connection connection) {
  connections_.push_back({instance, std::move(connection)});
}

void Removals::add_named(const std::string& instance, Reference name) {
  named_.push_back({instance, std::move(name)});
}

void Removals::apply(Document& document, Scopes& scopes, base::Diagnostics& diagnostics) const {
  std::vector<bool> found(connections_.size());
  std::vector<bool> found_named(named_.size());
  const auto of_removed = [&](const Endpoint& end, const std::string& instance) {
    return components_.count(full_name(instance, end.component)) > 0;
  };
  const auto by_name = [&](const std::string& name, const std::string& instance) {
    for (std::size_t i = 0; i < named_.size(); ++i) {
      if (named_[i].instance != instance || named_[i].what.name != name) continue;
      found_named[i] = true;
      return true;
    }
    return false;
  };
  erase_both(document.connections, scopes.connections, [&](const auto& one, const auto& in) {
    for (std::size_t i = 0; i < connections_.size(); ++i) {
      if (connections_[i].instance != in || !same_ends(connections_[i].what, one)) continue;
      found[i] = true;
      return true;
    }
    if (by_name(one.name, in)) return true;
    return of_removed(one.from, in) || of_removed(one.to, in);
  });
  erase_both(document.named_connections, scopes.named_connections, [&](auto& one, const auto& in) {
    if (by_name(one.name, in)) return true;
    std::erase_if(one.ports, [&](const Endpoint& end) { return of_removed(end, in); });
    return one.ports.empty();
  });
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i]) continue;
    const Connection& wanted = connections_[i].what;
    diagnostics.error(wanted.where,
                      "connection " +
                          in_quotes(to_text(wanted.from) + " -> " + to_text(wanted.to)) +
                          " is marked remove: true but does not exist");
  }
  for (std::size_t i = 0; i < found_named.size(); ++i) {
    if (found_named[i]) continue;
    diagnostics.error(named_[i].what.where, "connection " + in_quotes(named_[i].what.name) +
                                                " is marked remove: true but does not exist");
  }
}

}  // namespace armature::deploy::internal
