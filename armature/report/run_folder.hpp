// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/report/effort.hpp"
#include "armature/report/goals.hpp"
#include "armature/report/moments.hpp"
#include "armature/report/phases.hpp"
#include "armature/report/signals.hpp"
#include "armature/report/timeline.hpp"
#include "armature/report/tracking.hpp"
#include "armature/report/velocity.hpp"

namespace armature::report {

/// A trace in a run's folder, beside its recording and its summary.
inline constexpr const char* kTraceFile = "trace.json";
/// The time of a cycle on the bus, in the folder of the runs.
inline constexpr const char* kCycleFile = "io.json";
/// What another program found of the runs, in their folder.
inline constexpr const char* kFiguresFile = "figures.json";
/// That one of the runs was done again with changes, and with which; in their folder.
inline constexpr const char* kWhatIfFile = "what_if.json";
/// What the runs are to reach, in their folder.
inline constexpr const char* kGoalsFile = "to_reach.json";
/// The phases of a cycle, in that folder, too.
inline constexpr const char* kPhasesFile = "phases.json";

/// A run as its folder has it. Something of it is there: a recording or a summary.
struct Run {
  std::string name;       ///< the folder's
  std::string recording;  ///< its file; empty: none
  bool cut_off = false;   ///< the recording has no end: what is whole of it was read
  Signals signals;
  std::vector<Joint> joints;
  std::vector<Velocity> velocities;  ///< of the joints, as they come
  std::vector<Effort> efforts;
  Moments moments;
  std::string summary;  ///< JSON of `write_run_summary`; empty: none
  std::optional<Timeline> timeline;
  /// Of each phase of the folder, beside a timeline [us].
  std::vector<std::optional<double>> phase_computing_us;
};

/// Everything that a folder of runs has.
struct Runs {
  std::string name;            ///< the folder's
  std::vector<Run> runs;       ///< of the folder itself, or of those in it, by their names
  std::string cycle_json;      ///< the content of kCycleFile; empty: none
  std::string figures_json{};  ///< the content of kFiguresFile; empty: none
  std::string what_if_json{};  ///< the content of kWhatIfFile; empty: none
  std::vector<Goal> goals{};
  Phases phases{};
};

/// Reads a run's folder or a folder of run folders. Errors name the file, what was expected and
/// what was found; a recording that was cut off is a warning.
Runs load_runs(const std::string& folder, base::Diagnostics& diagnostics);

}  // namespace armature::report
