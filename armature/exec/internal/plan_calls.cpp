// SPDX-License-Identifier: Apache-2.0
#include "armature/component/untyped.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {

/// Who asks another process has an answer when the other one and the network please. Code may send
/// and collect; what a deployment wires is to have that where nobody counts on it.
void check_calls(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics) {
  for (const CallPlan& call : plan.calls) {
    if (dynamic_cast<component::UntypedOperationCaller*>(call.requirement) == nullptr) continue;
    if (!call.operation->is_elsewhere() || plan.thread_of[call.caller] == kNone) continue;
    const ThreadPlan& thread = plan.threads[plan.thread_of[call.caller]];
    if (thread.activity.scheduler == Activity::Scheduler::kOther) continue;
    const ComponentEntry& entry = blueprint.components[call.caller];
    diagnostics.error(
        entry.where,
        quoted(entry.component->name()) + " asks " +
            quoted(call.operation->owner().name() + "." + std::string(call.operation->name())) +
            " of another process from the real-time thread " + quoted(thread.name),
        "give it a thread of its own: activity: triggered");
  }
}

}  // namespace armature::exec::internal
