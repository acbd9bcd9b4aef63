// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/component/operations/call_record.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/exec/black_box.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/engine.hpp"
#include "armature/exec/internal/black_boxes.hpp"
#include "armature/exec/internal/hook_series.hpp"
#include "armature/exec/internal/incidents.hpp"
#include "armature/exec/internal/log_pump.hpp"
#include "armature/exec/internal/timeline_pump.hpp"
#include "armature/exec/plan.hpp"
#include "armature/exec/timeline.hpp"
#include "armature/exec/verdict.hpp"
#include "armature/platform/idle_states.hpp"
#include "armature/platform/thread.hpp"

namespace armature::platform {
class StopSignal;
}

namespace armature::exec {

namespace internal {
class AgeWatch;
class Simulation;
class ToolTicket;
class StartGate;
}  // namespace internal

class Modes;

/// How much of the real-time means of the system an application asks for.
enum class RealtimeMode : std::uint8_t {
  kOff,      ///< asks for nothing
  kPrefer,   ///< asks, and goes on with what it gets
  kRequire,  ///< refuses to start without all of it
};

/// What a fault of one component means for the application.
enum class OnFault : std::uint8_t {
  kStopDependents,  ///< what depends on the faulted component stops, the rest goes on
  kStopAll,         ///< everything stops in order
  /// What reads from it goes on with its last values, unless the connection says otherwise.
  kKeepRunning,
};
ARMATURE_ENUM(OnFault, kStopDependents, kStopAll, kKeepRunning);

/// On whose behalf operations and commands are called.
enum class Caller : std::uint8_t {
  kOperator,  ///< the operator's own program
  kScript,
  kRemote,  ///< another process
};

/// An act of the operator (`component::by_operator`) that a caller may do in the operator's stead:
/// an operation to call, or a property to set.
struct Grant {
  Caller caller;
  std::string component;
  std::string operation;
};

/// A command without arguments.
struct CommandName {
  std::string component;
  std::string command;
};

/// How an application runs.
struct ApplicationOptions {
  RealtimeMode realtime = RealtimeMode::kOff;
  bool simulated = false;
  OnFault on_fault = OnFault::kStopDependents;
  std::vector<Grant> grants;
  std::vector<CommandName> before_stop;                        ///< for `run_before_stop`
  base::Duration hold_at_stop = std::chrono::minutes(1);       ///< while the operator is asked
  base::Duration before_stop_limit = std::chrono::minutes(1);  ///< for each of them
  base::Duration hook_limit = std::chrono::seconds(10);        ///< a hook that takes longer hangs
  base::Duration stop_limit = std::chrono::seconds(1);         ///< the same while stopping
  /// Execution times of components are taken in every n-th cycle; 0: about four times a second,
  /// which is nearly free at any rate and number of components.
  std::uint64_t measure_every = 0;
  /// Where the files of recorders go that are named without a folder; empty: the working directory.
  std::string output_folder;
  std::function<void(const rt::LogRecord&)> log;  ///< called by the controlling thread
  TimelineOptions timeline;
  BlackBoxOptions black_box;
  /// Called by `start` when all is in place, before the first cycle; if it throws, nothing starts.
  std::function<void()> ready;
  /// Called by the controlling thread while it lets the application run, which it may use: in
  /// simulated time whenever all that is due at an instant is done, else every millisecond.
  std::function<void()> attend;
};

/// What the application does before it stops.
enum class Leave : std::uint8_t {
  kInOrder,       ///< the commands of `before_stop`
  kAfterMistake,  ///< nothing begins: who commanded it does not know what it does
};

/// What a component keeps from moving by itself, as it says (component/holding.hpp).
struct Held {
  std::string component;
  std::string what;
  bool answers = true;  ///< its thread does; else nobody knows, and it cannot go on holding
};

/// Why a run ended.
enum class RunEnd : std::uint8_t {
  kTimeUp,
  kStopRequested,
  kFaulted,
  kStoppedByReaction,
  kConditionMet
};

/// What a thread did since its start.
struct ThreadStatistics {
  std::string name;
  std::uint64_t cycles_run;
  std::uint64_t cycles_skipped;
  std::uint64_t log_lines_dropped;
  rt::DistributionSummary latency_ns;   ///< periodic threads: how late cycles began
  rt::DistributionSummary cycle_ticks;  ///< multiply with platform::tick_period_ns()
};

/// A component that did not get to the end in good order.
struct Casualty {
  std::string component;
  component::State state;  ///< when the application was stopped
  std::string reason;
};

/// Runs a blueprint: checks it, starts it as a whole or not at all, and stops it in order on every
/// way out, its destructor included.
///
/// All functions are for one controlling thread, which is no real-time thread.
class Application final {
 public:
  explicit Application(Blueprint blueprint, ApplicationOptions options = {});
  Application(const Application&) = delete;
  Application& operator=(const Application&) = delete;
  ~Application();

  /// Everything that can be known before start; no effect on the components.
  base::Diagnostics check();

  /// Checks, configures, connects, starts. After an error everything is as it was before.
  base::Diagnostics start();

