// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/exec/application_options.hpp"
#include "armature/exec/internal/application/roster.hpp"
#include "armature/exec/internal/application/threads.hpp"
#include "armature/exec/internal/application/unreachable.hpp"
#include "armature/exec/internal/hook_series.hpp"
#include "armature/exec/plan.hpp"
#include "armature/exec/run_end.hpp"

namespace armature::exec::internal {

/// How all components come up, and go down in reverse order. A hook that hangs is named, and nobody
/// waits for it longer than it may take.
class LifeCycle {
 public:
  /// @param meanwhile  done now and then by the thread that waits for hooks
  LifeCycle(const ApplicationOptions& options, const Blueprint& blueprint, const Plan& plan,
            const Roster& roster, const Threads& threads, Unreachable& unreachable,
            std::function<void()> meanwhile)
      : options_(options),
        blueprint_(blueprint),
        plan_(plan),
        roster_(roster),
        threads_(threads),
        unreachable_(unreachable),
        meanwhile_(std::move(meanwhile)) {}

  /// False if a component refuses or hangs, which is reported.
  bool configure(base::Diagnostics& diagnostics) const;
  bool start(base::Diagnostics& diagnostics) const;

  /// In reverse order of start; neighbours in this order that share a thread are stopped in one go.
  void stop(base::Diagnostics& diagnostics) const;
  void clean_up(base::Diagnostics& diagnostics) const;

  /// Who has faulted, is in an error, was stopped by a reaction or hangs.
  std::vector<Casualty> casualties() const;

 private:
  /// One step up for all components.
  struct Stage {
    HookSeries::Transition transition;
    const char* hook;
    const char* verb;
    bool ends_at_refusal;
  };
  using Group = std::vector<component::Component*>;

  bool run(const Stage& stage, Group components, base::Diagnostics& diagnostics) const;
  void stop_group(const Group& group, base::Diagnostics& diagnostics) const;
  void stop_here(const Group& group, base::Diagnostics& diagnostics) const;
  void stop_in_thread(const Group& group, base::Diagnostics& diagnostics) const;
  void report_hang(const component::Component& component, const char* hook, base::Duration limit,
                   base::Diagnostics& diagnostics) const;
  HookPatience patience(base::Duration limit) const { return {limit, meanwhile_}; }

  const ApplicationOptions& options_;
  const Blueprint& blueprint_;
  const Plan& plan_;
  const Roster& roster_;
  const Threads& threads_;
  Unreachable& unreachable_;
  const std::function<void()> meanwhile_;
};

}  // namespace armature::exec::internal
