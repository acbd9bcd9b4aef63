// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/holders.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "armature/component/interface.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {

using component::Component;

std::vector<Held> Holders::held() const {
  std::vector<Held> all;
  for (const ComponentEntry& entry : blueprint_.components) {
    if (std::optional<Held> one = held_by(*entry.component)) all.push_back(*std::move(one));
  }
  return all;
}

std::optional<Held> Holders::held_by(Component& component) const {
  if (!health_.running() || component::interface_of(component).holdings.empty())
    return std::nullopt;
  const auto what = std::make_shared<component::Reason>();
  for (const component::Holding* holding : component::interface_of(component).holdings) {
    const bool asked =
        executor_.run_in_thread_of(component, [what, holding] { *what = holding->held(); });
    if (!asked) return Held{component.name(), "something, but its thread does not answer", false};
    if (!what->empty()) return Held{component.name(), std::string(what->view())};
  }
  return std::nullopt;
}

std::optional<Held> Holders::held_by_help_of(const Component& component) const {
  if (!health_.running()) return std::nullopt;
  for (const ComponentEntry& entry : blueprint_.components) {
    Component& holder = *entry.component;
    if (&holder == &component) continue;
    const auto& holdings = component::interface_of(holder).holdings;
    const auto needs_it = [&](const auto* holding) { return needs(*holding, component); };
    if (std::ranges::none_of(holdings, needs_it)) continue;
    if (std::optional<Held> one = held_by(holder)) return one;
  }
  return std::nullopt;
}

bool Holders::needs(const component::Holding& holding, const Component& component) const {
  if (holding.kept_by() == nullptr) return false;
  const Index keeper = roster_.index_of(*holding.kept_by());
  const std::vector<Index> all = who_runs_for(blueprint_, plan_, keeper);
  return std::ranges::find(all, roster_.index_of(component)) != all.end();
}

}  // namespace armature::exec::internal
