// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/rt/loaded_guard.hpp"
#include "armature/runner/exit_code.hpp"
#include "armature/runner/run_options.hpp"

namespace armature::cli {

using runner::ExitCode;
using runner::kDiffers;
using runner::kDone;
using runner::kFailed;
using runner::kNoRealtime;
using runner::kNotAllCompared;
using runner::kStoppedByReaction;
using runner::kWrongUse;

/// Options of every command that loads a deployment.
struct LoadArguments {
  std::string file;
  std::vector<std::string> overrides;
  std::vector<std::string> library_folders;
  std::string mode;
  std::string times_file;
};

/// What `armature run` is asked for.
struct RunArguments : runner::RunOptions {
  LoadArguments load;
  std::optional<rt::GuardMode> guard;
  std::vector<std::string> command_line;  ///< to start again behind the guard
  std::string script;
  bool browse = false;
  std::vector<std::string> listen;  ///< addresses beside those of the deployment
  std::string policy;               ///< a file with rules beside those of the deployment
  std::string tokens;               ///< a file of what lets in at ws:// and wss:// addresses
  std::string write_times;
  std::string trace;  ///< the timeline's file; empty: none
};

}  // namespace armature::cli
