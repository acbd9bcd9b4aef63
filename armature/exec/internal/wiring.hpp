// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/exec/internal/directory.hpp"
#include "armature/exec/plan.hpp"

namespace armature::exec::internal {

/// Resolves and checks the port connections.
void plan_connections(const Blueprint& blueprint, const Directory& directory, Plan& plan,
                      base::Diagnostics& diagnostics);

/// Finds the peer that serves each required operation and event, and checks the signatures.
void plan_requirements(const Blueprint& blueprint, const Directory& directory, Plan& plan,
                       base::Diagnostics& diagnostics);

/// Checks activities, makes the threads and assigns every component to one.
void plan_threads(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics);

/// Orders start, updates and notifications by the flow of data.
void plan_order(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics);

/// Refuses handlers that would set each other off without end in one thread; finds how deep the
/// others nest.
void plan_triggers(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics);

/// Has observers say what is wrong with what they are to look at, and gives them their place.
void plan_observers(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics);

/// Refuses a triggered consumer that is more urgent than its producer.
void check_priorities(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics);

}  // namespace armature::exec::internal
