// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/cli/console.hpp"
#include "armature/exec/application.hpp"
#include "armature/report/run_summary.hpp"

namespace armature::cli {

/// Keeps what a run's summary tells of its log: warnings, errors and moments such as `armed`. It
/// has no more than the first thousand of each: an application that complains in every cycle is not
/// to fill the memory.
void note_for_summary(report::RunFacts& facts, const rt::LogRecord& record);

/// Leaves run.json in the folder of the recordings.
/// @return false after an error, which was shown
bool write_run_summary(const std::string& folder, const report::RunFacts& facts,
                       const exec::Application& application, const Console& console);

}  // namespace armature::cli
