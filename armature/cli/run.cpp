// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "armature/cli/commands.hpp"
#include "armature/cli/companions.hpp"
#include "armature/cli/load.hpp"
#include "armature/cli/network.hpp"
#include "armature/cli/report.hpp"
#include "armature/deploy/builder.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/deploy/schedule.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/file.hpp"
#include "armature/platform/memory.hpp"
#include "armature/platform/process.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::cli {
namespace {

using rt::LogLevel;

/// Long enough to be "until stopped", short enough to be added to any time.
constexpr base::Duration kUntilStopped = std::chrono::hours(24 * 365 * 100);

/// What reads and checks deployments, and descriptions of robots, is not needed while one runs: no
/// real-time thread ever runs any of it. It comes back when the run has ended. The program itself
/// stays: the C++ library may use functions of `std::string` that were compiled into it.
void release_what_loads() {
  constexpr std::string_view kLibraries[] = {"libarmature_deploy.so", "libyaml-cpp.so",
                                             "libpugixml.so",         "liburdfdom_model.so",
                                             "libtinyxml.so",         "libconsole_bridge.so"};
  platform::release_code(kLibraries);
}

void tell_verdict(const exec::Application& application, const Console& console) {
  for (const exec::Verdict::Line& line : application.verdict().lines) {
    const bool granted = line.refusals.empty();
    console.say(granted ? LogLevel::kInfo : LogLevel::kWarning,
                line.subject + ": asked for " + line.requested + ", got " + line.granted);
    for (const std::string& refusal : line.refusals) {
      console.say(LogLevel::kWarning, "  refused: " + refusal);
    }
  }
}

std::string microseconds(double ns) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f us", ns / 1000.0);
  return text;
}

void tell_statistics(const exec::Application& application, bool all, const Console& console) {
  const double tick_ns = platform::tick_period_ns();
  for (const exec::ThreadStatistics& thread : application.thread_statistics()) {
    if (thread.cycles_run == 0) continue;
    const bool lossy = thread.cycles_skipped > 0 || thread.log_lines_dropped > 0;
    if (!all && !lossy) continue;
    std::string text = "thread " + thread.name + ": " + std::to_string(thread.cycles_run) +
                       " cycles run, " + std::to_string(thread.cycles_skipped) + " skipped";
    const auto in_ns = [&](std::uint64_t ticks) { return static_cast<double>(ticks) * tick_ns; };
    text += "; a cycle took " + microseconds(in_ns(thread.cycle_ticks.percentile(0.5))) +
            " (median), " + microseconds(in_ns(thread.cycle_ticks.most)) + " at most";
    if (thread.latency_ns.count > 0) {
      text += "; woke " + microseconds(static_cast<double>(thread.latency_ns.percentile(0.5))) +
              " late (median), " + microseconds(static_cast<double>(thread.latency_ns.most)) +
              " at most";
    }
    if (thread.log_lines_dropped > 0) {
      text += "; " + std::to_string(thread.log_lines_dropped) + " log lines dropped";
    }
    console.say(lossy ? LogLevel::kWarning : LogLevel::kInfo, text);
  }
}

/// Names every component that did not get to the end in good order.
void tell_casualties(const exec::Application& application, const Console& console) {
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    const component::Component& component = *entry.component;
    if (component.reason().empty()) continue;
    console.say(LogLevel::kWarning, component.name() + " (" +
                                        std::string(component::name_of(component.state())) +
                                        "): " + std::string(component.reason()));
  }
}

bool write_times_file(const std::string& path, const exec::Application& application,
                      const Console& console) {
  const auto written =
      platform::write_file(path, deploy::write_times(deploy::measured_times(application)));
  if (!written) console.say(LogLevel::kError, written.error());
  return written.ok();
}

/// Makes sure that the guard stands in front of the C library, which it can only from the start of
/// a program.
bool stand_behind_guard(const RunArguments& arguments, const Console& console) {
  if (!arguments.guard || rt::loaded_guard() != nullptr) return true;
  if (std::getenv("ARMATURE_GUARD") != nullptr) {
    console.say(
        LogLevel::kError,
        "the guard was asked for but is not there: libarmature_guard.so must lie beside the "
        "other libraries of armature");
    return false;
  }
  const base::Error failure =
      platform::start_again(arguments.command_line, rt::guard_environment(*arguments.guard));
  console.say(LogLevel::kError, failure.message);
  return false;
}

/// True if nothing was seen on a real-time thread that does not belong there.
bool passed_guard(const RunArguments& arguments, const Console& console) {
  if (!arguments.guard) return true;
  const std::uint64_t violations = rt::loaded_guard()->violations();
  console.say(violations == 0 ? LogLevel::kInfo : LogLevel::kError,
              "the real-time guard saw " + std::to_string(violations) + " violations");
  return violations == 0;
}

/// The summary of a run before this one would be taken for this one's if it does not get to its
/// end.
bool make_output_folder(const std::string& folder, const Console& console) {
  if (folder.empty()) return true;
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!failure) {
    std::error_code ignored;  // to write it will fail, too, and be told
    std::filesystem::remove(folder + '/' + report::kSummaryFile, ignored);
    return true;
  }
  console.say(LogLevel::kError, "cannot make the folder '" + folder + "': " + failure.message());
  return false;
}

