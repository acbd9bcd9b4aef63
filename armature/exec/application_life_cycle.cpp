// SPDX-License-Identifier: Apache-2.0
// How an application's components come up, as a whole or not at all, and go down in order.
#include <algorithm>
#include <string>
#include <utility>

#include "armature/component/author.hpp"
#include "armature/component/observer.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/internal/directory.hpp"
#include "armature/exec/internal/start_gate.hpp"
#include "armature/exec/internal/wiring.hpp"
#include "armature/platform/stop_priority.hpp"

namespace armature::exec {
namespace {

using component::Component;
using component::Outcome;
using component::State;
using internal::quoted;

bool is_running(const Component& component) {
  return component.state() == State::kRunning || component.state() == State::kRunTimeError;
}

Outcome stop_one(Component& component) {
  component.stop();
  return component::accepted();
}

Outcome clean_up_one(Component& component) {
  component.retire();
  return component.state() == State::kException ? component::refused(component.reason())
                                                : component::accepted();
}

std::string milliseconds(base::Duration duration) {
  return std::to_string(duration.count() / 1'000'000) + " ms";
}

}  // namespace

internal::HookPatience Application::patience(base::Duration limit) {
  return {limit, [this] { drain_logs(); }};
}

bool Application::configure_all(base::Diagnostics& diagnostics) {
  std::vector<Component*> components;
  for (const Index index : plan_.start_order) {
    const ComponentEntry& entry = blueprint_.components[index];
    if (entry.autoconfigure) components.push_back(entry.component.get());
  }
  const Stage configure{[](Component& component) { return component.configure(); }, "on_configure",
                        "configure", false};
  return run_stage(configure, std::move(components), diagnostics);
}

bool Application::connect_all(base::Diagnostics& diagnostics) {
  for (const ComponentEntry& entry : blueprint_.components) {
    for (auto* output : entry.component->interface().outputs) output->prepare();
  }
  for (const ConnectionPlan& connection : plan_.connections) {
    const ConnectionEntry& entry = *connection.entry;
    if (connection.output->fits(*connection.input)) {
      connection.output->connect(*connection.input, entry.policy);
      continue;
    }
    diagnostics.error(entry.where, quoted(entry.from_component + "." + entry.from_port) +
                                       " was configured with another number of elements than " +
                                       quoted(entry.to_component + "." + entry.to_port) +
                                       " expects");
  }
  for (const SubscriptionPlan& subscription : plan_.subscriptions) {
    subscription.event->subscribe(*subscription.handler);
  }
  for (const CallPlan& call : plan_.calls) call.requirement->connect(*call.operation);
  if (!plan_.observers.empty()) let_observers_look();
  black_boxes_.set_engines(engines_, blueprint_, plan_, options_.simulated);
  return diagnostics.ok();
}

void Application::let_observers_look() {
  const component::Surroundings surroundings{internal::components_of(blueprint_),
                                             options_.output_folder};
  for (const Index index : plan_.observers) {
    for (auto* observer : blueprint_.components[index].component->interface().observers) {
      observer->observe(surroundings);
    }
  }
}

bool Application::start_all(base::Diagnostics& diagnostics) {
  const base::Time begin = now();
  for (auto& engine : engines_) engine->context().cycle_time = begin;
  std::vector<Component*> components;
  std::vector<Component*> starting;
  for (const Index index : plan_.start_order) {
    const ComponentEntry& entry = blueprint_.components[index];
    if (!entry.autostart) continue;
    components.push_back(entry.component.get());
    if (plan_.runs_at_start(index)) starting.push_back(entry.component.get());
  }
  // Whoever starts may call the others: so first all begin to serve.
  const Stage activate{[](Component& component) { return component.activate(); }, "on_activate",
                       "start", true};
  const Stage start{[](Component& component) { return component.start(); }, "on_start", "start",
                    true};
  if (!run_stage(activate, components, diagnostics)) return false;
  if (!run_stage(start, starting, diagnostics)) return false;
  for (const Component* component : components) {
    if (component->state() != State::kException) continue;
    diagnostics.error(entry_of(*component).where,
                      quoted(component->name()) +
                          " faulted while others started: " + std::string(component->reason()));
  }
  return diagnostics.ok();
}

/// False if a component refuses or hangs, which is reported.
bool Application::run_stage(const Stage& stage, std::vector<Component*> components,
                            base::Diagnostics& diagnostics) {
  const internal::HookReport report =
      internal::run_hooks({std::move(components), stage.transition, stage.ends_at_refusal},
                          patience(options_.hook_limit));
  for (const auto& refusal : report.refusals) {
    diagnostics.error(
        entry_of(*refusal.component).where,
        quoted(refusal.component->name()) + " refuses to " + stage.verb + ": " + refusal.reason);
  }
  if (report.hangs) {
    report_hang(*report.open.front(), stage.hook, options_.hook_limit, diagnostics);
  }
  return diagnostics.ok();
}

void Application::report_hang(const Component& component, const char* hook, base::Duration limit,
                              base::Diagnostics& diagnostics) {
  hangs_ = true;
  stuck_.insert(&component);
  diagnostics.error(entry_of(component).where, quoted(component.name()) + " hangs: " + hook +
                                                   " did not return within " + milliseconds(limit) +
                                                   ", in the thread '" +
                                                   internal::kLifeCycleThread + "'");
}

void Application::take_down(base::Diagnostics& diagnostics) {
  ways_to_stop_.clear();
  stop_running(diagnostics);
  end_threads(diagnostics);
  deliver_leftovers(diagnostics);
  list_casualties();
  drain_logs();
  say(black_boxes_.write_last(*incidents_, now()));
  clean_up(diagnostics);
  drain_logs();
  logs_.tell_losses(now());
  if (!logs_.failure().empty()) {
    diagnostics.warning({},
                        "log lines are missing: their receiver threw " + quoted(logs_.failure()));
  }
}

/// In reverse order of start; neighbours in this order that share a thread are stopped in one go.
void Application::stop_running(base::Diagnostics& diagnostics) {
  std::vector<Component*> group;
  const auto stop_collected = [&] {
    if (!group.empty()) stop_group(group, diagnostics);
    group.clear();
  };
  for (auto each = plan_.start_order.rbegin(); each != plan_.start_order.rend(); ++each) {
    Component& component = *blueprint_.components[*each].component;
    if (!is_running(component)) continue;
    const bool same_thread = group.empty() || &group.back()->context() == &component.context() ||
                             !component.context().live;
    if (!same_thread) stop_collected();
    group.push_back(&component);
  }
  stop_collected();
}

void Application::stop_group(const std::vector<Component*>& group, base::Diagnostics& diagnostics) {
  component::ExecutionContext& context = group.front()->context();
  const internal::HookSeries series{group, stop_one};
  if (!context.live) {
    const internal::HookReport report = run_hooks(series, patience(options_.stop_limit));
    if (!report.hangs) return;
    report_hang(*report.open.front(), "on_stop", options_.stop_limit, diagnostics);
    const std::vector<Component*> rest(report.open.begin() + 1, report.open.end());
    if (!rest.empty()) stop_group(rest, diagnostics);
    return;
  }
  // However many others are busy, it gets there soon.
  if (gate_ != nullptr && options_.realtime != RealtimeMode::kOff) {
    platform::make_prompt(gate_->thread_of(&context));
  }
  // If the thread is known to hang, nobody waits; its components stop when it goes on.
  const base::Duration limit =
      is_stuck(*group.front()) ? base::Duration::zero() : options_.stop_limit;
  const std::vector<Component*> open = run_hooks_in(context, series, patience(limit)).open;
  if (open.empty()) return;
  give_up_thread(context);
  const Component* const where = context.running();
  for (const Component* component : open) {
    diagnostics.error(entry_of(*component).where,
                      quoted(component->name()) + " did not stop: its thread " +
                          quoted(context.name) +
                          (where == nullptr ? std::string(" does not answer")
                                            : " hangs in " + quoted(where->name())));
  }
}

void Application::give_up_thread(const component::ExecutionContext& context) {
  hangs_ = true;
  stuck_.insert(&context);
}

/// What was sent to a thread that had ended already; nobody runs any more, so that this ends soon.
void Application::deliver_leftovers(base::Diagnostics& diagnostics) {
  constexpr int kRounds = 64;
  bool any = true;
  for (int round = 0; any && round < kRounds; ++round) {
    any = false;
    for (Index t = 0; t < engines_.size(); ++t) {
      component::ExecutionContext& context = engines_[t]->context();
      if (context.live || stuck_.count(&context) > 0) continue;
      engines_[t]->close_account();
      if (!engines_[t]->has_leftovers()) continue;
      any = true;
      deliver_leftovers_of(t, diagnostics);
    }
  }
}

/// Operations that were sent are their components' code, which may hang like a hook.
void Application::deliver_leftovers_of(Index thread, base::Diagnostics& diagnostics) {
  Engine* const engine = engines_[thread].get();
  Component* const any_member =
      blueprint_.components[plan_.threads[thread].members.front()].component.get();
  const internal::HookReport report = run_hooks({{any_member},
                                                 [engine](Component&) {
                                                   engine->deliver_leftovers();
                                                   return component::accepted();
                                                 }},
                                                patience(options_.stop_limit));
  if (!report.hangs) return;
  give_up_thread(engine->context());
  const Component* const where = engine->context().running();
  diagnostics.error({}, "a message to the thread " + quoted(engine->context().name) +
                            ", handled after its end, hangs" +
                            (where == nullptr ? "" : " in " + quoted(where->name())));
}

void Application::list_casualties() {
  casualties_.clear();
  for (const ComponentEntry& entry : blueprint_.components) {
    const Component& component = *entry.component;
    if (is_stuck(component) && component.reason().empty()) {
      casualties_.push_back({component.name(), component.state(), "its thread hangs"});
    } else if (!component.reason().empty()) {
      casualties_.push_back({component.name(), component.state(), std::string(component.reason())});
    }
  }
}

void Application::clean_up(base::Diagnostics& diagnostics) {
  std::vector<Component*> components;
  for (auto each = plan_.start_order.rbegin(); each != plan_.start_order.rend(); ++each) {
    Component* const component = blueprint_.components[*each].component.get();
    if (!is_stuck(*component)) components.push_back(component);
  }
  while (!components.empty()) {
    const internal::HookReport report =
        run_hooks({components, clean_up_one}, patience(options_.hook_limit));
    for (const auto& refusal : report.refusals) {
      diagnostics.error(entry_of(*refusal.component).where,
                        quoted(refusal.component->name()) +
                            " faulted while it was cleaned up: " + refusal.reason);
    }
    components.clear();
    if (!report.hangs) break;
    report_hang(*report.open.front(), "on_cleanup", options_.hook_limit, diagnostics);
    components.assign(report.open.begin() + 1, report.open.end());
  }
  if (!hangs_) disconnect_all();
}

void Application::disconnect_all() {
  for (const ComponentEntry& entry : blueprint_.components) {
    const component::Interface& interface = entry.component->interface();
    for (auto* output : interface.outputs) output->disconnect_all();
    for (auto* event : interface.events) event->unsubscribe_all();
    for (auto* caller : interface.callers) caller->disconnect();
    if (plan_.observers.empty()) continue;
    for (auto* property : interface.properties) property->untap();
  }
}

}  // namespace armature::exec
