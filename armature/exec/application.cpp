// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/application.hpp"

#include <exception>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/quoted.hpp"
#include "armature/exec/internal/application/before_stop.hpp"
#include "armature/exec/internal/application/clock.hpp"
#include "armature/exec/internal/application/connections.hpp"
#include "armature/exec/internal/application/death_notice.hpp"
#include "armature/exec/internal/application/engines.hpp"
#include "armature/exec/internal/application/executor.hpp"
#include "armature/exec/internal/application/health.hpp"
#include "armature/exec/internal/application/holders.hpp"
#include "armature/exec/internal/application/journal.hpp"
#include "armature/exec/internal/application/leftovers.hpp"
#include "armature/exec/internal/application/life_cycle.hpp"
#include "armature/exec/internal/application/mode_control.hpp"
#include "armature/exec/internal/application/outlets.hpp"
#include "armature/exec/internal/application/roster.hpp"
#include "armature/exec/internal/application/run_loop.hpp"
#include "armature/exec/internal/application/stop_guard.hpp"
#include "armature/exec/internal/application/threads.hpp"
#include "armature/exec/internal/application/ticket_pool.hpp"
#include "armature/exec/internal/application/tool_access.hpp"
#include "armature/exec/internal/application/transitions.hpp"
#include "armature/exec/internal/application/unreachable.hpp"
#include "armature/exec/internal/observing/cycle_records.hpp"
#include "armature/exec/internal/observing/watches.hpp"

namespace armature::exec {
namespace {

using component::Outcome;

/// What a hanging thread may still touch stays, and stays reachable, until the process ends.
struct Remains {
  internal::Engines engines;
  std::vector<std::unique_ptr<component::Component>> components;
  std::unique_ptr<internal::Incidents> incidents;
  std::vector<std::shared_ptr<ThreadWatch>> watches;
  std::vector<std::shared_ptr<component::CycleRecord>> cycles;

  static void keep(Remains remains) {
    static auto& all = *new std::vector<Remains>;
    all.push_back(std::move(remains));
  }
};

std::string why_refused(const Outcome& outcome) { return std::string(outcome.reason()); }

template <typename Value>
std::string why_refused(const base::Result<Value>& result) {
  return result.error();
}

/// False if the one who waits for this moment has an objection.
bool is_ready(const std::function<void()>& ready, base::Diagnostics& diagnostics) {
  if (!ready) return true;
  try {
    ready();
  } catch (const std::exception& thrown) {
    diagnostics.error({}, std::string("not ready: ") + thrown.what());
  } catch (...) {
    diagnostics.error({}, "not ready: an exception of an unknown type");
  }
  return diagnostics.ok();
}

/// Simulated time passes as fast as the machine can, or stands still: no drive is to follow it.
void refuse_hardware(const Plan& plan, base::Diagnostics& diagnostics) {
  for (const HardwarePlan& one : plan.hardware) {
    diagnostics.error({},
                      base::quoted(one.component->name()) + " drives a real robot by " + one.bus +
                          ", which does not follow simulated time",
                      "run it in real time, or on a simulated robot");
  }
}

/// Who is configured anew may have been given hardware since the application was checked.
Outcome expect_no_hardware(const Blueprint& blueprint) {
  base::Diagnostics diagnostics;
  refuse_hardware(make_plan(blueprint, diagnostics), diagnostics);
  return diagnostics.ok() ? component::accepted()
                          : component::refused(base::as_reason(diagnostics));
}

}  // namespace

/// What an application is made of. Each part knows those before it that it needs, so that they go
/// in reverse: what a thread may touch goes after the threads, components last.
struct Application::Parts {
  Parts(Blueprint declared, ApplicationOptions wanted)
      : blueprint(std::move(declared)), options(std::move(wanted)) {}

  /// Tells what became of an act.
  template <typename Ending>
  Ending told(std::uint64_t act, Ending ending) {
    if (ending) {
      journal.note_done(act, executor.done_at());
    } else {
      journal.note_refused(act, why_refused(ending));
    }
    return ending;
  }

  Blueprint blueprint;
  const ApplicationOptions options;
  Plan plan;
  internal::Engines engines;
  std::vector<Casualty> casualties;

  internal::Clock clock{options.simulated, options.instants.begin};
  internal::Roster roster{blueprint};
  internal::Unreachable unreachable;
  internal::DeathNotice death_notice;
  internal::Health health{death_notice, unreachable};
  internal::Outlets outlets{options, clock};

