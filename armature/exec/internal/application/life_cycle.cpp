// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/life_cycle.hpp"

#include <string>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/component/host.hpp"

namespace armature::exec::internal {
namespace {

using base::quoted;
using component::Component;
using component::Outcome;
using component::State;

bool is_running(const Component& component) {
  return component.state() == State::kRunning || component.state() == State::kRunTimeError;
}

Outcome stop_one(Component& component) {
  component::Host::stop(component);
  return component::accepted();
}

Outcome clean_up_one(Component& component) {
  component::Host::retire(component);
  return component.state() == State::kException ? component::refused(component.reason())
                                                : component::accepted();
}

std::string milliseconds(base::Duration duration) {
  return std::to_string(duration.count() / 1'000'000) + " ms";
}

}  // namespace

bool LifeCycle::configure(base::Diagnostics& diagnostics) const {
  Group components;
  for (const Index index : plan_.start_order) {
    const ComponentEntry& entry = blueprint_.components[index];
    if (entry.autoconfigure) components.push_back(entry.component.get());
  }
  const Stage configure{[](Component& component) { return component::Host::configure(component); },
                        "on_configure", "configure", false};
  return run(configure, std::move(components), diagnostics);
}

bool LifeCycle::start(base::Diagnostics& diagnostics) const {
  Group components;
  Group starting;
  for (const Index index : plan_.start_order) {
    const ComponentEntry& entry = blueprint_.components[index];
    if (!entry.autostart) continue;
    components.push_back(entry.component.get());
    if (plan_.runs_at_start(index)) starting.push_back(entry.component.get());
  }
  // Whoever starts may call the others: so first all begin to serve.
  const Stage activate{[](Component& component) { return component::Host::activate(component); },
                       "on_activate", "start", true};
  const Stage start{[](Component& component) { return component::Host::start(component); },
                    "on_start", "start", true};
  if (!run(activate, components, diagnostics)) return false;
  if (!run(start, starting, diagnostics)) return false;
  for (const Component* component : components) {
    if (component->state() != State::kException) continue;
    diagnostics.error(roster_.entry_of(*component).where,
                      quoted(component->name()) +
                          " faulted while others started: " + std::string(component->reason()));
  }
  return diagnostics.ok();
}

bool LifeCycle::run(const Stage& stage, Group components, base::Diagnostics& diagnostics) const {
  HookPatience patient = patience(options_.hook_limit);
  patient.operators_too = true;
  const HookReport report =
      run_hooks({std::move(components), stage.transition, stage.ends_at_refusal}, patient);
  for (const auto& refusal : report.refusals) {
    diagnostics.error(
        roster_.entry_of(*refusal.component).where,
        quoted(refusal.component->name()) + " refuses to " + stage.verb + ": " + refusal.reason);
  }
  if (report.hangs) {
    const Component& hanging = *report.open.front();
    report_hang(hanging, stage.hook, patient.limit_of(hanging), diagnostics);
  }
  return diagnostics.ok();
}

void LifeCycle::stop(base::Diagnostics& diagnostics) const {
  Group group;
  for (auto each = plan_.start_order.rbegin(); each != plan_.start_order.rend(); ++each) {
    Component& component = *blueprint_.components[*each].component;
    if (!is_running(component)) continue;
    const bool same_thread =
        group.empty() ||
        &component::Host::context(*group.back()) == &component::Host::context(component) ||
        !component::Host::context(component).live;
    if (!same_thread) {
      stop_group(group, diagnostics);
      group.clear();
    }
    group.push_back(&component);
  }
  stop_group(group, diagnostics);
}

void LifeCycle::stop_group(const Group& group, base::Diagnostics& diagnostics) const {
  if (group.empty()) return;
  if (component::Host::context(*group.front()).live) {
    stop_in_thread(group, diagnostics);
  } else {
    stop_here(group, diagnostics);
  }
}

void LifeCycle::stop_here(const Group& group, base::Diagnostics& diagnostics) const {
  const HookReport report = run_hooks({group, stop_one}, patience(options_.stop_limit));
  if (!report.hangs) return;
  report_hang(*report.open.front(), "on_stop", options_.stop_limit, diagnostics);
  stop_group(Group(report.open.begin() + 1, report.open.end()), diagnostics);
}

void LifeCycle::stop_in_thread(const Group& group, base::Diagnostics& diagnostics) const {
  component::ExecutionContext& context = component::Host::context(*group.front());
  threads_.make_prompt(context);
  // If the thread is known to hang, nobody waits; its components stop when it goes on.
  const base::Duration limit =
      unreachable_.includes(*group.front()) ? base::Duration::zero() : options_.stop_limit;
  const Group open = run_hooks_in(context, {group, stop_one}, patience(limit)).open;
  if (open.empty()) return;
  unreachable_.give_up(context);
  const Component* const where = context.running();
  for (const Component* component : open) {
    diagnostics.error(roster_.entry_of(*component).where,
                      quoted(component->name()) + " did not stop: its thread " +
                          quoted(context.name) +
                          (where == nullptr ? std::string(" does not answer")
                                            : " hangs in " + quoted(where->name())));
  }
}

void LifeCycle::report_hang(const Component& component, const char* hook, base::Duration limit,
                            base::Diagnostics& diagnostics) const {
  unreachable_.give_up(component);
  diagnostics.error(roster_.entry_of(component).where,
                    quoted(component.name()) + " hangs: " + hook + " did not return within " +
                        milliseconds(limit) + ", in the thread '" + kLifeCycleThread + "'");
}

void LifeCycle::clean_up(base::Diagnostics& diagnostics) const {
  Group components;
  for (auto each = plan_.start_order.rbegin(); each != plan_.start_order.rend(); ++each) {
    Component* const component = blueprint_.components[*each].component.get();
    if (!unreachable_.includes(*component)) components.push_back(component);
  }
  while (!components.empty()) {
    const HookReport report = run_hooks({components, clean_up_one}, patience(options_.hook_limit));
    for (const auto& refusal : report.refusals) {
      diagnostics.error(roster_.entry_of(*refusal.component).where,
                        quoted(refusal.component->name()) +
                            " faulted while it was cleaned up: " + refusal.reason);
    }
    components.clear();
    if (!report.hangs) break;
    report_hang(*report.open.front(), "on_cleanup", options_.hook_limit, diagnostics);
    components.assign(report.open.begin() + 1, report.open.end());
  }
}

std::vector<Casualty> LifeCycle::casualties() const {
  std::vector<Casualty> all;
  for (const ComponentEntry& entry : blueprint_.components) {
    const Component& component = *entry.component;
    if (unreachable_.includes(component) && component.reason().empty()) {
      all.push_back({component.name(), component.state(), "its thread hangs"});
    } else if (!component.reason().empty()) {
      all.push_back({component.name(), component.state(), std::string(component.reason())});
    }
  }
  return all;
}

}  // namespace armature::exec::internal
