// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/exec/application_options.hpp"
#include "armature/exec/internal/application/clock.hpp"
#include "armature/exec/internal/application/engines.hpp"
#include "armature/exec/internal/black_boxes.hpp"
#include "armature/exec/internal/incidents.hpp"
#include "armature/exec/internal/log_pump.hpp"
#include "armature/exec/internal/timeline_pump.hpp"

namespace armature::exec::internal {

/// Where what an application has to tell comes out: log lines, its timeline, its black boxes.
class Outlets {
 public:
  Outlets(const ApplicationOptions& options, const Clock& clock);

  /// The engines that are asked for lines and timelines from now on.
  void set_engines(const Engines& engines, const Plan& plan);
  /// Has them keep black boxes. All ports have their shape.
  void set_black_boxes(const Engines& engines, const Blueprint& blueprint, const Plan& plan);

  /// Hands log lines and the timeline to their sinks.
  void drain();
  /// The same in simulated time, where only this engine has done anything.
  void drain_after_turn(Engine& engine);
  /// The controlling thread's own line. Empty texts say nothing.
  void say(const std::string& text);
  const LogHistory& history() const { return logs_.history(); }
  void tell_losses_now_and_then() { logs_.tell_losses_now_and_then(clock_.now()); }
  /// Writes what led to a fault, if it is time.
  void write_black_boxes(Incidents& incidents);
  /// The same at once: nothing will come.
  void write_last_black_boxes(Incidents& incidents);
  /// Lines to the last, which ones were lost, and whether their receiver has taken them.
  void end(base::Diagnostics& diagnostics);

 private:
  const Clock& clock_;
  const bool simulated_;
  LogPump logs_;
  TimelinePump timeline_;
  BlackBoxes black_boxes_;
};

}  // namespace armature::exec::internal
