// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/application.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/author.hpp"
#include "armature/exec/internal/start_gate.hpp"
#include "armature/exec/internal/watchdog.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/memory.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::exec {
namespace {

std::string quoted(std::string_view name) { return "'" + std::string(name) + "'"; }

/// Real-time scheduling as a thread's request.
platform::ThreadRequest request_for(const ThreadPlan& plan, RealtimeMode mode) {
  platform::ThreadRequest request;
  request.name = plan.name;
  if (mode == RealtimeMode::kOff) return request;
  const Activity& activity = plan.activity;
  request.cpus = activity.cpus;
  request.priority = activity.priority;
  request.period = activity.period;
  request.runtime = activity.budget;
  if (activity.scheduler == Activity::Scheduler::kRealtime) {
    request.scheduler = platform::Scheduler::kFifo;
  } else if (activity.scheduler == Activity::Scheduler::kDeadline) {
    request.scheduler = platform::Scheduler::kDeadline;
  }
  return request;
}

std::string scheduling_text(platform::Scheduler scheduler, int priority,
                            const std::vector<int>& cpus) {
  std::string text = "the ordinary scheduler";
  if (scheduler == platform::Scheduler::kFifo) {
    text = "SCHED_FIFO priority " + std::to_string(priority);
  }
  if (scheduler == platform::Scheduler::kDeadline) text = "SCHED_DEADLINE";
  for (std::size_t i = 0; i < cpus.size(); ++i) {
    text += (i == 0 ? " on CPU " : ", ") + std::to_string(cpus[i]);
  }
  return text;
}

}  // namespace

Application::Application(Blueprint blueprint, ApplicationOptions options)
    : blueprint_(std::move(blueprint)), options_(std::move(options)) {}

Application::~Application() {
  stop();
  if (!hangs_) return;
  // A thread that hangs may still touch these.
  for (auto& engine : engines_) static_cast<void>(engine.release());
  for (ComponentEntry& entry : blueprint_.components) static_cast<void>(entry.component.release());
}

base::Diagnostics Application::check() {
  base::Diagnostics diagnostics;
  plan_ = make_plan(blueprint_, diagnostics);
  return diagnostics;
}

base::Diagnostics Application::start() {
  if (running_) return {};
  base::Diagnostics diagnostics = check();
  if (!diagnostics.ok()) return diagnostics;
  faults_ = 0;
  reactions_ = 0;
  make_engines();
  apply_declared_reactions();
  const bool up = configure_all(diagnostics) && connect_all(diagnostics) &&
                  prepare_threads(diagnostics) && start_all(diagnostics);
  if (!up) {
    stop_started(diagnostics);
    end_threads(diagnostics);
    clean_up(diagnostics);
    return diagnostics;
  }
  go_live();
  return diagnostics;
}

void Application::make_engines() {
  engines_.clear();
  engines_by_urgency_.clear();
  for (Index t = 0; t < plan_.threads.size(); ++t) {
    const ThreadPlan& thread = plan_.threads[t];
    std::vector<component::Component*> members;
    std::vector<component::Component*> updating;
    for (const Index member : thread.members) members.push_back(&component_at(member));
    const bool periodic = thread.activity.kind == Activity::Kind::kPeriodic;
    for (const Index each : thread.updating) {
      if (periodic) updating.push_back(&component_at(each));
    }
    engines_.push_back(std::make_unique<Engine>(thread.name, thread.activity, std::move(members),
                                                std::move(updating)));
    engines_.back()->measure_every(options_.measure_every);
    engines_.back()->context().supervisor = this;
    engines_.back()->context().simulated = options_.simulated;
    engines_.back()->context().cycle_time = now();
    engines_by_urgency_.push_back(t);
  }
  std::stable_sort(engines_by_urgency_.begin(), engines_by_urgency_.end(),
                   [this](Index a, Index b) {
                     return plan_.threads[a].activity.priority > plan_.threads[b].activity.priority;
                   });
}

void Application::apply_declared_reactions() {
  for (const ConnectionPlan& connection : plan_.connections) {
    if (connection.entry->max_age) connection.input->set_max_age(*connection.entry->max_age);
    if (connection.entry->on_lost) connection.input->set_on_lost(*connection.entry->on_lost);
  }
}

bool Application::for_each_watched(const std::vector<Index>& order, std::string_view what,
                                   const std::function<bool(Index)>& each,
                                   base::Diagnostics& diagnostics) {
  if (order.empty()) return true;
  const internal::WatchedRun run = internal::run_watched(
      order.size(), options_.hook_limit, [order, each](std::size_t i) { return each(order[i]); });
  if (!run.hung) return true;
  hangs_ = true;
  const ComponentEntry& entry = blueprint_.components[order[run.done]];
  diagnostics.error(entry.where, quoted(entry.component->name()) + " hangs: " + std::string(what) +
                                     " has not returned for " +
                                     std::to_string(options_.hook_limit.count() / 1'000'000) +
                                     " ms");
  return false;
}

