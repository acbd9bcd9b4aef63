// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "armature/base/near_name.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {
namespace {

using document::Binding;
using document::Document;
using document::make_map;
using document::make_text;
using document::Value;

Binding* find_binding(document::Component& component, const std::string& name) {
  const auto found = std::find_if(component.bindings.begin(), component.bindings.end(),
                                  [&](const Binding& one) { return one.name == name; });
  return found == component.bindings.end() ? nullptr : &*found;
}

const Binding* binding_of(const Document& document, const std::string& component,
                          const std::string& name) {
  for (const auto& one : document.components) {
    if (one.name != component) continue;
    for (const Binding& binding : one.bindings) {
      if (binding.name == name) return &binding;
    }
  }
  return nullptr;
}

/// The requirement of each target is bound to what the file says then, which is there.
Expectation expect_bound(const State& before, const Targets& targets, const Bind& bind) {
  return [&before, targets, bind](const State& after, base::Diagnostics& diagnostics) {
    const std::set<std::string> known = names_in(after.document);
    Document expected = before.document;
    for (auto& component : expected.components) {
      const Binding* found = binding_of(after.document, component.name, bind.name);
      if (!targets.has(component.name) || found == nullptr) continue;
      if (!known.contains(found->component)) {
        diagnostics.error({before.file, 0, 0},
                          refusal_of(bind, "unknown component '" + found->component + "'"),
                          base::suggestion(found->component, {known.begin(), known.end()}));
      }
      Binding* own = find_binding(component, bind.name);
      if (own != nullptr) *own = *found;
      if (own == nullptr) component.bindings.push_back(*found);
    }
    return expected;
  };
}

/// Without the binding, or with one that another entry gives.
Expectation expect_unbound(const State& before, const Targets& targets, const Unbind& unbind) {
  return [&before, targets, unbind](const State& after, base::Diagnostics&) {
    Document expected = before.document;
    for (auto& component : expected.components) {
      if (!targets.has(component.name)) continue;
      const Binding* found = binding_of(after.document, component.name, unbind.name);
      if (found != nullptr) {
        *find_binding(component, unbind.name) = *found;
      } else {
        std::erase_if(component.bindings,
                      [&](const Binding& one) { return one.name == unbind.name; });
      }
    }
    return expected;
  };
}

void override_binding(const Targets& targets, const std::string& name, const Value& value,
                      Workshop& shop) {
  if (const Entry* entry = find_override(targets, shop)) {
    return add_to_entry(*entry, "bind", name, value, shop);
  }
  Value bindings = make_map();
  bindings.entries.push_back({name, value, {}, {}});
  add_override(targets, "bind", bindings, shop);
}

}  // namespace

void draft(const Bind& bind, Workshop& shop) {
  const std::optional<Targets> targets = find_targets(bind.component, shop);
  if (!targets) return;
  if (!document::is_dotted_name(bind.name)) {
    return shop.refuse("'" + bind.name + "' is not a valid name");
  }
  std::vector<std::string> fresh;
  const auto find = [&](const Entry& entry) {
    return find_value(find_map(entry, "bind"), bind.name);
  };
  const std::vector<Site> sites = sites_in_force(*targets, find, shop, fresh);
  const Value value = make_text(bind.target);
  shop.expect(expect_bound(shop.before(), *targets, bind));
  if (needs_override(sites, fresh, *targets, shop)) {
    return override_binding(*targets, bind.name, value, shop);
  }
  for (const Site& site : sites) {
    if (!is_open(site, *targets, shop)) return refuse_site(site, *targets, shop);
    shop.layout(*site.entry->file).replace(*site.node, value);
  }
  for (const Entry* entry : entries_for_new(fresh, *targets, shop)) {
    add_to_entry(*entry, "bind", bind.name, value, shop);
  }
}

void draft(const Unbind& unbind, Workshop& shop) {
  const std::optional<Targets> targets = find_targets(unbind.component, shop);
  if (!targets) return;
  std::vector<std::string> without;
  const auto find = [&](const Entry& entry) {
    return find_value(find_map(entry, "bind"), unbind.name);
  };
  const std::vector<Site> sites = sites_in_force(*targets, find, shop, without);
  if (!without.empty()) {
    return shop.refuse("'" + without.front() + "' binds no '" + unbind.name + "'");
  }
  shop.expect(expect_unbound(shop.before(), *targets, unbind));
  for (const Site& site : sites) {
    if (!is_open(site, *targets, shop)) return refuse_site(site, *targets, shop);
    shop.layout(*site.entry->file).remove(*site.node);
  }
}

}  // namespace armature::edit::internal
