// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/component/component.hpp"

namespace armature::replay {

/// Whether a text names a bus that another process simulates (can/make_bus.hpp).
inline bool is_of_another_process(std::string_view bus) { return bus.starts_with("virtual:"); }

/// The bus of another process that a property of the component names; empty if none does.
std::string bus_of_another_process(const component::Component& component);

}  // namespace armature::replay
