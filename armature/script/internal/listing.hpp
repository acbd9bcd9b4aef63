// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the task browser lists: components, their members, threads, faults.

#include <string>

#include "armature/exec/application.hpp"
#include "armature/script/internal/display.hpp"
#include "armature/script/internal/machines.hpp"

namespace armature::script::internal {

/// Every component with model, state and thread.
std::string list_components(const Paper& paper, exec::Application& application);

/// Every state machine of the script with its state.
std::string list_machines(const Paper& paper, const Machines& machines);

/// One component with its values.
std::string list_members(const Paper& paper, exec::Application& application,
                         component::Component& component);

/// Each thread's cycles, times and load.
std::string list_threads(const Paper& paper, const exec::Application& application);

/// Who is in an error, faulted or was stopped, and why.
std::string list_faults(const Paper& paper, exec::Application& application);

}  // namespace armature::script::internal
