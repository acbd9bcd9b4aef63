// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/plan.hpp"

#include "armature/component/interface.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec {
namespace {

void check_mandatory_properties(const Blueprint& blueprint, base::Diagnostics& diagnostics) {
  for (const ComponentEntry& entry : blueprint.components) {
    for (const component::PropertyBase* property :
         component::interface_of(*entry.component).mandatory) {
      if (property->was_set()) continue;
      diagnostics.error(entry.where,
                        "property " + internal::quoted(property->name()) + " of " +
                            internal::quoted(entry.component->name()) +
                            " has no default and must be given",
                        std::string(property->doc()));
    }
  }
}

std::string activity_text(const ThreadPlan& thread) {
  const Activity& activity = thread.activity;
  std::string text(name_of(activity.kind));
  if (activity.kind == Activity::Kind::kPeriodic) {
    text += " " + std::to_string(activity.period.count() / 1000) + " us";
  }
  if (activity.scheduler == Activity::Scheduler::kRealtime) {
    text += ", priority " + std::to_string(activity.priority);
  }
  if (activity.scheduler == Activity::Scheduler::kDeadline) text += ", deadline";
  return text;
}

}  // namespace

Plan make_plan(const Blueprint& blueprint, base::Diagnostics& diagnostics) {
  Plan plan;
  const internal::Directory directory(blueprint, diagnostics);
  check_mandatory_properties(blueprint, diagnostics);
  internal::plan_modes(blueprint, directory, plan, diagnostics);
  internal::plan_connections(blueprint, directory, plan, diagnostics);
  internal::plan_requirements(blueprint, directory, plan, diagnostics);
  internal::check_superiors(blueprint, directory, diagnostics);
  internal::plan_threads(blueprint, plan, diagnostics);
  internal::check_calls(blueprint, plan, diagnostics);
  internal::plan_observers(blueprint, plan, diagnostics);
  internal::plan_order(blueprint, plan, diagnostics);
  internal::plan_members(blueprint, plan, diagnostics);
  internal::check_holders(blueprint, plan, diagnostics);
  internal::plan_triggers(blueprint, plan, diagnostics);
  internal::check_priorities(blueprint, plan, diagnostics);
  internal::plan_periods(blueprint, plan);
  // With mistakes in names or wiring, components would see what nobody meant.
  const bool as_meant = diagnostics.ok() && blueprint.absent.empty();
  if (as_meant) internal::check_components(blueprint, plan, diagnostics);
  internal::check_shadows(blueprint, plan, diagnostics);
  return plan;
}

std::string describe_order(const Blueprint& blueprint, const Plan& plan) {
  std::string text;
  for (Index t = 0; t < plan.threads.size(); ++t) {
    const ThreadPlan& thread = plan.threads[t];
    if (thread.members.empty()) continue;
    text += "thread " + thread.name + " (" + activity_text(thread) + ")\n";
    for (const Index updating : thread.updating) {
      text += "  updates " + blueprint.components[updating].component->name() +
              internal::in_modes(plan, plan.modes_of[updating]) + "\n";
    }
    for (const Index member : thread.members) {
      const bool guest = !blueprint.components[member].activity.owns_thread();
      if (!guest) continue;
      text += "  hosts " + blueprint.components[member].component->name() +
              internal::in_modes(plan, plan.modes_of[member]) + "\n";
    }
    for (const SubscriptionPlan& told : plan.subscriptions) {
      if (plan.thread_of[told.to] != t) continue;
      text += "  " + told.event->owner().name() + "." + std::string(told.event->name()) +
              " is handled by " + told.handler->owner().name() +
              (plan.thread_of[told.from] == t ? "" : ", by message") + "\n";
    }
  }
  return text;
}

}  // namespace armature::exec
