// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/outside.hpp"

#include "armature/component/interface.hpp"
#include "armature/component/properties/property.hpp"

namespace armature::replay {

bool speaks_to_others(const exec::ComponentEntry& entry) {
  return !component::interface_of(*entry.component).observers.empty() && !is_reporter(entry);
}

std::string bus_of_another_process(const component::Component& component) {
  for (const auto* const property : component::interface_of(component).properties) {
    if (property->type().kind != types::Kind::kText) continue;
    std::string text = types::to_text(property->type(), property->data());
    if (is_of_another_process(text)) return text;
  }
  return {};
}

}  // namespace armature::replay
