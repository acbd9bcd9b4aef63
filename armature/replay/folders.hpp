// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/record/mcap_reader.hpp"
#include "armature/replay/comparison.hpp"
#include "armature/replay/experiment.hpp"

namespace armature::replay {

/// The file that says that a folder was made by a replay, which may empty it for the next one.
inline constexpr const char* kReplayFile = "replay.json";

/// Whether the run in `folder` recorded anything.
bool has_recordings(const std::string& folder);

/// Recordings in the folder of a run.
/// @param names  of their files; those that are not there are left out
std::vector<std::unique_ptr<record::McapRecording>> load_recordings(
    const std::string& folder, const std::set<std::string>& names, base::Diagnostics& diagnostics);

/// Samples that the recorders of a run dropped, or could not write, as its summary says.
struct Losses {
  bool known = false;  ///< false: the run has left no summary, since it was killed
  std::uint64_t samples = 0;
};
Losses losses_of(const std::string& folder, const Experiment& experiment);

/// Compares all recordings in the folder of a run, black boxes included, with those of its replay;
/// if only some channels are of interest, what recorders wrote of them.
/// Errors name a recording that cannot be read, or that the other folder lacks.
/// @param was, is   folders
/// @param complete  the replay went to the end of the run: what it lacks would have come by then
Comparison compare_folders(const std::string& was, const std::string& is, bool complete,
                           const ComparisonOptions& options, base::Diagnostics& diagnostics);

/// Whether the summaries of a run and its replay tell of the same end, and of as many faults and
/// reactions. A run that was killed has left none: nothing is compared.
void compare_summaries(const std::string& was, const std::string& is, Comparison& to);

/// The last time in the recordings of a folder; the begin of time if there are none.
base::Time end_of_recordings(const std::string& folder);

/// Empties `folder`, if a replay made it, or makes it. The error says that somebody else's files
/// are in it, or the recorded run.
/// @param run  the folder of the recorded run
base::Result<void> make_place(const std::string& folder, const std::string& run);

/// Copies recordings and summary of a run, for a report beside another run.
base::Result<void> copy_run(const std::string& from, const std::string& to);

}  // namespace armature::replay
