// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/directory.hpp"

namespace armature::exec::internal {

std::string quoted(std::string_view name) { return "'" + std::string(name) + "'"; }

Directory::Directory(const Blueprint& blueprint, base::Diagnostics& diagnostics)
    : blueprint_(blueprint), ports_(blueprint.components.size()) {
  for (Index i = 0; i < blueprint.components.size(); ++i) {
    const ComponentEntry& entry = blueprint.components[i];
    const component::Component& component = *entry.component;
    if (!components_.emplace(component.name(), i).second) {
      diagnostics.error(entry.where, "there are two components named " + quoted(component.name()),
                        "give each its own name");
    }
    for (auto* port : component.interface().inputs) ports_[i].inputs.emplace(port->name(), port);
    for (auto* port : component.interface().outputs) ports_[i].outputs.emplace(port->name(), port);
  }
}

Index Directory::component(std::string_view name) const {
  const auto found = components_.find(name);
  return found == components_.end() ? kNone : found->second;
}

component::InputPortBase* Directory::input(Index component, std::string_view name) const {
  const auto found = ports_[component].inputs.find(name);
  return found == ports_[component].inputs.end() ? nullptr : found->second;
}

component::OutputPortBase* Directory::output(Index component, std::string_view name) const {
  const auto found = ports_[component].outputs.find(name);
  return found == ports_[component].outputs.end() ? nullptr : found->second;
}

std::vector<std::string> Directory::component_names() const {
  std::vector<std::string> names;
  for (const ComponentEntry& entry : blueprint_.components) {
    names.push_back(entry.component->name());
  }
  return names;
}

std::vector<std::string> Directory::input_names(Index component) const {
  std::vector<std::string> names;
  for (const auto* port : blueprint_.components[component].component->interface().inputs) {
    names.push_back(port->name());
  }
  return names;
}

std::vector<std::string> Directory::output_names(Index component) const {
  std::vector<std::string> names;
  for (const auto* port : blueprint_.components[component].component->interface().outputs) {
    names.push_back(port->name());
  }
  return names;
}

}  // namespace armature::exec::internal
