// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/stages.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/platform/death_watch.hpp"
#include "armature/platform/process.hpp"
#include "armature/runner/run_texts.hpp"

namespace armature::runner {

using rt::LogLevel;

namespace {

/// What a start says that was not told before: it checks the plan again.
base::Diagnostics news_in(const base::Diagnostics& all, const base::Diagnostics& told) {
  base::Diagnostics news;
  for (const base::Diagnostic& each : all.all()) {
    const bool known = std::ranges::any_of(told.all(), [&](const base::Diagnostic& other) {
      return base::to_text(other) == base::to_text(each);
    });
    if (!known) news.add(each);
  }
  return news;
}

}  // namespace

bool make_output_folder(const std::string& folder, platform::FolderLock& lock,
                        const Console& console) {
  if (folder.empty()) return true;
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) {
    console.say(LogLevel::kError, "cannot make the folder '" + folder + "': " + failure.message());
    return false;
  }
  auto locked = platform::FolderLock::take(folder);
  if (!locked) {
    console.say(LogLevel::kError, locked.error() + "; give --out another folder");
    return false;
  }
  lock = std::move(locked).value();
  return true;
}

int start(exec::Application& application, const RunOptions& options, const base::Diagnostics& told,
          const Console& console) {
  const base::Diagnostics diagnostics = application.start();
  tell_verdict(application, console);
  console.show(news_in(diagnostics, told));
  if (diagnostics.ok()) return kDone;
  const bool refused = options.realtime == exec::RealtimeMode::kRequire && !options.simulated &&
                       !application.verdict().complete();
  return refused ? kNoRealtime : kFailed;
}

Urgency::Urgency(const RunOptions& options, const platform::StopSignal& stop) {
  if (!options.urges()) return;
  promptness_.emplace();
  stop_priority_.emplace(stop, base::later(platform::monotonic_now(), options.longest()));
}

int exit_code(exec::RunEnd end, const exec::Application& application) {
  if (end == exec::RunEnd::kFaulted || application.faults() > 0) return kFailed;
  const bool by_reaction = end == exec::RunEnd::kStoppedByReaction || application.reactions() > 0;
  return by_reaction ? kStoppedByReaction : kDone;
}

void leave_now(int code, std::optional<platform::Printer>& printer) {
  printer.reset();
  if (const platform::Death* const death = platform::DeathWatch::death()) {
    platform::DeathWatch::conclude(*death);
  }
  platform::exit_now(code);
}

}  // namespace armature::runner
