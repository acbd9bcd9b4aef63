// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/directory.hpp"

namespace armature::exec::internal {
namespace {

/// So few names are looked through faster than an index of them is made.
constexpr std::size_t kFew = 16;

template <typename Port>
using ByName = std::unordered_map<std::string_view, Port*>;

template <typename Port>
void index_many(const std::vector<Port*>& ports, ByName<Port>& index) {
  if (ports.size() <= kFew) return;
  index.reserve(ports.size());
  for (Port* port : ports) index.emplace(port->name(), port);
}

template <typename Port>
Port* find(const std::vector<Port*>& ports, const ByName<Port>& index, std::string_view name) {
  if (ports.size() > kFew) {
    const auto found = index.find(name);
    return found == index.end() ? nullptr : found->second;
  }
  for (Port* port : ports) {
    if (port->name() == name) return port;
  }
  return nullptr;
}

}  // namespace

std::string quoted(std::string_view name) { return "'" + std::string(name) + "'"; }

Directory::Directory(const Blueprint& blueprint, base::Diagnostics& diagnostics)
    : blueprint_(blueprint), ports_(blueprint.components.size()) {
  components_.reserve(blueprint.components.size());
  for (Index i = 0; i < blueprint.components.size(); ++i) {
    const ComponentEntry& entry = blueprint.components[i];
    const component::Component& component = *entry.component;
    if (!components_.emplace(component.name(), i).second) {
      diagnostics.error(entry.where, "there are two components named " + quoted(component.name()),
                        "give each its own name");
    }
    index_many(component.interface().inputs, ports_[i].inputs);
    index_many(component.interface().outputs, ports_[i].outputs);
  }
}

Index Directory::component(std::string_view name) const {
  const auto found = components_.find(name);
  return found == components_.end() ? kNone : found->second;
}

component::InputPortBase* Directory::input(Index component, std::string_view name) const {
  return find(blueprint_.components[component].component->interface().inputs,
              ports_[component].inputs, name);
}

component::OutputPortBase* Directory::output(Index component, std::string_view name) const {
  return find(blueprint_.components[component].component->interface().outputs,
              ports_[component].outputs, name);
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