  /// Lets it run for `duration`, or until `stop` came or a fault ends it; `stop` may be null. In
  /// simulated time as fast as the machine can.
  RunEnd run_for(base::Duration duration, const platform::StopSignal* stop = nullptr);

  /// Lets it run until `end` at most, and no longer than until `condition` is true. It is asked by
  /// the controlling thread: in simulated time whenever all that is due at an instant is done, else
  /// every millisecond.
  RunEnd run_until(base::Time end, const std::function<bool()>& condition,
                   const platform::StopSignal* stop = nullptr);

  /// Cancels what is under way, so that it comes to rest, and lets it run on for the commands of
  /// `before_stop`, as the operator's and one after the other: not after a fault or a reaction, nor
  /// those of a component that holds nothing. Another signal cuts it short.
  /// @param end  how the run has ended
  /// @return errors: which was refused or failed and why, or did not end in time
  base::Diagnostics run_before_stop(RunEnd end, const platform::StopSignal* stop = nullptr,
                                    Leave leave = Leave::kInOrder);

  /// Lets it run on as long as anything is held that would fall if it stopped: asks the operator,
  /// and waits until nothing is held any more, another signal comes or `hold_at_stop` is over.
  /// @param converse  takes the operator's answers for so long at most, and returns whether he said
  ///                  that it may stop; without it only time passes
  /// @return errors: what is let go of without an answer
  base::Diagnostics hold_until_told(const platform::StopSignal* stop = nullptr,
                                    const std::function<bool(base::Duration)>& converse = nullptr);

  /// What would move by itself if the application stopped now.
  std::vector<Held> held();

  /// Stops in reverse order of start and cleans up; the diagnostics name hooks that hang.
  base::Diagnostics stop();

  /// A thread of the process has died, and stands still. What it ran is out of service, and the run
  /// ends as after a fault, whatever `on_fault` says. This application cannot be started again.
  /// @param workplace  the ExecutionContext of the thread's components; nullptr: it runs none
  /// @thread any, once
  void mourn(const void* workplace, std::string reason);

  bool running() const { return running_; }
  /// A hook did not return: the process should end by platform::exit_now. This application cannot
  /// be started again.
  bool hangs() const { return hangs_; }
  /// Components that faulted since the start.
  std::uint64_t faults() const { return incidents_->faults(); }
  /// Components that a declared reaction stopped: old data, a writer out of service.
  std::uint64_t reactions() const { return incidents_->reactions(); }
  /// Who had faulted, was in an error or had been stopped by a reaction when it was last stopped.
  const std::vector<Casualty>& casualties() const { return casualties_; }

  base::Time now() const;
  const Verdict& verdict() const { return verdict_; }
  const Blueprint& blueprint() const { return blueprint_; }
  const Plan& plan() const { return plan_; }
  component::Component* find(std::string_view name) const;

  // --- while it runs: each is executed by the component's own thread -----------------------------
  component::Outcome start_component(std::string_view name);
  /// One that holds something first does its commands of `before_stop`, and stops when they are
  /// done; refused if it holds something still, and for who keeps another holding something.
  component::Outcome stop_component(std::string_view name);
  /// Whether it does the commands of `before_stop` now, since `stop_component` asked for that.
  bool is_on_way_to_stop(std::string_view name) const;
  /// Cancels them: it goes on running, and what moves comes to rest.
  void cancel_way_to_stop(std::string_view name);
  component::Outcome recover_component(std::string_view name);
  component::Outcome reset_component(std::string_view name);
  /// To kPreOperational: the next start configures it anew. Refused unless it is stopped.
  component::Outcome clean_up_component(std::string_view name);
  /// Goes over to another mode between two cycles, see exec/modes.hpp; refused, all is as it was.
  component::Outcome switch_mode(std::string_view name);
  base::Result<void> set_property(std::string_view component, std::string_view property,
                                  const types::Value& value, Caller caller = Caller::kOperator);
  /// The current value of a property or port; of an input, what its component has taken of it.
  base::Result<types::Value> value_of(std::string_view component, std::string_view item);
  base::Result<std::optional<types::Value>> call(std::string_view component,
                                                 std::string_view operation,
                                                 std::vector<types::Value> arguments,
                                                 Caller caller = Caller::kOperator);
  /// Begins a command; the error says why it was refused. The handle tells how it fares, ends with
  /// the component's run at the latest, and may outlive the application.
  base::Result<component::CommandHandle> begin(std::string_view component, std::string_view command,
                                               std::vector<types::Value> arguments,
                                               Caller caller = Caller::kOperator);
  /// Runs `work`, as code of `component`, in its thread, or here if that thread does not run; false
  /// if it was not done within the hook limit.
  bool run_in_thread_of(component::Component& component, std::function<void()> work);

  std::vector<ThreadStatistics> thread_statistics() const;

  /// Hands log lines and the timeline to their sinks; `run_for` does it too.
  void drain_logs();

 private:
  /// One step of the life cycle for all components.
  struct Stage {
    internal::HookSeries::Transition transition;
    const char* hook;
    const char* verb;
    bool ends_at_refusal;
  };
  struct Worker {
    Engine* engine;
    std::unique_ptr<platform::Thread> thread;
  };

