// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/exec/internal/directory.hpp"
#include "armature/exec/plan.hpp"

namespace armature::exec::internal {

/// Finds the modes and what runs in which.
void plan_modes(const Blueprint& blueprint, const Directory& directory, Plan& plan,
                base::Diagnostics& diagnostics);

/// Orders what the modes switch, when threads and order are known, and checks it.
void plan_members(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics);

ModeSet all_modes(const Plan& plan);

/// ` in the mode 'pid'`, for messages; nothing if these are all modes.
std::string in_modes(const Plan& plan, ModeSet set);

/// Resolves and checks the port connections.
void plan_connections(const Blueprint& blueprint, const Directory& directory, Plan& plan,
                      base::Diagnostics& diagnostics);

/// Finds the peer that serves each required operation and event, and checks the signatures.
void plan_requirements(const Blueprint& blueprint, const Directory& directory, Plan& plan,
                       base::Diagnostics& diagnostics);

/// Checks activities, makes the threads and assigns every component to one.
void plan_threads(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics);

/// Refuses components that use who uses them, but for those that the deployment calls superiors.
void check_superiors(const Blueprint& blueprint, const Directory& directory,
                     base::Diagnostics& diagnostics);

/// Refuses calls of other processes by components that call what they are told, from real-time
/// threads.
void check_calls(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics);

/// Orders start, updates and notifications by the flow of data.
void plan_order(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics);

/// Refuses handlers that would set each other off without end in one thread; finds how deep the
/// others nest.
void plan_triggers(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics);

/// All of them, as declared.
std::vector<component::Component*> components_of(const Blueprint& blueprint);

/// Has observers say what is wrong with what they are to look at, and gives them their place.
void plan_observers(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics);

/// Finds how often each component is run, and tells it.
void plan_periods(const Blueprint& blueprint, const Plan& plan);

/// Has the components say what is wrong with what the deployment makes of them.
void check_components(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics);

/// Who has to run so that a component is run: itself, and who triggers it if it has no thread of
/// its own.
std::vector<Index> who_runs_for(const Blueprint& blueprint, const Plan& plan, Index component);

/// Refuses modes that leave out what holds something, or whom it needs for that.
void check_holders(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics);

/// Refuses all by which a shadow could have an effect on who is none, or hold it up.
void check_shadows(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics);

/// Warns of a triggered consumer that is more urgent than its producer.
void check_priorities(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics);

}  // namespace armature::exec::internal
