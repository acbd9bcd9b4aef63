// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"
#include "armature/exec/black_box.hpp"

namespace armature::record {

/// Writes a report as a recording that Foxglove and the like open: MCAP with a channel for each
/// port and event, a channel `events` of what happened, and the metadata `fault` with the
/// component, the reason and the time. The file is new: `blackbox-Joint1-2026-11-22T10-20-30.mcap`,
/// with a number if there is one already.
/// @param folder  empty: the working directory
/// @return its path; the error names the file and the system's reason
base::Result<std::string> write_black_box(const exec::BlackBoxReport& report,
                                          const std::string& folder);

/// What becomes of a report, as `BlackBoxOptions::write` says it.
std::string say_written(const exec::BlackBoxReport& report, const std::string& folder);

}  // namespace armature::record
