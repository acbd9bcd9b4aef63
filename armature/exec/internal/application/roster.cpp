// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/roster.hpp"

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"

namespace armature::exec::internal {

Roster::Roster(const Blueprint& blueprint) : blueprint_(blueprint) {
  for (Index i = 0; i < blueprint.components.size(); ++i) {
    index_of_.emplace(blueprint.components[i].component->name(), i);
  }
}

component::Component* Roster::find(std::string_view name) const {
  const auto found = index_of_.find(name);
  return found == index_of_.end() ? nullptr : blueprint_.components[found->second].component.get();
}

Index Roster::index_of(const component::Component& component) const {
  return index_of_.at(component.name());
}

const ComponentEntry& Roster::entry_of(const component::Component& component) const {
  return blueprint_.components[index_of(component)];
}

std::string Roster::unknown(std::string_view name) const {
  std::vector<std::string> names;
  for (const ComponentEntry& entry : blueprint_.components) {
    names.push_back(entry.component->name());
  }
  return "unknown component " + base::quoted(name) + base::suggestion_in_brackets(name, names);
}

}  // namespace armature::exec::internal
