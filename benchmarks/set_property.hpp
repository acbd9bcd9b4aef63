// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "armature/component/component.hpp"
#include "armature/component/interface.hpp"

namespace armature::benchmarks {

/// As a deployment does it.
/// @throws std::runtime_error  there is no such property, or it refuses
template <typename T>
void set(component::Component& component, std::string_view name, const T& value) {
  for (component::PropertyBase* property : component::interface_of(component).properties) {
    if (property->name() != name) continue;
    if (const auto done = property->set(types::Value::of(value)); !done) {
      throw std::runtime_error(component.name() + ": " + done.error());
    }
    return;
  }
  throw std::runtime_error(component.name() + " has no property " + std::string(name));
}

}  // namespace armature::benchmarks
