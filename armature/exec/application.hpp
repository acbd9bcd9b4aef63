// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/component/operations/call_record.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/exec/application_options.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/observing/log_history.hpp"
#include "armature/exec/plan.hpp"
#include "armature/exec/recorded_cycle.hpp"
#include "armature/exec/run_end.hpp"
#include "armature/exec/verdict.hpp"
#include "armature/exec/watch.hpp"

namespace armature::platform {
class StopSignal;
}

namespace armature::exec {

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

  /// How simulated time passes: as `ApplicationOptions::pace` says at the start. A pause holds up
  /// time, not those who ask: tools are answered, signals end the run.
  Pace pace() const;
  /// Refused in real time, and for a rate that is not above 0.
  base::Result<void> set_pace(const Pace& pace);
  /// Of a pause: goes to the next instant at which something is due, and does all of it. Refused
  /// unless simulated time is paused.
  base::Result<void> step();

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

  bool running() const;
  /// A hook did not return: the process should end by platform::exit_now. This application cannot
  /// be started again.
  bool hangs() const;
  /// Components that faulted since the start.
  std::uint64_t faults() const;
  /// Components that a declared reaction stopped: old data, a writer out of service.
  std::uint64_t reactions() const;
  /// Who had faulted, was in an error or had been stopped by a reaction when it was last stopped.
  const std::vector<Casualty>& casualties() const;

  base::Time now() const;
  const Verdict& verdict() const;
  const Blueprint& blueprint() const;
  const Plan& plan() const;
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
  /// For who writes inputs from outside: tells of the act before it is done.
  void note_written(std::string_view writer, std::string_view input, const types::Value& value);
  /// That threads took in simulated time since the start (see exec/act.hpp).
  std::uint64_t turns() const;

  /// Has numbers copied by their threads after a cycle, no more often than that, so that looking at
  /// them costs no message. It ends with the run, or by `end_watch`.
  /// @return its handle; the error says that it does not run, or whose thread does not answer
  base::Result<std::int32_t> watch(const std::vector<WatchedNumber>& numbers,
                                   base::Duration interval);
  /// What was copied last; nullptr if there is no such watch. Good until the next call.
  const WatchSample* watched(std::int32_t handle);
  void end_watch(std::int32_t handle);

  /// The cycle of a thread that was recorded last, step by step, and has the thread record its next
  /// one: who looks again and again sees ever newer ones, and nothing is recorded for nobody.
  /// @return the error says that it does not run, that there is no such thread, or that it does not
  ///   answer
  base::Result<RecordedCycle> cycle(std::string_view thread);

  std::vector<ThreadStatistics> thread_statistics() const;

  /// The newest lines of the log.
  const LogHistory& log_history() const;

  /// Hands log lines and the timeline to their sinks; `run_for` does it too.
  void drain_logs();

 private:
  struct Parts;

  void begin_anew();
  bool bring_up(base::Diagnostics& diagnostics);
  void go_live();
  void take_down(base::Diagnostics& diagnostics);

  std::unique_ptr<Parts> parts_;
};

}  // namespace armature::exec
