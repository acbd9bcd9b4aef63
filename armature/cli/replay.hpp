// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/cli/console.hpp"
#include "armature/replay/recorded_deployment.hpp"

namespace armature::cli {

/// What `armature replay` is asked for.
struct ReplayArguments {
  std::string folder;  ///< of the run
  replay::Changes changes;
  std::vector<std::string> only;  ///< components that run again without the others; empty: all
  std::optional<base::Duration> until;
  std::vector<std::string> breakpoints;
  bool step = false;
  std::vector<std::string> library_folders;
  std::string out;  ///< empty: in the folder of the run
};

/// Does a recorded run again; docs/replay.md.
/// @return the exit code
int replay(const ReplayArguments& arguments, Console& console);

}  // namespace armature::cli
