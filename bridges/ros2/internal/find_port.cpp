// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/find_port.hpp"

#include "armature/component/interface.hpp"

namespace armature::ros2::internal {
namespace {

/// Of the component in front of the last dot.
template <typename Port>
Port* find_port(const std::vector<component::Component*>& components, const std::string& path,
                std::vector<Port*> component::Interface::*ports) {
  const auto dot = path.rfind('.');
  if (dot == std::string::npos) return nullptr;
  for (const component::Component* each : components) {
    if (each->name() != path.substr(0, dot)) continue;
    for (Port* port : component::interface_of(*each).*ports) {
      if (port->name() == path.substr(dot + 1)) return port;
    }
  }
  return nullptr;
}

}  // namespace

component::OutputPortBase* find_output(const std::vector<component::Component*>& components,
                                       const std::string& path) {
  return find_port(components, path, &component::Interface::outputs);
}

component::InputPortBase* find_input(const std::vector<component::Component*>& components,
                                     const std::string& path) {
  return find_port(components, path, &component::Interface::inputs);
}

}  // namespace armature::ros2::internal