  void make_engines();
  void apply_declared_reactions();

  // application_before_stop.cpp
  bool cancel_all(const platform::StopSignal* stop);
  std::string run_last(const CommandName& name, const platform::StopSignal* stop);
  bool holds_nothing(std::string_view component);
  std::optional<Held> held_by(component::Component& component);
  std::optional<Held> held_by_help_of(const component::Component& component);
  void say_held(const std::vector<Held>& held);
  component::Outcome begin_way_to_stop(component::Component& component);
  void finish_ways_to_stop();
  bool in_good_order() const { return running_ && faults() == 0 && reactions() == 0; }

  // application_modes.cpp
  Modes* modes() const;
  void set_up_modes();

  // application_life_cycle.cpp
  bool configure_all(base::Diagnostics& diagnostics);
  bool connect_all(base::Diagnostics& diagnostics);
  void let_observers_look();
  bool start_all(base::Diagnostics& diagnostics);
  bool run_stage(const Stage& stage, std::vector<component::Component*> components,
                 base::Diagnostics& diagnostics);
  void take_down(base::Diagnostics& diagnostics);
  void stop_running(base::Diagnostics& diagnostics);
  void stop_group(const std::vector<component::Component*>& group, base::Diagnostics& diagnostics);
  void deliver_leftovers(base::Diagnostics& diagnostics);
  void deliver_leftovers_of(Index thread, base::Diagnostics& diagnostics);
  void list_casualties();
  void clean_up(base::Diagnostics& diagnostics);
  void disconnect_all();
  void report_hang(const component::Component& component, const char* hook, base::Duration limit,
                   base::Diagnostics& diagnostics);
  void give_up_thread(const component::ExecutionContext& context);
  /// Something hangs in it or in its thread: nobody else may touch it.
  bool is_stuck(const component::Component& component) const {
    return stuck_.count(&component) > 0 || stuck_.count(&component.context()) > 0;
  }
  internal::HookPatience patience(base::Duration limit);

  // application_threads.cpp
  bool prepare_threads(base::Diagnostics& diagnostics);
  void reserve_system();
  void start_workers();
  void start_worker(Index thread);
  bool get_ready(base::Diagnostics& diagnostics);
  void go_live();
  void end_threads(base::Diagnostics& diagnostics);

  RunEnd simulate_until(base::Time end, const std::function<bool()>& condition,
                        const platform::StopSignal* stop);
  RunEnd run_threads_until(base::Time end, const std::function<bool()>& condition,
                           const platform::StopSignal* stop);
  /// What a tool may call on behalf of `caller`, or why it may not.
  base::Result<component::OperationBase*> operation_for(std::string_view component,
                                                        std::string_view operation,
                                                        Caller caller) const;
  /// An error that says why not if `caller` may not do this act of the operator.
  base::Result<void> granted(const component::Component& component, std::string_view act,
                             Caller caller) const;
  internal::ToolTicket& claim_ticket(component::CommandBase& command);
  std::string unknown_component(std::string_view name) const;
  base::Result<types::Value> value_of(component::Component& component, const types::Type& type,
                                      std::function<const void*()> data);
  component::Outcome change(std::string_view name,
                            std::function<component::Outcome(component::Component&)> transition);
  std::optional<RunEnd> end_by_fault();
  void take_leave();
  void say(const std::string& text);
  const ComponentEntry& entry_of(const component::Component& component) const {
    return blueprint_.components[index_of_.at(component.name())];
  }

  Blueprint blueprint_;
  std::unordered_map<std::string_view, Index> index_of_;  ///< by name
  ApplicationOptions options_;
  Plan plan_;
  std::vector<std::unique_ptr<Engine>> engines_;
  std::unique_ptr<internal::Simulation> simulation_;
  internal::LogPump logs_;
  internal::TimelinePump timeline_;
  internal::BlackBoxes black_boxes_;
  std::unique_ptr<internal::Incidents> incidents_;
  std::vector<Worker> workers_;
  std::unique_ptr<internal::AgeWatch> age_watch_;
  std::shared_ptr<internal::StartGate> gate_;
  Verdict verdict_;
  std::optional<platform::IdleStateHold> idle_states_;
  bool memory_locked_ = false;
  std::vector<Casualty> casualties_;
  std::unordered_set<const void*> stuck_;  ///< components and contexts in which something hangs
  /// Of commands that tools began.
  std::vector<std::unique_ptr<internal::ToolTicket, component::SharedRecord::LetGo>> tickets_;
  /// A component that stops when its command is done.
  struct WayToStop {
    CommandName command;
    component::CommandHandle handle;
  };
  std::vector<WayToStop> ways_to_stop_;
  base::Time simulated_now_{};
  bool leaving_ = false;  ///< it runs on for what is to be done before the stop, also after a fault
  std::atomic<bool> mourns_{false};  ///< of whom and why:
  const void* dead_workplace_ = nullptr;
  std::string death_;
  bool died_ = false;
  bool running_ = false;
  bool hangs_ = false;
};

}  // namespace armature::exec
