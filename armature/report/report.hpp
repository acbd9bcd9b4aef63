// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/diagnostic.hpp"

namespace armature::report {

/// What is reported, and where to.
struct Options {
  std::string folder;  ///< of a run, or of folders of runs
  std::string page;    ///< the file to write; empty: report.html in that folder
};

/// Where everything went.
struct Written {
  std::string page;     ///< HTML that needs no other file and no network
  std::string figures;  ///< report.json in the folder: the figures for programs
};

/// Shows what runs of an application left in their folders: positions and errors of the joints, the
/// figures of each controller, the timeline of a cycle, and what was lost or went wrong.
/// docs/report.md has what it looks for and what the figures are.
///
/// Writes nothing after an error; each one says what was expected where.
Written write_report(const Options& options, base::Diagnostics& diagnostics);

}  // namespace armature::report
