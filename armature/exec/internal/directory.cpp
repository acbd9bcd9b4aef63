// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/directory.hpp"

#include "armature/component/interface.hpp"

namespace armature::exec::internal {
namespace {

/// So few names are looked through faster than an index of them is made.
constexpr std::size_t kFew = 16;

template <typename Port, typename Places>
void index_many(const std::vector<Port*>& ports, Places& places) {
  if (ports.size() <= kFew) return;
  places.reserve(ports.size());
  for (Index i = 0; i < ports.size(); ++i) places.emplace(ports[i]->name(), i);
}

template <typename Port, typename Places>
Index place_of(std::string_view name, const std::vector<Port*>& ports, const Places& places) {
  if (ports.size() > kFew) {
    const auto found = places.find(name);
    return found == places.end() ? kNone : found->second;
  }
  for (Index i = 0; i < ports.size(); ++i) {
    if (ports[i]->name() == name) return i;
  }
  return kNone;
}

}  // namespace

Directory::Directory(const Blueprint& blueprint, base::Diagnostics& diagnostics)
    : blueprint_(blueprint), ports_(blueprint.components.size()) {
  components_.reserve(blueprint.components.size());
  for (Index i = 0; i < blueprint.components.size(); ++i) {
    const ComponentEntry& entry = blueprint.components[i];
    const component::Component& component = *entry.component;
    if (!components_.emplace(component.name(), i).second) {
      diagnostics.error(entry.where, "two components are named " + quoted(component.name()),
                        "give each its own name");
    }
    ports_[i].first_input = input_count_;
    input_count_ += component::interface_of(component).inputs.size();
    index_many(component::interface_of(component).inputs, ports_[i].inputs);
    index_many(component::interface_of(component).outputs, ports_[i].outputs);
  }
}

Index Directory::component(std::string_view name) const {
  const auto found = components_.find(name);
  return found == components_.end() ? kNone : found->second;
}

Directory::Input Directory::input(Index component, std::string_view name) const {
  const auto& inputs = component::interface_of(*blueprint_.components[component].component).inputs;
  const Index place = place_of(name, inputs, ports_[component].inputs);
  if (place == kNone) return {};
  return {inputs[place], first_input(component) + place};
}

component::OutputPortBase* Directory::output(Index component, std::string_view name) const {
  const auto& outputs =
      component::interface_of(*blueprint_.components[component].component).outputs;
  const Index place = place_of(name, outputs, ports_[component].outputs);
  return place == kNone ? nullptr : outputs[place];
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
  for (const auto* port :
       component::interface_of(*blueprint_.components[component].component).inputs) {
    names.push_back(port->name());
  }
  return names;
}

std::vector<std::string> Directory::output_names(Index component) const {
  std::vector<std::string> names;
  for (const auto* port :
       component::interface_of(*blueprint_.components[component].component).outputs) {
    names.push_back(port->name());
  }
  return names;
}

}  // namespace armature::exec::internal