  internal::Executor executor{clock, unreachable, death_notice, options.hook_limit};
  internal::TicketPool tickets;
  internal::Journal journal{options, clock, tickets};
  internal::ToolAccess tools{roster, executor, tickets, options.grants};
  internal::ModeControl modes{blueprint, plan, roster, executor, health};
  internal::Transitions transitions{roster, executor, modes};
  internal::Holders holders{blueprint, plan, roster, executor, health};
  internal::Watches watches{plan, roster, engines, executor};
  internal::CycleRecords cycle_records{blueprint, plan, engines, executor};
  internal::StopGuard stop_guard{options.before_stop, roster, holders, tools, transitions, outlets};
  internal::RunLoop loop{options, clock, engines, health, outlets, stop_guard, journal};
  internal::BeforeStop before_stop{options, clock,  roster,  tools, tickets,
                                   holders, health, outlets, loop};

  internal::Connections connections{blueprint, plan, options.output_folder};
  internal::Threads threads{options, plan, engines, unreachable};
  internal::LifeCycle life_cycle{
      options, blueprint, plan, roster, threads, unreachable, [this] { outlets.drain(); }};
  internal::Leftovers leftovers{
      blueprint, plan, engines, unreachable, {options.stop_limit, [this] { outlets.drain(); }}};
};

Application::Application(Blueprint blueprint, ApplicationOptions options)
    : parts_(std::make_unique<Parts>(std::move(blueprint), std::move(options))) {}

Application::~Application() {
  stop();
  if (!hangs()) return;
  Remains remains{std::move(parts_->engines),
                  {},
                  parts_->health.give_away_incidents(),
                  parts_->watches.give_away(),
                  parts_->cycle_records.give_away()};
  for (ComponentEntry& entry : parts_->blueprint.components) {
    remains.components.push_back(std::move(entry.component));
  }
  Remains::keep(std::move(remains));
}

// ---- From start to stop

base::Diagnostics Application::check() {
  base::Diagnostics diagnostics;
  parts_->plan = make_plan(parts_->blueprint, diagnostics);
  if (parts_->options.simulated) refuse_hardware(parts_->plan, diagnostics);
  return diagnostics;
}

base::Diagnostics Application::start() {
  if (running()) return {};
  if (hangs()) {
    base::Diagnostics refusal;
    refusal.error(
        {}, base::quoted(blueprint().name) + " cannot be started again: one of its hooks hangs",
        "end the process");
    return refusal;
  }
  base::Diagnostics diagnostics = check();
  if (!diagnostics.ok()) return diagnostics;
  begin_anew();
  if (bring_up(diagnostics)) {
    go_live();
  } else {
    take_down(diagnostics);
  }
  return diagnostics;
}

base::Diagnostics Application::stop() {
  base::Diagnostics diagnostics;
  if (running()) parts_->journal.note({.kind = Act::Kind::kEnd});
  parts_->health.take_leave_of_the_dead(parts_->engines);
  if (parts_->health.end_of_run()) take_down(diagnostics);
  return diagnostics;
}

void Application::begin_anew() {
  Parts& all = *parts_;
  all.health.begin_anew(all.blueprint);
  all.connections.declare_reactions();
  all.engines.clear();
  all.engines = internal::make_engines(
      all.blueprint, all.plan,
      {&all.health.incidents(), all.options.simulated, all.options.measure_every, now()});
  for (const auto& engine : all.engines) {
    const auto cycles = all.options.instants.cycles.find(engine->context().name);
    if (cycles != all.options.instants.cycles.end()) engine->follow(cycles->second);
  }
  all.outlets.set_engines(all.engines, all.plan);
  all.loop.begin_anew();
  all.modes.set_up(now());
}

bool Application::bring_up(base::Diagnostics& diagnostics) {
  Parts& all = *parts_;
  if (!all.life_cycle.configure(diagnostics)) return false;
  all.connections.make(diagnostics);
  all.outlets.set_black_boxes(all.engines, all.blueprint, all.plan);
  if (!diagnostics.ok() || !all.threads.prepare(diagnostics)) return false;
  const base::Time begin = now();
  for (const auto& engine : all.engines) engine->context().cycle_time = begin;
  if (!all.life_cycle.start(diagnostics)) return false;
  all.threads.populate_memory();
  return is_ready(all.options.ready, diagnostics);
}

void Application::go_live() {
  const base::Time begin = now();
  for (const auto& engine : parts_->engines) engine->begin(begin);
  parts_->health.begin_to_run();
  parts_->threads.go();
}

void Application::take_down(base::Diagnostics& diagnostics) {
  Parts& all = *parts_;
  all.stop_guard.forget_all();
  all.life_cycle.stop(diagnostics);
  all.threads.end(diagnostics);
  all.leftovers.deliver(diagnostics);
  all.casualties = all.life_cycle.casualties();
  all.outlets.drain();
  all.outlets.write_last_black_boxes(all.health.incidents());
  all.life_cycle.clean_up(diagnostics);
  if (!hangs()) all.watches.end_all();
  if (!hangs()) all.cycle_records.end_all();
  if (!hangs()) all.connections.undo();
  all.outlets.end(diagnostics);
}

RunEnd Application::run_for(base::Duration duration, const platform::StopSignal* stop) {
  return run_until(base::later(now(), duration), nullptr, stop);
}

RunEnd Application::run_until(base::Time end, const std::function<bool()>& condition,
                              const platform::StopSignal* stop) {
  return parts_->loop.run_until(end, condition, stop);
}

Pace Application::pace() const { return parts_->loop.pace(); }

base::Result<void> Application::set_pace(const Pace& pace) {
  if (!parts_->options.simulated) {
    return base::Error{"real time has no pace: only a simulated run can be slowed down or paused"};
  }
  if (!(pace.rate > 0.0)) {
    return base::Error{"the pace is a number above 0: 1 is real time, 0.1 a tenth of it"};
  }
  parts_->loop.set_pace(pace);
  return {};
}

base::Result<void> Application::step() {
  if (!pace().paused) return base::Error{"only paused simulated time goes on by steps"};
  parts_->loop.step();
  return {};
}

base::Diagnostics Application::run_before_stop(RunEnd end, const platform::StopSignal* stop,
                                               Leave leave) {
  const auto kind = leave == Leave::kInOrder ? Act::Kind::kBeforeStop : Act::Kind::kMistake;
  parts_->journal.note({.kind = kind, .item = std::string(name_of(end))});
  return parts_->before_stop.run_commands(end, stop, leave);
}

base::Diagnostics Application::hold_until_told(
    const platform::StopSignal* stop, const std::function<bool(base::Duration)>& converse) {
  return parts_->before_stop.hold_until_told(stop, converse);
}

std::vector<Held> Application::held() { return parts_->holders.held(); }

void Application::mourn(const void* workplace, std::string reason) {
  parts_->death_notice.send(workplace, std::move(reason));
}

const LogHistory& Application::log_history() const { return parts_->outlets.history(); }

void Application::drain_logs() { parts_->outlets.drain(); }

// ---- How it fares

bool Application::running() const { return parts_->health.running(); }

bool Application::hangs() const { return parts_->health.hangs(); }

std::uint64_t Application::faults() const { return parts_->health.incidents().faults(); }

std::uint64_t Application::reactions() const { return parts_->health.incidents().reactions(); }

const std::vector<Casualty>& Application::casualties() const { return parts_->casualties; }

base::Time Application::now() const { return parts_->clock.now(); }

const Verdict& Application::verdict() const { return parts_->threads.verdict(); }

const Blueprint& Application::blueprint() const { return parts_->blueprint; }

const Plan& Application::plan() const { return parts_->plan; }

component::Component* Application::find(std::string_view name) const {
  return parts_->roster.find(name);
}

std::vector<ThreadStatistics> Application::thread_statistics() const {
  std::vector<ThreadStatistics> all;
  for (Index t = 0; t < parts_->engines.size(); ++t) {
    Engine& engine = *parts_->engines[t];
    all.push_back({plan().threads[t].name, engine.cycles_run(), engine.cycles_skipped(),
                   engine.log().dropped(), engine.latency_ns().summary(),
                   engine.cycle_ticks().summary()});
  }
  return all;
}

// ---- What is done to its components while it runs

Outcome Application::start_component(std::string_view name) {
  parts_->journal.note({.kind = Act::Kind::kStart, .component = std::string(name)});
  const std::uint64_t act = parts_->journal.last();
  const component::Component* const starts = find(name);
  if (parts_->options.simulated && starts != nullptr && !starts->is_configured()) {
    if (const Outcome outcome = expect_no_hardware(blueprint()); !outcome) {
      return parts_->told(act, outcome);
    }
  }
  return parts_->told(act, parts_->transitions.start(name));
}

Outcome Application::stop_component(std::string_view name) {
  parts_->journal.note({.kind = Act::Kind::kStop, .component = std::string(name)});
  const std::uint64_t act = parts_->journal.last();
  return parts_->told(act, parts_->stop_guard.stop(name));
}

bool Application::is_on_way_to_stop(std::string_view name) const {
  return parts_->stop_guard.is_on_way(name);
}

void Application::cancel_way_to_stop(std::string_view name) {
  parts_->journal.note({.kind = Act::Kind::kCancelStop, .component = std::string(name)});
  parts_->stop_guard.cancel(name);
}

Outcome Application::recover_component(std::string_view name) {
  parts_->journal.note({.kind = Act::Kind::kRecover, .component = std::string(name)});
  const std::uint64_t act = parts_->journal.last();
  return parts_->told(act, parts_->transitions.recover(name));
}

Outcome Application::reset_component(std::string_view name) {
  parts_->journal.note({.kind = Act::Kind::kReset, .component = std::string(name)});
  const std::uint64_t act = parts_->journal.last();
  return parts_->told(act, parts_->transitions.reset(name));
}

Outcome Application::clean_up_component(std::string_view name) {
  parts_->journal.note({.kind = Act::Kind::kCleanUp, .component = std::string(name)});
  const std::uint64_t act = parts_->journal.last();
  return parts_->told(act, parts_->transitions.clean_up(name));
}

Outcome Application::switch_mode(std::string_view name) {
  parts_->journal.note({.kind = Act::Kind::kMode, .item = std::string(name)});
  const std::uint64_t act = parts_->journal.last();
  return parts_->told(act, parts_->modes.switch_to(name));
}

base::Result<void> Application::set_property(std::string_view component, std::string_view property,
                                             const types::Value& value, Caller caller) {
  parts_->journal.note({.kind = Act::Kind::kSet,
                        .component = std::string(component),
                        .item = std::string(property),
                        .values = {value},
                        .caller = caller});
  const std::uint64_t act = parts_->journal.last();
  return parts_->told(act, parts_->tools.set_property(component, property, value, caller));
}

base::Result<types::Value> Application::value_of(std::string_view component,
                                                 std::string_view item) {
  return parts_->tools.value_of(component, item);
}

base::Result<std::optional<types::Value>> Application::call(std::string_view component,
                                                            std::string_view operation,
                                                            std::vector<types::Value> arguments,
                                                            Caller caller) {
  parts_->journal.note({.kind = Act::Kind::kCall,
                        .component = std::string(component),
                        .item = std::string(operation),
                        .values = arguments,
                        .caller = caller});
  const std::uint64_t act = parts_->journal.last();
  return parts_->told(act, parts_->tools.call(component, operation, std::move(arguments), caller));
}

base::Result<component::CommandHandle> Application::begin(std::string_view component,
                                                          std::string_view command,
                                                          std::vector<types::Value> arguments,
                                                          Caller caller) {
  const std::uint32_t number = parts_->journal.note({.kind = Act::Kind::kBegin,
                                                     .component = std::string(component),
                                                     .item = std::string(command),
                                                     .values = arguments,
                                                     .caller = caller});
  const std::uint64_t act = parts_->journal.last();
  return parts_->told(
      act, parts_->tools.begin(component, command, std::move(arguments), caller, number));
}

base::Result<std::int32_t> Application::watch(const std::vector<WatchedNumber>& numbers,
                                              base::Duration interval) {
  if (!running()) return base::Error{base::quoted(blueprint().name) + " does not run"};
  return parts_->watches.begin(numbers, interval);
}

const WatchSample* Application::watched(std::int32_t handle) {
  return parts_->watches.newest(handle);
}

void Application::end_watch(std::int32_t handle) { parts_->watches.end(handle); }

base::Result<RecordedCycle> Application::cycle(std::string_view thread) {
  if (!running()) return base::Error{base::quoted(blueprint().name) + " does not run"};
  return parts_->cycle_records.look(thread);
}

std::uint64_t Application::turns() const { return parts_->journal.turns(); }

void Application::note_written(std::string_view writer, std::string_view input,
                               const types::Value& value) {
  parts_->journal.note({.kind = Act::Kind::kWrite,
                        .component = std::string(writer),
                        .item = std::string(input),
                        .values = {value}});
}

bool Application::run_in_thread_of(component::Component& component, std::function<void()> work) {
  return parts_->executor.run_in_thread_of(component, std::move(work));
}

}  // namespace armature::exec
