// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "armature/exec/application_options.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/internal/application/death_notice.hpp"
#include "armature/exec/internal/application/engines.hpp"
#include "armature/exec/internal/application/unreachable.hpp"
#include "armature/exec/internal/incidents.hpp"
#include "armature/exec/run_end.hpp"

namespace armature::exec::internal {

/// How an application fares: whether it runs or takes its leave, what has faulted, who died.
class Health {
 public:
  Health(DeathNotice& death_notice, Unreachable& unreachable)
      : death_notice_(death_notice), unreachable_(unreachable) {}

  /// Before a start: nothing has gone wrong yet.
  void begin_anew(const Blueprint& blueprint);
  void begin_to_run() { running_ = true; }
  /// @return whether it ran
  bool end_of_run();
  bool running() const { return running_; }

  /// It runs on for what is to be done before the stop, also after a fault.
  void begin_to_leave() { leaving_ = true; }

  /// Nothing but shadows has faulted or been stopped by a reaction since it runs.
  bool in_good_order() const;
  /// A thread of the process has died.
  bool died() const { return died_; }
  /// Something hangs, or a thread has died: the application cannot be started again.
  bool hangs() const { return died_ || unreachable_.any(); }

  /// Takes what a thread ran that has died out of service.
  void take_leave_of_the_dead(const Engines& engines);
  /// Why the run is over, if it is.
  std::optional<RunEnd> end_by_fault(OnFault on_fault) const;

  Incidents& incidents() { return *incidents_; }
  const Incidents& incidents() const { return *incidents_; }
  /// For who keeps what a hanging thread still reports to.
  std::unique_ptr<Incidents> give_away_incidents() { return std::move(incidents_); }

 private:
  DeathNotice& death_notice_;
  Unreachable& unreachable_;
  std::unique_ptr<Incidents> incidents_ = std::make_unique<Incidents>();
  bool running_ = false;
  bool leaving_ = false;
  bool died_ = false;
};

}  // namespace armature::exec::internal