bool complete(record::TimelineWriter* timeline, const Console& console) {
  if (timeline == nullptr) return true;
  const base::Result<void> closed = timeline->close();
  if (!closed) console.say(LogLevel::kError, closed.error());
  return closed.ok();
}

int exit_code(exec::RunEnd end, const exec::Application& application) {
  if (end == exec::RunEnd::kFaulted || application.faults() > 0) return kFailed;
  const bool by_reaction = end == exec::RunEnd::kStoppedByReaction || application.reactions() > 0;
  return by_reaction ? kStoppedByReaction : kDone;
}

int start(exec::Application& application, const RunArguments& arguments, const Console& console) {
  const base::Diagnostics diagnostics = application.start();
  tell_verdict(application, console);
  console.show(diagnostics);
  if (diagnostics.ok()) return kDone;
  const bool refused = arguments.realtime == exec::RealtimeMode::kRequire && !arguments.simulated &&
                       !application.verdict().complete();
  return refused ? kNoRealtime : kFailed;
}

report::RunFacts facts_of(const RunArguments& arguments) {
  report::RunFacts facts;
  facts.deployment = arguments.load.file;
  facts.simulated = arguments.simulated;
  if (!arguments.simulated) facts.begin = platform::monotonic_now();
  return facts;
}

/// @param companions, network, facts  outlive the application
exec::ApplicationOptions options_of(deploy::Deployment& deployment, const RunArguments& arguments,
                                    const Companions& companions, NetworkOnDemand& network,
                                    const Console& console, report::RunFacts& facts) {
  exec::ApplicationOptions options = std::move(deployment.options);
  options.simulated = arguments.simulated;
  options.realtime = arguments.simulated ? exec::RealtimeMode::kOff : arguments.realtime;
  options.output_folder = arguments.output_folder;
  options.log = [&](const rt::LogRecord& record) {
    note_complaint(facts, record);
    if (!companions.browser) return console.log(record);
    companions.browser->beside([&] { console.log(record); });
  };
  options.black_box.write = [&arguments](const exec::BlackBoxReport& report) {
    return write_black_box(report, arguments.output_folder);
  };
  if (companions.timeline) {
    options.timeline.sink = [&](const exec::TimelineSlice& slice) {
      companions.timeline->add(slice);
    };
  }
  options.ready = release_what_loads;
  if (network.wanted(deployment.document, arguments)) {
    options.attend = [&network] { network.serve(); };
  }
  return options;
}

void let_run(exec::Application& application, const Companions& companions,
             const RunArguments& arguments, const platform::StopSignal& stop,
             base::Diagnostics& mistakes, report::RunFacts& facts) {
  const std::unique_ptr<script::Script>& script = companions.script;
  const std::unique_ptr<script::Browser>& browser = companions.browser;
  const base::Duration duration = arguments.duration.value_or(kUntilStopped);
  const base::Time begin = application.now();
  const base::Time wall_begin = platform::monotonic_now();
  facts.end = script    ? script->run(application, duration, &stop, mistakes)
              : browser ? browser->run(application, duration, &stop)
                        : application.run_for(duration, &stop);
  facts.duration = application.now() - begin;
  facts.wall_time = platform::monotonic_now() - wall_begin;
}

}  // namespace

int run(const RunArguments& arguments, Console& console) {
  if (!stand_behind_guard(arguments, console)) return kFailed;
  NetworkOnDemand network(console);
  deploy::Deployment deployment = load(arguments.load, network);
  console.show(deployment.diagnostics);
  if (!deployment.ok()) return kFailed;

  if (!make_output_folder(arguments.output_folder, console)) return kFailed;

  base::Diagnostics mistakes;
  const Companions companions = load_companions(arguments, mistakes);
  console.show(mistakes);
  if (!mistakes.ok()) return kFailed;

  report::RunFacts facts = facts_of(arguments);
  if (!arguments.simulated) console.set_begin(facts.begin);
  const platform::StopSignal stop;
  exec::Application application(
      std::move(deployment.blueprint),
      options_of(deployment, arguments, companions, network, console, facts));
  if (!network.open(deployment.document, arguments, application)) return kFailed;
  if (const int failed = start(application, arguments, console); failed != kDone) {
    network.leave();
    if (application.hangs()) platform::exit_now(failed);
    return failed;
  }
  let_run(application, companions, arguments, stop, mistakes, facts);
  console.show(application.run_before_stop(facts.end, &stop));
  network.leave();
  console.show(mistakes);
  tell_casualties(application, console);
  base::Diagnostics ended = application.stop();
  deploy::save_properties(deployment.document, application.blueprint(), ended);
  console.show(ended);
  tell_statistics(application, arguments.statistics, console);
  int code = exit_code(facts.end, application);
  if (companions.browser && companions.browser->mistakes() > 0) code = kFailed;
  if (!mistakes.ok() || !ended.ok() || !passed_guard(arguments, console)) code = kFailed;
  if (!complete(companions.timeline.get(), console)) code = kFailed;
  if (!arguments.write_times.empty() &&
      !write_times_file(arguments.write_times, application, console)) {
    code = kFailed;
  }
  facts.exit_code = code;
  if (!arguments.output_folder.empty() &&
      !write_run_summary(arguments.output_folder, facts, application, console)) {
    code = kFailed;
  }
  // A thread that hangs still uses everything: leave without taking it down.
  if (application.hangs()) platform::exit_now(code);
  return code;
}

}  // namespace armature::cli