bool Application::configure_all(base::Diagnostics& diagnostics) {
  const auto configure = [this, &diagnostics](Index index) {
    if (!blueprint_.components[index].autoconfigure) return true;
    component::Component& component = component_at(index);
    const component::Outcome outcome = component.configure();
    if (outcome) return true;
    diagnostics.error(
        blueprint_.components[index].where,
        quoted(component.name()) + " refuses to configure: " + std::string(outcome.reason()));
    return true;
  };
  return for_each_watched(plan_.start_order, "on_configure", configure, diagnostics) &&
         diagnostics.ok();
}

bool Application::connect_all(base::Diagnostics& diagnostics) {
  for (const Index index : plan_.start_order) {
    for (auto* output : component_at(index).interface().outputs) output->prepare();
  }
  for (const ConnectionPlan& connection : plan_.connections) {
    if (!connection.output->fits(*connection.input)) {
      diagnostics.error(
          connection.entry->where,
          quoted(connection.entry->from_component + "." + connection.entry->from_port) +
              " was configured with another number of elements than " +
              quoted(connection.entry->to_component + "." + connection.entry->to_port) +
              " expects");
      continue;
    }
    connection.output->connect(*connection.input, connection.entry->policy);
  }
  for (const SubscriptionPlan& subscription : plan_.subscriptions) {
    subscription.event->subscribe(*subscription.handler);
  }
  for (const CallPlan& call : plan_.calls) call.requirement->connect(*call.operation);
  return diagnostics.ok();
}

bool Application::prepare_threads(base::Diagnostics& diagnostics) {
  verdict_ = {};
  if (options_.simulated) return true;
  const bool ask = options_.realtime != RealtimeMode::kOff;
  if (ask) {
    const base::Result<void> locked = platform::lock_memory();
    memory_locked_ = locked.ok();
    verdict_.lines.push_back({"memory", "locked", memory_locked_ ? "locked" : "not locked", {}});
    if (!locked) verdict_.lines.back().refusals.push_back(locked.error());
    verdict_.lines.push_back(kernel_line());
    verdict_.lines.push_back(clock_line());
  }
  gate_ = std::make_unique<internal::StartGate>();
  for (Index t = 0; t < engines_.size(); ++t) {
    if (plan_.threads[t].members.empty() && t == plan_.service_thread()) continue;
    const platform::ThreadRequest request = request_for(plan_.threads[t], options_.realtime);
    threads_.push_back(std::make_unique<platform::Thread>(
        request, [gate = gate_.get(), engine = engines_[t].get()] {
          if (gate->wait()) engine->serve();
        }));
    const platform::ThreadGrant& grant = threads_.back()->grant();
    verdict_.lines.push_back(
        {plan_.threads[t].name, scheduling_text(request.scheduler, request.priority, request.cpus),
         scheduling_text(grant.scheduler, grant.priority, grant.cpus), grant.refusals});
  }
  if (options_.realtime != RealtimeMode::kRequire || verdict_.complete()) return true;
  diagnostics.error({}, "real time was required and is not to be had:\n" + verdict_.to_text());
  return false;
}

bool Application::start_all(base::Diagnostics& diagnostics) {
  started_.clear();
  for (auto& engine : engines_) engine->context().cycle_time = now();
  const auto start = [this, &diagnostics](Index index) {
    component::Component& component = component_at(index);
    const bool starts = blueprint_.components[index].autostart;
    component::Outcome outcome = starts ? component.activate() : component::accepted();
    if (starts && outcome) outcome = component.start();
    if (outcome) {
      started_.push_back(index);
      return true;
    }
    diagnostics.error(
        blueprint_.components[index].where,
        quoted(component.name()) + " refuses to start: " + std::string(outcome.reason()));
    return false;
  };
  return for_each_watched(plan_.start_order, "on_start", start, diagnostics) && diagnostics.ok();
}

void Application::go_live() {
  const base::Time begin = now();
  for (auto& engine : engines_) engine->begin(begin);
  running_ = true;
  if (gate_ != nullptr) gate_->open();
}

