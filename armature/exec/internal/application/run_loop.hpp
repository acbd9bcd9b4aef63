// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "armature/exec/application_options.hpp"
#include "armature/exec/internal/application/clock.hpp"
#include "armature/exec/internal/application/engines.hpp"
#include "armature/exec/internal/application/health.hpp"
#include "armature/exec/internal/application/journal.hpp"
#include "armature/exec/internal/application/outlets.hpp"
#include "armature/exec/internal/application/pacer.hpp"
#include "armature/exec/internal/application/stop_guard.hpp"
#include "armature/exec/internal/simulation.hpp"
#include "armature/exec/run_end.hpp"

namespace armature::platform {
class StopSignal;
}

namespace armature::exec::internal {

/// What the controlling thread does while the application runs: in simulated time it is what runs
/// it, else it only attends to what the threads leave behind.
class RunLoop {
 public:
  RunLoop(const ApplicationOptions& options, Clock& clock, const Engines& engines, Health& health,
          Outlets& outlets, StopGuard& stop_guard, Journal& journal)
      : options_(options),
        clock_(clock),
        engines_(engines),
        health_(health),
        outlets_(outlets),
        stop_guard_(stop_guard),
        journal_(journal) {}

  /// The engines are others than before.
  void begin_anew();

  /// Goes on until `end` at most, and no longer than until `condition`, a signal or a fault.
  RunEnd run_until(base::Time end, const std::function<bool()>& condition,
                   const platform::StopSignal* stop);

  // How simulated time passes; in real time none of them has an effect.
  Pace pace() const { return pacer_.pace(); }
  void set_pace(const Pace& pace);
  /// While paused: one more instant at which something is due.
  void step() { pacer_.step(); }

 private:
  RunEnd simulate_until(base::Time end, const std::function<bool()>& condition,
                        const platform::StopSignal* stop);
  RunEnd attend_until(base::Time end, const std::function<bool()>& condition,
                      const platform::StopSignal* stop);
  /// Goes to `next` if its moment has come; else waits a millisecond at most, so that tools and
  /// signals are attended to.
  void pass_to(base::Time next, const platform::StopSignal* stop);
  std::optional<RunEnd> end_by_fault();
  void attend();

  const ApplicationOptions& options_;
  Clock& clock_;
  const Engines& engines_;
  Health& health_;
  Outlets& outlets_;
  StopGuard& stop_guard_;
  Journal& journal_;
  std::optional<Simulation> simulation_;
  Pacer pacer_;
};

}  // namespace armature::exec::internal
