// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/exec/application_options.hpp"
#include "armature/exec/internal/age_watch.hpp"
#include "armature/exec/internal/application/engines.hpp"
#include "armature/exec/internal/application/unreachable.hpp"
#include "armature/exec/internal/start_gate.hpp"
#include "armature/exec/plan.hpp"
#include "armature/exec/verdict.hpp"
#include "armature/platform/idle_states.hpp"
#include "armature/platform/thread.hpp"

namespace armature::exec::internal {

/// The threads in which engines run, and what is asked of the system for them. In simulated time
/// there are none.
class Threads {
 public:
  Threads(const ApplicationOptions& options, const Plan& plan, const Engines& engines,
          Unreachable& unreachable)
      : options_(options), plan_(plan), engines_(engines), unreachable_(unreachable) {}

  /// Reserves memory and makes the threads, which wait then.
  /// @return false if there are none to be had, or not what is required
  bool prepare(base::Diagnostics& diagnostics);
  /// Has what they may touch present in memory, if it is locked.
  void populate_memory() const;
  /// Those that wait begin to serve their engines.
  void go();
  /// However many others are busy, the thread of `context` gets to its work soon.
  void make_prompt(const component::ExecutionContext& context) const;
  /// Ends and joins them, and gives back what was reserved; names those that do not end.
  void end(base::Diagnostics& diagnostics);

  const Verdict& verdict() const { return verdict_; }

 private:
  struct Worker {
    Engine* engine;
    std::unique_ptr<platform::Thread> thread;
  };

  void reserve_system();
  void start_workers();
  void start_worker(Index thread);
  bool join(Worker& worker, base::Diagnostics& diagnostics);

  const ApplicationOptions& options_;
  const Plan& plan_;
  const Engines& engines_;
  Unreachable& unreachable_;
  std::vector<Worker> workers_;
  std::unique_ptr<AgeWatch> age_watch_;
  std::shared_ptr<StartGate> gate_;
  Verdict verdict_;
  std::optional<platform::IdleStateHold> idle_states_;
  bool memory_locked_ = false;
};

}  // namespace armature::exec::internal
