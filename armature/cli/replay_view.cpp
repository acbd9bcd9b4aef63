// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/replay_view.hpp"

#include <string>
#include <utility>

#include "armature/platform/terminal.hpp"

namespace armature::cli {
std::string time_in_run(base::Time time, base::Time begin) {
  const base::Duration since = time - begin;
  return base::to_text(
      begin == base::Time{} ? since : std::chrono::floor<std::chrono::microseconds>(since));
}

ReplayView::ReplayView(exec::Application& application, const ReplayArguments& arguments,
                       const Console& console)
    : application_(application),
      console_(console),
      changed_(application),
      begin_(application.now()),
      steps_(arguments.step),
      at_terminal_(platform::is_terminal(platform::kStandardInput) &&
                   platform::is_terminal(platform::kStandardOutput)) {
  for (const std::string& text : arguments.breakpoints) {
    auto made = replay::Breakpoint::parse(application, text);
    if (made) {
      breakpoints_.push_back(std::move(made).value());
    } else {
      console.say(rt::LogLevel::kError, "--break: " + made.error());
      ok_ = false;
    }
  }
  if (at_terminal_ && (steps_ || !breakpoints_.empty())) {
    console.print("Enter or s: to the next change; c: on to the next --break; q: ends here\n");
  }
}

bool ReplayView::look() {
  bool waits = look_at_breakpoints();
  if (steps_) {
    const std::string changes = changed_.look();
    if (!changes.empty()) {
      console_.print(time_in_run(application_.now(), begin_) + "  " + changes + "\n");
      waits = true;
    }
  }
  return !waits || !at_terminal_ || ask();
}

bool ReplayView::look_at_breakpoints() {
  bool any = false;
  for (replay::Breakpoint& breakpoint : breakpoints_) {
    const auto why = breakpoint.look();
    if (!why) continue;
    console_.print("break at " + time_in_run(application_.now(), begin_) + ": " + *why + " (" +
                   breakpoint.text() + ")\n");
    any = true;
  }
  return any;
}

bool ReplayView::ask() {
  const platform::SingleKeys keys(platform::kStandardInput);
  while (true) {
    const auto read = platform::read_some(platform::kStandardInput, 1);
    if (!read || read->empty() || *read == "q") return false;
    if (*read == "c") {
      steps_ = false;
      return true;
    }
    if (*read != "\n" && *read != "\r" && *read != "s" && *read != " ") continue;
    if (!steps_) static_cast<void>(changed_.look());  // what changed up to here is no news
    steps_ = true;
    return true;
  }
}

}  // namespace armature::cli
