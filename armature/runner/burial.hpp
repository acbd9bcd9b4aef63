// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/exec/application.hpp"
#include "armature/platform/death_watch.hpp"
#include "armature/runner/console.hpp"

namespace armature::runner {

/// While it exists, what ends the process from within a component (a crash, `exit`) is named, with
/// its call stack, and everything else stops in order before the process ends. Made by the
/// controlling thread.
class Burial {
 public:
  /// @param application, console  outlive it
  Burial(exec::Application& application, const Console& console);

 private:
  void bury(const platform::Death& death);

  exec::Application& application_;
  const Console& console_;
  const int controller_ = platform::thread_number();
  const platform::CrashStack crash_stack_;
  const platform::DeathWatch watch_;
};

}  // namespace armature::runner
