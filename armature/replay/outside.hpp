// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/component/component.hpp"
#include "armature/exec/blueprint.hpp"

namespace armature::replay {

/// Whether a text names a bus that another process simulates (can/make_bus.hpp).
inline bool is_of_another_process(std::string_view bus) { return bus.starts_with("virtual:"); }

/// Whether it writes down what happens.
inline bool is_reporter(const exec::ComponentEntry& entry) { return entry.model == "Reporter"; }

/// Who observes without recording takes part in a network, as the components of ros2 do: what came
/// from there is in no account of acts, and the others there would take a replay for a robot.
bool speaks_to_others(const exec::ComponentEntry& entry);

/// The bus of another process that a property of the component names; empty if none does.
std::string bus_of_another_process(const component::Component& component);

}  // namespace armature::replay
