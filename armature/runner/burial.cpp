// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/burial.hpp"

#include "armature/exec/death.hpp"
#include "armature/platform/printer.hpp"
#include "armature/platform/terminal.hpp"

namespace armature::runner {

Burial::Burial(exec::Application& application, const Console& console)
    : application_(application),
      console_(console),
      watch_(exec::name_worker, [this](const platform::Death& death) { bury(death); }) {}

/// The controlling thread does the rest, unless it is the dead one.
void Burial::bury(const platform::Death& death) {
  const std::string what = exec::sentence(death);
  console_.say(rt::LogLevel::kError, "fatal: " + what);
  platform::print(platform::kStandardError, exec::stack_of(death));
  application_.mourn(death.workplace, "its thread has died: " + what);
  if (death.thread != controller_) return;
  console_.show(application_.stop());
  platform::Printer::flush(std::chrono::seconds(1));
  platform::DeathWatch::conclude(death);
}

}  // namespace armature::runner
