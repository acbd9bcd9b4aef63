// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/cli/console.hpp"
#include "armature/cli/replay.hpp"
#include "armature/exec/application.hpp"
#include "armature/replay/breakpoint.hpp"
#include "armature/replay/changed_ports.hpp"

namespace armature::cli {

/// Since the begin of a run; of one in real time, which began at some time, in microseconds.
std::string time_in_run(base::Time time, base::Time begin);

/// Looks on while a run is done again: a line for each instant at which something changes
/// (`--step`), and where a condition becomes true (`--break`). At a terminal the replay waits there
/// for a key; through a pipe it goes on.
class ReplayView {
 public:
  /// Says what is wrong with the conditions.
  /// @param application  has been started, and outlives it, like the others
  ReplayView(exec::Application& application, const ReplayArguments& arguments,
             const Console& console);
  bool ok() const { return ok_; }

  /// At an instant of which all is done.
  /// @return false: the replay is to end here
  bool look();

 private:
  bool look_at_breakpoints();
  /// @return false: the user wants no more
  bool ask();

  exec::Application& application_;
  const Console& console_;
  std::vector<replay::Breakpoint> breakpoints_;
  replay::ChangedPorts changed_;
  const base::Time begin_;  ///< of the run's time
  bool steps_;
  const bool at_terminal_;
  bool ok_ = true;
};

}  // namespace armature::cli
