// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <set>

#include "armature/component/ports/output_port.hpp"
#include "armature/exec/plan.hpp"

namespace armature::replay {

// When within a cycle a component wrote is in no recording. What is known of the plan says it, as
// far as it can.

/// Connections to recorded components that tell them nothing: data that comes to one only tells it
/// when in a cycle to write, and that in the direction of the thread's flow.
std::set<const exec::ConnectionEntry*> ways_back(
    const exec::Plan& plan, const std::function<bool(exec::Index)>& is_recorded);

/// Whether an output was written behind the cycles of its component's thread: who is triggered by a
/// less urgent thread handles that behind the cycle, which began before. Other threads read in
/// cycles of their own, behind this one anyway.
bool writes_behind_cycle(const exec::Plan& plan, exec::Index component,
                         const component::OutputPortBase& output);

}  // namespace armature::replay
