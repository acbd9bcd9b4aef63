// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "armature/component/interface.hpp"
#include "armature/component/observing/observer.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

void check_period(const ComponentEntry& entry, base::Diagnostics& diagnostics) {
  if (entry.activity.kind == Activity::Kind::kPeriodic) return;
  diagnostics.error(entry.where,
                    quoted(entry.component->name()) +
                        " watches others and needs a period of its own, but is " +
                        std::string(name_of(entry.activity.kind)),
                    "give it one, for example activity: {periodic: 50 ms, scheduler: other}");
}

}  // namespace

std::vector<component::Component*> components_of(const Blueprint& blueprint) {
  std::vector<component::Component*> components;
  for (const ComponentEntry& entry : blueprint.components) {
    components.push_back(entry.component.get());
  }
  return components;
}

void plan_observers(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics) {
  for (Index i = 0; i < blueprint.components.size(); ++i) {
    if (!component::interface_of(*blueprint.components[i].component).observers.empty())
      plan.observers.push_back(i);
  }
  if (plan.observers.empty()) return;
  const std::vector<component::Component*> components = components_of(blueprint);
  for (const Index index : plan.observers) {
    const ComponentEntry& entry = blueprint.components[index];
    check_period(entry, diagnostics);
    if (!blueprint.absent.empty()) continue;  // it may look for these, which was reported
    for (const auto* observer : component::interface_of(*entry.component).observers) {
      for (auto& objection : observer->check_view(components)) {
        diagnostics.error(entry.where, quoted(entry.component->name()) + ": " + objection.message,
                          std::move(objection.hint));
      }
    }
  }
}

}  // namespace armature::exec::internal
