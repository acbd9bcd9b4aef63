// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/run.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "armature/analysis/schedule.hpp"
#include "armature/base/hash64.hpp"
#include "armature/base/joined.hpp"
#include "armature/cli/companions.hpp"
#include "armature/cli/experiment.hpp"
#include "armature/cli/load.hpp"
#include "armature/cli/network.hpp"
#include "armature/cli/release_code.hpp"
#include "armature/cli/report.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/observing/observer.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/deploy/saved_properties.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/file.hpp"
#include "armature/platform/printer.hpp"
#include "armature/platform/process.hpp"
#include "armature/platform/sockets/service_manager.hpp"
#include "armature/platform/stop_priority.hpp"
#include "armature/platform/stop_signal.hpp"
#include "armature/runner/burial.hpp"
#include "armature/runner/run_texts.hpp"
#include "armature/runner/stages.hpp"

namespace armature::cli {
namespace {

using rt::LogLevel;

bool write_times_file(const std::string& path, const exec::Application& application,
                      const Console& console) {
  const auto written =
      platform::write_file(path, analysis::write_times(analysis::measured_times(application)));
  if (!written) console.say(LogLevel::kError, written.error());
  return written.ok();
}

/// Makes sure that the guard stands in front of the C library, which it can only from the start of
/// a program.
bool stand_behind_guard(const RunArguments& arguments, const Console& console) {
  if (!arguments.guard || rt::loaded_guard() != nullptr) return true;
  if (std::getenv("ARMATURE_GUARD") != nullptr) {
    console.say(LogLevel::kError,
                "--guard needs libarmature_guard.so beside the other libraries of armature, and it "
                "is missing: install it there");
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
void remove_old_summary(const std::string& folder) {
  if (folder.empty()) return;
  std::error_code ignored;  // to write it will fail, too, and be told
  std::filesystem::remove(folder + '/' + report::kSummaryFile, ignored);
}

/// What is written at the end only would be missed when it is too late.
bool can_write_at_the_end(const RunArguments& arguments, const Console& console) {
  if (arguments.write_times.empty()) return true;
  const auto writable = platform::expect_writable(arguments.write_times);
  if (!writable) console.say(LogLevel::kError, writable.error());
  if (writable && platform::is_same_file(arguments.write_times, arguments.load.file)) {
    console.say(LogLevel::kError, "'" + arguments.write_times +
                                      "' is the deployment: name another file for the times");
    return false;
  }
  return writable.ok();
}

bool complete(record::TimelineWriter* timeline, const Console& console) {
  if (timeline == nullptr) return true;
  const base::Result<void> closed = timeline->close();
  if (!closed) console.say(LogLevel::kError, closed.error());
  return closed.ok();
}

report::RunFacts facts_of(const RunArguments& arguments) {
  report::RunFacts facts;
  facts.deployment = arguments.load.file;
  facts.simulated = arguments.simulated;
  if (!arguments.simulated) facts.begin = platform::monotonic_now();
  return facts;
}

/// For recordings: by which deployment, program and machine they were made.
std::map<std::string, std::string> about_of(const RunArguments& arguments) {
  constexpr std::size_t kLargestDeployment = 16 << 20;
  std::map<std::string, std::string> about{{"deployment", arguments.load.file},
                                           {"version", ARMATURE_VERSION},
                                           {"machine", platform::machine_text()},
                                           {"simulated", arguments.simulated ? "true" : "false"}};
  if (const auto text = platform::read_file(arguments.load.file, kLargestDeployment)) {
    about["deployment_fnv1a_64"] = base::hash64_text(text.value());
  }
  if (!arguments.load.overrides.empty()) {
    about["set"] = base::joined(arguments.load.overrides, "\n");
  }
  return about;
}

void tell_recorders(const exec::Blueprint& blueprint, const RunArguments& arguments) {
  const std::map<std::string, std::string> about = about_of(arguments);
  for (const exec::ComponentEntry& entry : blueprint.components) {
    for (component::Observer* const observer :
         component::interface_of(*entry.component).observers) {
      observer->set_about(about);
    }
  }
}

/// @param companions, network, service, experiment, facts  outlive the application
exec::ApplicationOptions options_of(deploy::Deployment& deployment, const RunArguments& arguments,
                                    const Companions& companions, NetworkOnDemand& network,
                                    platform::ServiceManager& service, const Console& console,
                                    ExperimentRecord& experiment, report::RunFacts& facts) {
  exec::ApplicationOptions options = std::move(deployment.options);
  runner::apply(arguments, options);
  options.log = [&](const rt::LogRecord& record) {
    note_for_summary(facts, record);
    if (!companions.browser) return console.log(record);
    companions.browser->beside([&] { console.log(record); });
  };
  if (companions.timeline) {
    options.timeline.sink = [&](const exec::TimelineSlice& slice) {
      companions.timeline->add(slice);
    };
  }
  if (experiment.keeps_acts()) {
    options.acts = [&experiment](const exec::Act& act) { experiment.add(act); };
  }
  const bool networked = network.wanted(deployment.document, arguments);
  const bool scripted = companions.script != nullptr;
  const bool browsed = companions.browser != nullptr;
  options.ready = [=] { release_what_is_not_needed(networked, browsed, scripted); };
  if (networked || service.wants_signs_of_life()) {
    options.attend = [&network, &service, networked] {
      service.is_alive(platform::monotonic_now());
      if (networked) network.serve();
    };
  }
  return options;
}

void let_run(exec::Application& application, const Companions& companions,
             const RunArguments& arguments, const platform::StopSignal& stop,
             base::Diagnostics& mistakes, report::RunFacts& facts) {
  const std::unique_ptr<lua::Script>& script = companions.script;
  const std::unique_ptr<browser::Browser>& browser = companions.browser;
  const base::Duration duration = arguments.longest();
  const base::Time begin = application.now();
  const base::Time wall_begin = platform::monotonic_now();
  facts.end = script    ? script->run(application, duration, &stop, mistakes)
              : browser ? browser->run(application, duration, &stop)
                        : application.run_for(duration, &stop);
  facts.duration = application.now() - begin;
  facts.wall_time = platform::monotonic_now() - wall_begin;
}

/// Lets go of nothing in silence: what is held is held until the operator has answered.
/// @param mistaken  its script failed, or lines that nobody saw failing
base::Diagnostics leave(exec::Application& application, const Companions& companions,
                        const platform::StopSignal& stop, exec::RunEnd end, bool mistaken) {
  const auto how = mistaken ? exec::Leave::kAfterMistake : exec::Leave::kInOrder;
  base::Diagnostics problems = application.run_before_stop(end, &stop, how);
  const std::unique_ptr<browser::Browser>& browser = companions.browser;
  std::function<bool(base::Duration)> converse;
  if (browser && !browser->at_end()) {
    converse = [&](base::Duration limit) {
      const base::Time until = base::later(application.now(), limit);
      while (true) {
        const exec::RunEnd said = browser->run(application, until - application.now(), &stop);
        const bool quits =
            said == exec::RunEnd::kStopRequested && !stop.received() && !browser->at_end();
        // Lines of a pipe were written before anybody was asked: their `quit` is no answer.
        if (!quits || browser->at_terminal()) return quits;
      }
    };
  }
  const base::Diagnostics let_go = application.hold_until_told(&stop, converse);
  for (const base::Diagnostic& one : let_go.all()) problems.add(one);
  return problems;
}

/// What a run has beside its deployment.
struct Aboard {
  const RunArguments& arguments;
  const Companions& companions;
  NetworkOnDemand& network;
  ExperimentRecord& experiment;
  base::Diagnostics& mistakes;  ///< of scripts
  Console& console;
};

/// Stops everything, says how it went and writes what is written at the end.
/// @param left  what went wrong on the way to the stop
int conclude(exec::Application& application, const document::Document& document,
             const Aboard& aboard, const base::Diagnostics& left, report::RunFacts& facts) {
  const auto& [arguments, companions, network, experiment, mistakes, console] = aboard;
  console.show(mistakes);
  runner::tell_casualties(application, console);
  base::Diagnostics ended = application.stop();
  deploy::save_properties(document, application.blueprint(), ended);
  console.show(ended);
  runner::tell_statistics(application, arguments.statistics, console);
  runner::tell_lost_lines(console);
  int code = runner::exit_code(facts.end, application);
  if (companions.browser && companions.browser->mistakes() > 0) code = kFailed;
  if (!mistakes.ok() || !left.ok() || !ended.ok() || !passed_guard(arguments, console))
    code = kFailed;
  if (!complete(companions.timeline.get(), console)) code = kFailed;
  if (!experiment.end(console)) code = kFailed;
  if (!arguments.write_times.empty() &&
      !write_times_file(arguments.write_times, application, console)) {
    code = kFailed;
  }
  facts.exit_code = code;
  facts.lines_lost = platform::lost_lines();
  if (!arguments.output_folder.empty() &&
      !write_run_summary(arguments.output_folder, facts, application, console)) {
    code = kFailed;
  }
  return code;
}

/// The files of components that keep something say before the start that a run has begun; if the
/// start is refused they say again what they said.
/// @return kDone, or what `start` returned
int start_keeping(exec::Application& application, const document::Document& document,
                  const RunArguments& arguments, const base::Diagnostics& told,
                  const Console& console) {
  base::Diagnostics kept;
  deploy::begin_kept(document, application.blueprint(), kept);
  const int started = kept.ok() ? runner::start(application, arguments, told, console) : kFailed;
  if (started != kDone) deploy::give_back_kept(document, application.blueprint(), kept);
  console.show(kept);
  return started;
}

/// From the start of a deployment that passed its check to the end of its run.
int run_checked(deploy::Deployment& deployment, const Aboard& aboard) {
  const auto& [arguments, companions, network, experiment, mistakes, console] = aboard;
  // In simulated time nothing moves while somebody is waited for.
  std::optional<platform::Printer> printer;
  if (!arguments.simulated) printer.emplace();
  runner::tell_grants(deployment.options.grants, console);
  tell_recorders(deployment.blueprint, arguments);
  report::RunFacts facts = facts_of(arguments);
  if (!arguments.simulated) console.set_begin(facts.begin);
  if (!experiment.begin(deployment, arguments, console)) return kFailed;
  const platform::StopSignal stop;
  platform::ServiceManager service;
  exec::Application application(
      std::move(deployment.blueprint),
      options_of(deployment, arguments, companions, network, service, console, experiment, facts));
  const runner::Burial burial(application, console);
  {
    // What peers ask for may be an E-stop.
    std::optional<platform::Promptness> of_its_threads;
    if (arguments.urges()) of_its_threads.emplace();
    if (!network.open(deployment.document, arguments, application)) return kFailed;
  }
  if (const int failed = start_keeping(application, deployment.document, arguments,
                                       deployment.diagnostics, console);
      failed != kDone) {
    network.leave();
    if (application.hangs()) runner::leave_now(failed, printer);
    return failed;
  }
  const runner::Urgency urgency(arguments, stop);
  service.ready();
  let_run(application, companions, arguments, stop, mistakes, facts);
  service.is_stopping();
  const bool mistaken =
      !mistakes.ok() || (companions.browser && companions.browser->mistakes() > 0);
  const base::Diagnostics left = leave(application, companions, stop, facts.end, mistaken);
  console.show(left);
  network.leave();
  const int code = conclude(application, deployment.document, aboard, left, facts);
  if (application.hangs()) runner::leave_now(code, printer);
  return code;
}

bool has_prompt(const deploy::Deployment& deployment) {
  return std::ranges::any_of(deployment.document.components, [](const auto& component) {
    return component.model == "TaskBrowser";
  });
}

}  // namespace

int run(const RunArguments& arguments, Console& console) {
  if (!stand_behind_guard(arguments, console)) return kFailed;
  NetworkOnDemand network(console, arguments.policy, arguments.tokens);
  ExperimentRecord experiment;
  deploy::Deployment deployment = load(arguments.load, network, {}, experiment.seen());
  console.show(deployment.diagnostics);
  if (!deployment.ok()) return kFailed;

  if (!can_write_at_the_end(arguments, console)) return kFailed;
  platform::FolderLock lock;
  if (!runner::make_output_folder(arguments.output_folder, lock, console)) return kFailed;
  remove_old_summary(arguments.output_folder);

  base::Diagnostics mistakes;
  const Companions companions = make_companions(arguments, has_prompt(deployment), mistakes);
  console.show(mistakes);
  if (!mistakes.ok()) return kFailed;
  return run_checked(deployment, {arguments, companions, network, experiment, mistakes, console});
}

}  // namespace armature::cli
