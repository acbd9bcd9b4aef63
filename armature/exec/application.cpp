// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/application.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/author.hpp"
#include "armature/exec/internal/age_watch.hpp"
#include "armature/exec/internal/directory.hpp"
#include "armature/exec/internal/simulation.hpp"
#include "armature/exec/internal/start_gate.hpp"
#include "armature/exec/internal/tool_ticket.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::exec {
namespace {

/// What a hanging thread may still touch stays, and stays reachable, until the process ends.
struct Remains {
  std::vector<std::unique_ptr<Engine>> engines;
  std::vector<std::unique_ptr<component::Component>> components;
  std::unique_ptr<internal::Incidents> incidents;

  static void keep(Remains remains) {
    static auto& all = *new std::vector<Remains>;
    all.push_back(std::move(remains));
  }
};

/// A measured cycle takes longer, that of a thousand components several times as long. The number
/// is odd, so that cycles which differ by turns are all measured.
std::uint64_t usual_measuring(const ThreadPlan& thread) {
  constexpr base::Duration kInterval = std::chrono::milliseconds(250);
  const base::Duration period = std::max(thread.activity.period, thread.trigger_period);
  const bool known = period > base::Duration::zero();
  return static_cast<std::uint64_t>(known ? kInterval / period : 250) | 1u;
}

}  // namespace

Application::Application(Blueprint blueprint, ApplicationOptions options)
    : blueprint_(std::move(blueprint)),
      options_(std::move(options)),
      logs_(options_.log),
      timeline_(options_.timeline),
      black_boxes_(options_.black_box),
      incidents_(std::make_unique<internal::Incidents>()) {
  for (Index i = 0; i < blueprint_.components.size(); ++i) {
    index_of_.emplace(blueprint_.components[i].component->name(), i);
  }
}

Application::~Application() {
  stop();
  if (!hangs_) return;
  Remains remains{std::move(engines_), {}, std::move(incidents_)};
  for (ComponentEntry& entry : blueprint_.components) {
    remains.components.push_back(std::move(entry.component));
  }
  Remains::keep(std::move(remains));
}

base::Diagnostics Application::check() {
  base::Diagnostics diagnostics;
  plan_ = make_plan(blueprint_, diagnostics);
  return diagnostics;
}

base::Diagnostics Application::start() {
  if (running_) return {};
  if (hangs_) {
    base::Diagnostics refusal;
    refusal.error(
        {}, internal::quoted(blueprint_.name) + " cannot be started again: one of its hooks hangs",
        "end the process");
    return refusal;
  }
  base::Diagnostics diagnostics = check();
  if (!diagnostics.ok()) return diagnostics;
  incidents_ = std::make_unique<internal::Incidents>();
  leaving_ = false;
  apply_declared_reactions();
  make_engines();
  set_up_modes();
  const bool up = configure_all(diagnostics) && connect_all(diagnostics) &&
                  prepare_threads(diagnostics) && start_all(diagnostics) && get_ready(diagnostics);
  if (up) {
    go_live();
  } else {
    take_down(diagnostics);
  }
  return diagnostics;
}

base::Diagnostics Application::stop() {
  base::Diagnostics diagnostics;
  take_leave();
  if (std::exchange(running_, false)) take_down(diagnostics);
  return diagnostics;
}

void Application::make_engines() {
  simulation_.reset();
  engines_.clear();
  std::vector<Engine*> engines;
  for (const ThreadPlan& thread : plan_.threads) {
    std::vector<component::Component*> members;
    std::vector<component::Component*> updating;
    for (const Index member : thread.members) {
      members.push_back(blueprint_.components[member].component.get());
    }
    const bool periodic = thread.activity.kind == Activity::Kind::kPeriodic;
    for (const Index each : thread.updating) {
      if (periodic) updating.push_back(blueprint_.components[each].component.get());
    }
    engines_.push_back(std::make_unique<Engine>(thread.name, thread.activity, std::move(members),
                                                std::move(updating)));
    Engine& engine = *engines_.back();
    const std::uint64_t often = options_.measure_every;
    engine.measure_every(often != 0 ? often : usual_measuring(thread));
    engine.context().limit_depth(thread.depth + component::kLeastDepthLimit);
    engine.context().supervisor = incidents_.get();
    engine.context().simulated = options_.simulated;
    engine.context().real_time = thread.activity.scheduler != Activity::Scheduler::kOther;
    engine.context().cycle_time = now();
    engines.push_back(&engine);
  }
  logs_.set_engines(engines);
  timeline_.set_engines(engines, plan_, options_.simulated);
  if (options_.simulated) simulation_ = std::make_unique<internal::Simulation>(engines);
}

