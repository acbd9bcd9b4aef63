// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/exec/application.hpp"
#include "armature/platform/file.hpp"
#include "armature/platform/printer.hpp"
#include "armature/platform/stop_priority.hpp"
#include "armature/platform/stop_signal.hpp"
#include "armature/runner/console.hpp"
#include "armature/runner/exit_code.hpp"
#include "armature/runner/run_options.hpp"

namespace armature::runner {

// The stages of a run that are the same for `armature run` and for programs that were generated.
// @thread the controlling one

/// Makes the folder of recordings and locks it; an empty name needs none.
/// @return false after an error, which was shown
bool make_output_folder(const std::string& folder, platform::FolderLock& lock,
                        const Console& console);

/// Starts the application, and says what it got of real time and what its check finds.
/// @param told  of the same application, already
/// @return kDone, kNoRealtime if all of real time was required, or kFailed
int start(exec::Application& application, const RunOptions& options, const base::Diagnostics& told,
          const Console& console);

/// While it lives, signals and the end of the run's time are taken before all else, if the run is
/// in real time.
class Urgency {
 public:
  /// @param stop  outlives it
  Urgency(const RunOptions& options, const platform::StopSignal& stop);

 private:
  std::optional<platform::StopPriority> stop_priority_;
  std::optional<platform::Promptness> promptness_;  ///< for what is typed
};

/// Of a run that ended like this, as far as the application knows.
int exit_code(exec::RunEnd end, const exec::Application& application);

/// For an application that hangs: a thread that hangs or is dead still uses everything, so this
/// leaves without taking it down.
[[noreturn]] void leave_now(int code, std::optional<platform::Printer>& printer);

}  // namespace armature::runner
