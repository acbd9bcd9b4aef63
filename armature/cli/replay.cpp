// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/replay.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/cli/replay_view.hpp"
#include "armature/cli/report.hpp"
#include "armature/component/interface.hpp"
#include "armature/exec/inlets.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/confinement.hpp"
#include "armature/platform/file.hpp"
#include "armature/remote/interface_file.hpp"
#include "armature/replay/acts.hpp"
#include "armature/replay/alone.hpp"
#include "armature/replay/folders.hpp"
#include "armature/replay/outside.hpp"
#include "armature/replay/own_files.hpp"
#include "armature/replay/recorded_component.hpp"
#include "armature/replay/reenactment.hpp"
#include "armature/report/report.hpp"
#include "armature/report/run_folder.hpp"
#include "armature/runner/stages.hpp"

namespace armature::cli {
namespace {

namespace fs = std::filesystem;
using rt::LogLevel;

constexpr const char* kWas = "was";
constexpr const char* kWhatIf = "what-if";

/// One recorded run, and where it is done again.
struct Recorded {
  std::string folder;
  std::string out;  ///< what is made by all of this
  std::string run;  ///< the folder of the run that is done now: `out`, or one in it
  replay::Experiment experiment;
  std::vector<replay::RecordedAct> acts;
};

std::string place_of(const ReplayArguments& arguments) {
  const fs::path given = arguments.out.empty() ? fs::path(arguments.folder) /
                                                     (arguments.changes.any() ? kWhatIf : "replay")
                                               : fs::path(arguments.out);
  return fs::absolute(given).lexically_normal().string();
}

/// All that is read before anything is made.
base::Result<Recorded> read_recorded(const ReplayArguments& arguments) {
  Recorded recorded;
  recorded.folder = fs::absolute(arguments.folder).lexically_normal().string();
  auto experiment = replay::load_experiment(arguments.folder);
  if (!experiment) return base::Error{experiment.error()};
  recorded.experiment = std::move(experiment).value();
  if (!replay::has_recordings(recorded.folder)) {
    return base::Error{"'" + arguments.folder +
                       "' has no recording (*.mcap) to compare with: let a Reporter record what is "
                       "of interest, `file: run.mcap`"};
  }
  if (!recorded.experiment.simulated && arguments.only.empty()) {
    return base::Error{"'" + arguments.folder +
                       "' was recorded in real time, whose hardware is not here: name the "
                       "components that are to run again on what was recorded (--only "
                       "'Controller,PID*')"};
  }
  if (!fs::exists(fs::path(recorded.folder) / replay::kActsFile)) {
    return base::Error{"'" + arguments.folder + "' has no " + replay::kActsFile +
                       ", so nobody knows what was done to it: armature run --out FOLDER of this "
                       "version leaves it in real time, too"};
  }
  auto acts = replay::load_acts(arguments.folder);
  if (!acts) return base::Error{acts.error()};
  recorded.acts = std::move(acts).value();
  if (!recorded.experiment.simulated) {
    // In real time each is done when its time has come, whoever said so.
    for (replay::RecordedAct& one : recorded.acts) one.act.attended = false;
  }
  recorded.out = place_of(arguments);
  recorded.run = arguments.changes.any() ? recorded.out + '/' + kWhatIf : recorded.out;
  return recorded;
}

deploy::DeploymentOptions options_for(const ReplayArguments& arguments) {
  deploy::DeploymentOptions options;
  for (const std::string& folder : arguments.library_folders) {
    options.library_folders.push_back(fs::absolute(folder).string());
  }
  options.read_interface = remote::read_interface;
  if (!arguments.only.empty()) {
    options.make_placeholder = [](const document::Component& /*written*/,
                                  std::unique_ptr<component::Component> prototype)
        -> base::Result<std::unique_ptr<component::Component>> {
      return std::unique_ptr<component::Component>(
          std::make_unique<replay::RecordedComponent>(std::move(prototype)));
    };
  }
  options.make_inlets = [](const std::vector<component::InputPortBase*>& inputs)
      -> base::Result<std::unique_ptr<component::Component>> {
    return std::unique_ptr<component::Component>(
        std::make_unique<exec::Inlets>(document::kNetworkName, inputs));
  };
  return options;
}

/// Recorders write where this run is, whatever folder they had.
void keep_files_in_place(exec::Blueprint& blueprint) {
  for (exec::ComponentEntry& entry : blueprint.components) {
    const component::Interface& interface = component::interface_of(*entry.component);
    if (interface.observers.empty()) continue;
    for (component::PropertyBase* property : interface.properties) {
      if (property->name() != "file" && property->name() != "csv") continue;
      const std::string file = types::to_text(property->type(), property->data());
      const std::string name = fs::path(file).filename().string();
      if (name != file) static_cast<void>(property->set(types::Value::of(name)));
    }
  }
}

/// Nobody speaks to others, or is on a bus of theirs.
bool expect_no_outside(const exec::Blueprint& blueprint, const Console& console) {
  bool inside = true;
  for (const exec::ComponentEntry& entry : blueprint.components) {
    if (const std::string bus = replay::bus_of_another_process(*entry.component); !bus.empty()) {
      console.say(LogLevel::kError, "'" + entry.component->name() + "' is on the bus '" + bus +
                                        "' of another process, which is not what it was: name the "
                                        "components that are to run again on what was recorded "
                                        "(--only)");
      inside = false;
    }
    if (!replay::speaks_to_others(entry)) continue;
    console.say(LogLevel::kError,
                "'" + entry.component->name() + "' (" + entry.model +
                    ") speaks to others outside of this process, which are not what they were: a "
                    "run with it cannot be replayed");
    inside = false;
  }
  return inside;
}

std::vector<std::string> order_of(const exec::Application& application) {
  std::vector<std::string> order;
  for (const exec::Index index : application.plan().start_order) {
    order.push_back(application.blueprint().components[index].component->name());
  }
  return order;
}

std::vector<replay::Flow> flows_of(const exec::Application& application) {
  std::vector<replay::Flow> flows;
  for (const exec::ConnectionPlan& connection : application.plan().connections) {
    flows.push_back({connection.output->owner().name() + '.' + connection.output->name(),
                     connection.input->owner().name() + '.' + connection.input->name()});
  }
  return flows;
}

/// How the run that was done again ended.
struct Done {
  base::Time begin{};                ///< of the run's time
  bool to_the_end = false;           ///< of the recorded run
  base::Time until{};                ///< all before it was done
  bool failed = false;               ///< it could not be done
  std::vector<std::string> order{};  ///< components, writers before readers
  std::vector<replay::Flow> flows{};
  std::vector<replay::ChangedOutcome> changed{};  ///< of acts
};

/// An account of acts may lead on for ever, but nothing is compared behind the last sample. What
/// was done soon after it is done yet, so that a run that was quiet at its end ends as it did.
/// @param last  time in the recordings
base::Time last_of_interest(const Recorded& recorded, bool cut_off, base::Time begin,
                            base::Time last, const Console& console) {
  constexpr base::Duration kQuiet = std::chrono::minutes(1);
  if (cut_off) return last;
  const base::Time bound = base::later(std::max(last, base::Time{}), kQuiet);
  if (recorded.acts.back().act.time >= bound) {
    console.say(LogLevel::kWarning,
                "the recordings end at " + time_in_run(last, begin) +
                    "; what was done later than a minute after that is left out");
  }
  return bound;
}

/// @param alone  of components that run again without the others; may be null
Done do_again(const Recorded& recorded, deploy::Deployment& deployment, const replay::Alone* alone,
              const ReplayArguments& arguments, const Console& console) {
  report::RunFacts facts;
  facts.deployment = recorded.experiment.deployment;
  facts.simulated = true;
  if (alone != nullptr) facts.begin = alone->begin();
  const bool other_turns = arguments.changes.any() || alone != nullptr;
  replay::Reenactment reenactment(alone == nullptr ? recorded.acts : alone->acts_for(recorded.acts),
                                  other_turns ? replay::DueBy::kTime : replay::DueBy::kTurn);
  runner::RunOptions run;
  run.simulated = true;
  run.output_folder = recorded.run;
  exec::ApplicationOptions options = std::move(deployment.options);
  runner::apply(run, options);
  options.log = [&](const rt::LogRecord& record) { note_for_summary(facts, record); };
  options.attend = [&] { reenactment.attend(); };
  exec::Application application(std::move(deployment.blueprint), std::move(options));
  const base::Diagnostics started = application.start();
  if (!started.ok()) {
    console.show(started);
    return {.failed = true};
  }
  const base::Time wall_begin = platform::monotonic_now();
  ReplayView view(application, arguments, console);
  if (!view.ok()) return {.failed = true};
  const bool cut_off = reenactment.cut_off();
  const base::Time begin = alone == nullptr ? base::Time{} : alone->begin();
  const base::Time end =
      alone == nullptr ? replay::end_of_recordings(recorded.folder) : alone->end();
  const base::Time last = last_of_interest(recorded, cut_off, begin, end, console);
  const base::Time asked = arguments.until ? begin + *arguments.until : base::Time::max();
  facts.end = reenactment.run(
      application, std::min(last, asked), [&] { return view.look(); }, alone);
  facts.duration = application.now() - begin;
  facts.wall_time = platform::monotonic_now() - wall_begin;
  Done done{.begin = begin,
            .to_the_end = facts.end != exec::RunEnd::kConditionMet && application.now() < asked &&
                          (cut_off || application.now() < last),
            .until = application.now(),
            .order = order_of(application),
            .flows = flows_of(application)};
  if (done.to_the_end) done.until = base::Time::max();
  done.changed = reenactment.changed();
  console.show(application.stop());
  facts.exit_code = runner::exit_code(facts.end, application);
  done.failed = !write_run_summary(recorded.run, facts, application, console);
  return done;
}

/// @param begin  of the run's time
void tell(const replay::Difference& first, base::Time begin, const Console& console) {
  const std::string component(replay::component_of(first.channel));
  const std::string port =
      first.channel.size() > component.size() ? first.channel.substr(component.size() + 1) : "";
  console.print("first difference at " + time_in_run(first.time, begin) + ", " +
                (component.empty() ? first.channel
                 : port.empty()    ? "component " + component
                                   : "sample " + std::to_string(first.sequence) + " of component " +
                                      component + ", port " + port) +
                ":\n  was " + first.was + "\n  is  " + first.is + "\n");
}

/// When within a cycle something came from another thread is not recorded.
void tell_how_much(const replay::Comparison& found, const Console& console) {
  console.print("  " + std::to_string(found.different) + " of " +
                std::to_string(found.equal + found.different) +
                " samples differ; in real time what another thread wrote may come a cycle earlier "
                "or later than it did\n");
}

std::string name_of(const exec::Act& act) {
  const std::string item =
      act.component + (act.component.empty() || act.item.empty() ? "" : ".") + act.item;
  return std::string(types::name_of(act.kind)) + " of '" + item + "'";
}

/// An act that ended otherwise is a difference, too.
void add_changed(const std::vector<replay::ChangedOutcome>& changed, replay::Comparison& to) {
  for (const replay::ChangedOutcome& each : changed) {
    const std::string what = name_of(each.act) + ": ";
    to.differences.push_back({each.act.component.empty() ? "Modes" : each.act.component,
                              each.act.time, 0, what + each.was, what + each.is});
  }
}

void warn_of_changed(const Done& done, const Console& console) {
  for (const replay::ChangedOutcome& each : done.changed) {
    console.say(LogLevel::kWarning, "at " + time_in_run(each.act.time, done.begin) + ", " +
                                        name_of(each.act) + ": " + each.is +
                                        "; when it was recorded, " + each.was);
  }
}

/// When the run began to end: in real time hooks have times of their own from then on.
base::Time begin_of_the_end(const Recorded& recorded) {
  for (const replay::RecordedAct& one : recorded.acts) {
    if (replay::is_of_the_end(one.act)) return one.act.time;
  }
  return base::Time::max();
}

/// @param alone  of components that ran again without the others; may be null
int compare(const Recorded& recorded, const Done& done, const replay::Alone* alone,
            const Console& console) {
  replay::Losses losses = replay::losses_of(recorded.folder, recorded.experiment);
  if (alone != nullptr && losses.known && !alone->has_gaps()) losses.samples = 0;  // of others
  replay::ComparisonOptions options;
  options.losses = !losses.known || losses.samples > 0;
  options.until = done.until;
  if (alone != nullptr) options.channels = &alone->compared();
  if (!recorded.experiment.simulated) {
    options.times = false;  // a thread wakes up some time after who sent it something
    options.until = std::min(options.until, begin_of_the_end(recorded));
  }
  base::Diagnostics problems;
  replay::Comparison found =
      replay::compare_folders(recorded.folder, recorded.run, done.to_the_end, options, problems);
  if (done.to_the_end && alone == nullptr) {
    replay::compare_summaries(recorded.folder, recorded.run, found);
  }
  add_changed(done.changed, found);
  console.show(problems);
  for (const std::string& channel : found.only_recorded) {
    console.say(LogLevel::kError, "'" + channel +
                                      "' was recorded, but is not recorded now: this "
                                      "deployment has no such port or property");
  }
  if (const auto first = found.first(done.flows, done.order)) {
    tell(*first, done.begin, console);
    if (!recorded.experiment.simulated) tell_how_much(found, console);
    return kDiffers;
  }
  if (!problems.ok() || !found.only_recorded.empty()) return kFailed;
  const std::string amount = std::to_string(found.equal) + " samples of " +
                             std::to_string(found.channels) + " ports and properties";
  if (found.equal == 0) {
    console.say(LogLevel::kError, "nothing could be compared: there is no sample before the end");
    return kFailed;
  }
  if (losses.samples == 0 && found.missing == 0) {
    console.print("equal to the bit: " + amount + "\n");
    return kDone;
  }
  console.print("not all is known: " + amount + " are equal to the bit, but " +
                std::to_string(std::max(losses.samples, found.missing)) +
                " samples are missing in the recording\n");
  return kNotAllCompared;
}

/// What was beside what would have been, on one page.
/// @param alone  of components that ran again without the others; may be null
int show_what_if(const Recorded& recorded, const replay::Changes& changes,
                 const replay::Alone* alone, const Console& console) {
  auto done = replay::copy_run(recorded.folder, recorded.out + '/' + kWas);
  if (done) {
    done = replay::write_changes(recorded.out + '/' + report::kWhatIfFile, changes,
                                 alone == nullptr ? std::set<std::string>() : alone->names());
  }
  if (!done) {
    console.say(LogLevel::kError, done.error());
    return kFailed;
  }
  base::Diagnostics diagnostics;
  const report::Written written = report::write_report({recorded.out, {}}, diagnostics);
  console.show(diagnostics);
  if (!diagnostics.ok()) return kFailed;
  console.print("what was, beside what would have been, is in " + written.page + "\n");
  return kDone;
}

}  // namespace

int replay(const ReplayArguments& arguments, Console& console) {
  auto read = read_recorded(arguments);
  if (!read) {
    console.say(LogLevel::kError, read.error());
    return kFailed;
  }
  Recorded& recorded = read.value();
  const auto place = replay::make_place(recorded.out, recorded.folder);
  if (!place) {
    console.say(LogLevel::kError, place.error());
    return kFailed;
  }
  if (const auto confined = platform::write_only_in(recorded.out); !confined) {
    console.say(LogLevel::kError, confined.error());
    return kFailed;
  }
  platform::FolderLock lock;
  if (!runner::make_output_folder(recorded.run, lock, console)) return kFailed;
  replay::Changes changes = arguments.changes;
  if (!changes.file.empty()) changes.file = fs::absolute(changes.file).string();
  const deploy::DeploymentOptions loading = options_for(arguments);
  std::error_code failure;
  fs::current_path(recorded.experiment.folder, failure);  // relative paths begin there
  if (failure) {
    console.say(LogLevel::kError,
                "the recorded run was in '" + recorded.experiment.folder +
                    "', where its relative paths begin, but: " + failure.message());
    return kFailed;
  }
  deploy::Deployment deployment =
      replay::load_recorded(recorded.experiment, changes, recorded.run, loading);
  console.show(deployment.diagnostics);
  if (!deployment.ok()) return kFailed;
  std::optional<replay::Alone> alone;
  if (arguments.only.empty()) {
    if (!expect_no_outside(deployment.blueprint, console)) return kFailed;
  } else {
    base::Diagnostics isolated;
    alone = replay::Alone::of(arguments.only, recorded.folder, !recorded.experiment.simulated,
                              deployment, isolated);
    console.show(isolated);
    if (!isolated.ok()) return kFailed;
  }
  const replay::Alone* const those_alone = alone ? &*alone : nullptr;
  keep_files_in_place(deployment.blueprint);
  base::Diagnostics copied;
  replay::work_on_copies(deployment.blueprint, recorded.experiment, recorded.run, copied);
  console.show(copied);
  if (!copied.ok()) return kFailed;
  const Done done = do_again(recorded, deployment, those_alone, arguments, console);
  if (done.failed) return kFailed;
  if (changes.any()) warn_of_changed(done, console);
  return changes.any() ? show_what_if(recorded, changes, those_alone, console)
                       : compare(recorded, done, those_alone, console);
}

}  // namespace armature::cli