void Application::apply_declared_reactions() {
  for (const ConnectionPlan& connection : plan_.connections) {
    if (!connection.reacts) continue;
    if (connection.entry->max_age) connection.input->set_max_age(*connection.entry->max_age);
    if (connection.entry->on_lost) connection.input->set_on_lost(*connection.entry->on_lost);
  }
}

RunEnd Application::run_for(base::Duration duration, const platform::StopSignal* stop) {
  return run_until(base::later(now(), duration), nullptr, stop);
}

RunEnd Application::run_until(base::Time end, const std::function<bool()>& condition,
                              const platform::StopSignal* stop) {
  if (options_.simulated) return simulate_until(end, condition, stop);
  return run_threads_until(end, condition, stop);
}

RunEnd Application::run_threads_until(base::Time end, const std::function<bool()>& condition,
                                      const platform::StopSignal* stop) {
  constexpr base::Duration kLogPeriod = std::chrono::milliseconds(20);
  constexpr base::Duration kConditionPeriod = std::chrono::milliseconds(1);
  const bool often = condition || options_.attend;
  const base::Duration period = often ? kConditionPeriod : kLogPeriod;
  while (true) {
    drain_logs();
    if (stop != nullptr && stop->received()) return RunEnd::kStopRequested;
    if (const std::optional<RunEnd> end_now = end_by_fault()) return *end_now;
    const base::Time at = now();
    say(black_boxes_.write_if_due(*incidents_, at));
    finish_ways_to_stop();
    logs_.tell_losses_now_and_then(at);
    if (options_.attend) options_.attend();
    if (condition && condition()) return RunEnd::kConditionMet;
    if (at >= end) return RunEnd::kTimeUp;
    const base::Time next = std::min(end, at + period);
    if (stop != nullptr) {
      stop->wait_until(next);
    } else {
      platform::sleep_until(next);
    }
  }
}

RunEnd Application::simulate_until(base::Time end, const std::function<bool()>& condition,
                                   const platform::StopSignal* stop) {
  while (true) {
    while (Engine* const engine = simulation_->take_turn(simulated_now_)) {
      logs_.drain(*engine);
      timeline_.drain_if_half_full();
      if (const std::optional<RunEnd> end_now = end_by_fault()) return *end_now;
      if (stop != nullptr && stop->received()) return RunEnd::kStopRequested;
    }
    say(black_boxes_.write_if_due(*incidents_, simulated_now_));
    finish_ways_to_stop();
    logs_.tell_losses_now_and_then(simulated_now_);
    if (options_.attend) options_.attend();
    if (condition && condition()) return RunEnd::kConditionMet;
    if (simulated_now_ >= end) return RunEnd::kTimeUp;
    simulated_now_ = std::min(end, simulation_->next_due());
  }
}

std::optional<RunEnd> Application::end_by_fault() {
  take_leave();
  if (died_) return RunEnd::kFaulted;
  if (options_.on_fault != OnFault::kStopAll || leaving_) return std::nullopt;
  if (faults() > 0) return RunEnd::kFaulted;
  if (reactions() > 0) return RunEnd::kStoppedByReaction;
  return std::nullopt;
}

void Application::mourn(const void* workplace, std::string reason) {
  dead_workplace_ = workplace;
  death_ = std::move(reason);
  mourns_.store(true, std::memory_order_release);
}

/// The dead thread stands still, so that its components are everybody's.
void Application::take_leave() {
  if (!mourns_.exchange(false, std::memory_order_acquire)) return;
  died_ = hangs_ = true;
  for (const auto& engine : engines_) {
    if (&engine->context() != dead_workplace_) continue;
    give_up_thread(engine->context());
    engine->fault_members(death_);
  }
}

base::Time Application::now() const {
  return options_.simulated ? simulated_now_ : platform::monotonic_now();
}

/// Empty texts say nothing.
void Application::say(const std::string& text) {
  if (text.empty()) return;
  logs_.say(text, now());
}

void Application::drain_logs() {
  logs_.drain();
  timeline_.drain();
}

}  // namespace armature::exec
