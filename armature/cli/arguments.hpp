// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/exec/application.hpp"
#include "armature/rt/loaded_guard.hpp"

namespace armature::cli {

/// What a command ends with; the same for all of them.
enum ExitCode {
  kDone = 0,
  kFailed = 1,            ///< the application or its check failed
  kWrongUse = 2,          ///< of the command line
  kNoRealtime = 3,        ///< real time was required and is not to be had
  kStoppedByReaction = 4  ///< a declared safety reaction ended the run
};

/// Options of every command that loads a deployment.
struct LoadArguments {
  std::string file;
  std::vector<std::string> overrides;
  std::vector<std::string> library_folders;
  std::string mode;
  std::string times_file;
};

/// What `armature run` is asked for.
struct RunArguments {
  LoadArguments load;
  bool simulated = false;
  double rate = exec::kAsFastAsPossible;  ///< of simulated time
  std::optional<base::Duration> duration;
  exec::RealtimeMode realtime = exec::RealtimeMode::kPrefer;
  std::optional<rt::GuardMode> guard;
  std::vector<std::string> command_line;  ///< to start again behind the guard
  std::string script;
  bool browse = false;
  std::vector<std::string> listen;  ///< addresses beside those of the deployment
  std::string policy;               ///< a file with rules beside those of the deployment
  std::string write_times;
  std::string output_folder;  ///< of recordings; empty: the working directory
  std::string trace;          ///< the timeline's file; empty: none
  bool statistics = false;
};

/// What `armature browse` is asked for.
}  // namespace armature::cli
