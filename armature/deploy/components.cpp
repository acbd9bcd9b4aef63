// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/components.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "armature/base/near_name.hpp"

namespace armature::deploy::internal {

const component::Component* find_component(const Components& components, std::string_view name) {
  const auto found = components.find(name);
  return found == components.end() ? nullptr : found->second;
}

const component::Component* component_at(const document::Endpoint& end,
                                         const Components& components,
                                         const exec::Blueprint& blueprint,
                                         base::Diagnostics& diagnostics) {
  const component::Component* const found = find_component(components, end.component);
  if (found != nullptr || blueprint.absent.count(end.component) > 0) return found;
  std::vector<std::string> names;
  for (const auto& [name, component] : components) names.emplace_back(name);
  std::sort(names.begin(), names.end());
  diagnostics.error(end.where, "unknown component " + document::in_quotes(end.component),
                    base::suggestion(end.component, names));
  return nullptr;
}

}  // namespace armature::deploy::internal
