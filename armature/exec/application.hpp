// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/engine.hpp"
#include "armature/exec/plan.hpp"
#include "armature/exec/verdict.hpp"
#include "armature/platform/thread.hpp"

namespace armature::platform {
class StopSignal;
}

namespace armature::exec {

namespace internal {
class StartGate;
}

enum class RealtimeMode : std::uint8_t {
  kOff,      ///< asks for nothing
  kPrefer,   ///< asks, and goes on with what it gets
  kRequire,  ///< refuses to start without all of it
};

enum class OnFault : std::uint8_t {
  kContinue,  ///< what does not depend on the faulted component goes on
  kStop,      ///< everything stops in order
};

struct ApplicationOptions {
  RealtimeMode realtime = RealtimeMode::kOff;
  bool simulated = false;
  OnFault on_fault = OnFault::kContinue;
  base::Duration hook_limit = std::chrono::seconds(10);  ///< a hook that takes longer hangs
  base::Duration stop_limit = std::chrono::seconds(1);   ///< the same while stopping
  std::uint64_t measure_every = 16;  ///< execution times are taken in every n-th cycle
  std::function<void(const rt::LogRecord&)> log;
};

/// Why a run ended.
enum class RunEnd : std::uint8_t { kTimeUp, kStopRequested, kFaulted, kStoppedByReaction };

struct ThreadStatistics {
  std::string name;
  std::uint64_t cycles_run;
  std::uint64_t cycles_skipped;
  std::uint64_t log_lines_dropped;
  rt::DistributionSummary latency_ns;   ///< periodic threads: how late cycles began
  rt::DistributionSummary cycle_ticks;  ///< multiply with platform::tick_period_ns()
};

/// Runs a blueprint: checks it, starts it as a whole or not at all, and stops it in order on every
/// way out, its destructor included.
///
/// All functions are for one controlling thread, which is no real-time thread.
class Application final : private component::Supervisor {
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

  /// Stops in reverse order of start and cleans up; the diagnostics name hooks that hang.
  base::Diagnostics stop();

  bool running() const { return running_; }
  /// A thread did not end: the process should, by platform::exit_now.
  bool hangs() const { return hangs_; }
  /// Components that faulted since the start.
  std::uint64_t faults() const { return faults_.load(std::memory_order_relaxed); }
  /// Components that a declared reaction stopped: old data, a writer out of service.
  std::uint64_t reactions() const { return reactions_.load(std::memory_order_relaxed); }

  base::Time now() const;
  const Verdict& verdict() const { return verdict_; }
  const Blueprint& blueprint() const { return blueprint_; }
  const Plan& plan() const { return plan_; }
  component::Component* find(std::string_view name) const;

  // --- while it runs: each is executed by the component's own thread
  // ------------------------------
  component::Outcome start_component(std::string_view name);
  component::Outcome stop_component(std::string_view name);
  component::Outcome recover_component(std::string_view name);
  component::Outcome reset_component(std::string_view name);
  base::Result<void> set_property(std::string_view component, std::string_view property,
                                  const types::Value& value);
  /// The current value of a property or port.
  base::Result<types::Value> value_of(std::string_view component, std::string_view item);
  base::Result<std::optional<types::Value>> call(std::string_view component,
                                                 std::string_view operation,
                                                 std::vector<types::Value> arguments);
  /// Runs `work` in the thread of `component`, or here if that thread does not run; false if it was
  /// not done within the hook limit.
  bool run_in_thread_of(const component::Component& component, std::function<void()> work);

  std::vector<ThreadStatistics> thread_statistics() const;

  /// Hands log lines to the sink; `run_for` does it too.
  void drain_logs();

 private:
  void component_faulted(component::Component& component) override;
  void component_stopped_itself(component::Component& component) override;

  component::Component& component_at(Index index) const {
    return *blueprint_.components[index].component;
  }
  void make_engines();
  bool configure_all(base::Diagnostics& diagnostics);
  bool connect_all(base::Diagnostics& diagnostics);
  bool prepare_threads(base::Diagnostics& diagnostics);
  bool start_all(base::Diagnostics& diagnostics);
  void go_live();
  void apply_declared_reactions();
  void stop_started(base::Diagnostics& diagnostics);
  void end_threads(base::Diagnostics& diagnostics);
  void clean_up(base::Diagnostics& diagnostics);
  void disconnect_all();
  bool for_each_watched(const std::vector<Index>& order, std::string_view what,
                        const std::function<bool(Index)>& each, base::Diagnostics& diagnostics);
  RunEnd simulate_until(base::Time end, const platform::StopSignal* stop);
  Engine* next_engine(base::Time now);
  component::Outcome change(std::string_view name,
                            component::Outcome (*transition)(component::Component&));
  std::optional<RunEnd> end_by_fault() const;

  Blueprint blueprint_;
  ApplicationOptions options_;
  Plan plan_;
  std::vector<std::unique_ptr<Engine>> engines_;
  std::vector<std::unique_ptr<platform::Thread>> threads_;
  std::vector<Index> engines_by_urgency_;
  std::vector<Index> started_;
  Verdict verdict_;
  std::unique_ptr<internal::StartGate> gate_;
  std::atomic<std::uint64_t> faults_{0};
  std::atomic<std::uint64_t> reactions_{0};
  base::Time simulated_now_{};
  bool memory_locked_ = false;
  bool running_ = false;
  bool hangs_ = false;
};

}  // namespace armature::exec
