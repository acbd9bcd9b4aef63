// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the task browser lists: components, their members, threads, faults.

#include <span>
#include <string>
#include <vector>

#include "armature/browser/internal/display.hpp"
#include "armature/exec/observing/log_history.hpp"
#include "armature/inspect/describe.hpp"
#include "armature/lua/interpreter.hpp"

namespace armature::browser::internal {

/// Every component with model, state and thread.
std::string list_components(const Paper& paper,
                            const std::vector<inspect::ComponentStatus>& components);

/// Every state machine of the script with its state.
std::string list_machines(const Paper& paper, const std::vector<lua::MachineStatus>& machines);

/// One component with its values.
std::string list_members(const Paper& paper, const inspect::ComponentDescription& component);

/// Each thread's cycles, times and load.
std::string list_threads(const Paper& paper, const std::vector<inspect::ThreadStatus>& threads);

/// Lines of a log, as `armature run` prints them.
std::string list_log(const Paper& paper, std::span<const exec::LogLine> lines);

/// Who is in an error, faulted or was stopped, and why.
std::string list_faults(const Paper& paper, const inspect::Faults& faults);

}  // namespace armature::browser::internal