RunEnd Application::run_for(base::Duration duration, const platform::StopSignal* stop) {
  const base::Time end = now() + duration;
  if (options_.simulated) return simulate_until(end, stop);
  constexpr base::Duration kLogPeriod = std::chrono::milliseconds(20);
  while (true) {
    drain_logs();
    if (stop != nullptr && stop->received()) return RunEnd::kStopRequested;
    if (const std::optional<RunEnd> end_now = end_by_fault()) return *end_now;
    const base::Time at = now();
    if (at >= end) return RunEnd::kTimeUp;
    const base::Time next = std::min(end, at + kLogPeriod);
    if (stop != nullptr) {
      stop->wait_until(next);
    } else {
      platform::sleep_until(next);
    }
  }
}

/// The most urgent engine that has something to do at `now`; among equals the one declared first.
Engine* Application::next_engine(base::Time now) {
  for (const Index index : engines_by_urgency_) {
    Engine& engine = *engines_[index];
    const std::optional<base::Time> due = engine.next_due();
    if (engine.has_messages() || (due && *due <= now)) return &engine;
  }
  return nullptr;
}

RunEnd Application::simulate_until(base::Time end, const platform::StopSignal* stop) {
  while (true) {
    while (Engine* engine = next_engine(simulated_now_)) {
      engine->step(simulated_now_);
      drain_logs();
      if (const std::optional<RunEnd> end_now = end_by_fault()) return *end_now;
    }
    if (stop != nullptr && stop->received()) return RunEnd::kStopRequested;
    base::Time next = end;
    for (const auto& engine : engines_) {
      if (const auto due = engine->next_due()) next = std::min(next, *due);
    }
    if (simulated_now_ >= end) return RunEnd::kTimeUp;
    simulated_now_ = next;
  }
}

base::Diagnostics Application::stop() {
  base::Diagnostics diagnostics;
  if (!running_) return diagnostics;
  stop_started(diagnostics);
  end_threads(diagnostics);
  running_ = false;
  drain_logs();
  clean_up(diagnostics);
  return diagnostics;
}

void Application::stop_started(base::Diagnostics& diagnostics) {
  for (auto each = started_.rbegin(); each != started_.rend(); ++each) {
    component::Component& component = component_at(*each);
    component::ExecutionContext& context = component.context();
    if (!context.live) {
      component.stop();
      continue;
    }
    if (Task::run_in(
            context, [&component] { component.stop(); }, options_.stop_limit))
      continue;
    hangs_ = true;
    context.live = false;
    diagnostics.error({}, quoted(component.name()) + " did not stop: its thread " +
                              quoted(context.name) + " hangs in " +
                              (context.running == nullptr ? std::string("no component")
                                                          : quoted(context.running->name())));
  }
  started_.clear();
}

void Application::end_threads(base::Diagnostics& diagnostics) {
  if (gate_ != nullptr) gate_->give_up();
  for (auto& engine : engines_) engine->end();
  for (auto& thread : threads_) {
    if (thread->join_within(options_.stop_limit)) continue;
    if (!hangs_) diagnostics.error({}, "a thread did not end within the time allowed");
    hangs_ = true;
    thread->abandon();
    static_cast<void>(gate_.release());
  }
  threads_.clear();
  for (auto& engine : engines_) {
    engine->context().live = false;
    engine->context().wakes_on_messages = false;
  }
}

void Application::clean_up(base::Diagnostics& diagnostics) {
  if (memory_locked_) platform::unlock_memory();
  memory_locked_ = false;
  if (hangs_) return;
  std::vector<Index> order(plan_.start_order.rbegin(), plan_.start_order.rend());
  const auto clean = [this](Index index) {
    component_at(index).cleanup();
    return true;
  };
  if (!for_each_watched(order, "on_cleanup", clean, diagnostics)) return;
  drain_logs();
  disconnect_all();
}

void Application::disconnect_all() {
  for (const ComponentEntry& entry : blueprint_.components) {
    const component::Interface& interface = entry.component->interface();
    for (auto* output : interface.outputs) output->disconnect_all();
    for (auto* event : interface.events) event->unsubscribe_all();
    for (auto* caller : interface.callers) caller->disconnect();
  }
}

void Application::component_faulted(component::Component&) {
  faults_.fetch_add(1, std::memory_order_relaxed);
}

void Application::component_stopped_itself(component::Component&) {
  reactions_.fetch_add(1, std::memory_order_relaxed);
}

std::optional<RunEnd> Application::end_by_fault() const {
  if (options_.on_fault != OnFault::kStop) return std::nullopt;
  if (faults() > 0) return RunEnd::kFaulted;
  if (reactions() > 0) return RunEnd::kStoppedByReaction;
  return std::nullopt;
}

base::Time Application::now() const {
  return options_.simulated ? simulated_now_ : platform::monotonic_now();
}

void Application::drain_logs() {
  for (auto& engine : engines_) {
    while (const rt::LogRecord* record = engine->log().pop()) {
      if (options_.log) options_.log(*record);
    }
  }
}

}  // namespace armature::exec
