// SPDX-License-Identifier: Apache-2.0
#include "armature/report/run_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "armature/platform/file.hpp"
#include "armature/record/mcap_reader.hpp"
#include "armature/report/internal/json.hpp"
#include "armature/report/run_summary.hpp"

namespace armature::report {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestText = 256u << 20;

/// The recordings and folders in `folder`, each by their names.
struct Content {
  std::vector<std::string> recordings;
  std::vector<std::string> black_boxes;
  std::vector<std::string> folders;
};

bool is_black_box(const fs::path& file) {
  return file.filename().string().starts_with("blackbox-");
}

Content content_of(const fs::path& folder, base::Diagnostics& diagnostics) {
  Content content;
  std::error_code failure;
  for (fs::directory_iterator each(folder, failure), end; !failure && each != end;
       each.increment(failure)) {
    std::error_code ignored;
    if (each->is_directory(ignored)) content.folders.push_back(each->path().string());
    if (each->path().extension() != ".mcap") continue;
    (is_black_box(each->path()) ? content.black_boxes : content.recordings)
        .push_back(each->path().string());
  }
  if (failure) {
    diagnostics.error({}, "cannot read the folder '" + folder.string() + "': " + failure.message());
  }
  // Of a run that recorded nothing else they show what led to its faults.
  if (content.recordings.empty()) content.recordings.swap(content.black_boxes);
  std::sort(content.recordings.begin(), content.recordings.end(), before_by_number);
  std::sort(content.folders.begin(), content.folders.end(), before_by_number);
  return content;
}

/// The text of a file of JSON, if it is there; empty after an error.
std::string load_json(const fs::path& path, base::Diagnostics& diagnostics) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return {};
  auto text = platform::read_file(path.string(), kLargestText);
  if (!text) {
    diagnostics.error({}, text.error());
    return {};
  }
  try {
    if (nlohmann::json::parse(text.value()).is_object()) return std::move(text).value();
    diagnostics.error({path.string(), 1, 1}, "expected a JSON object");
  } catch (const nlohmann::json::exception& wrong) {
    diagnostics.error({path.string(), 0, 0}, std::string("expected JSON: ") + wrong.what());
  }
  return {};
}

/// Simulated time begins at 0, but that of a replay of a run in real time.
/// @return when the recording's time 0 was on the clock
double begin_at_zero_of_run(Run& run) {
  const Json summary = Json::parse(run.summary, nullptr, false);
  if (text_in(summary, "time") != "simulated") return begin_at_zero(run.signals);
  const auto begin = summary.find("begin_s");
  if (begin == summary.end() || !begin->is_number()) return 0.0;
  begin_at(begin->get<double>(), run.signals);
  return begin->get<double>();
}

/// The limits that the summary knows, as if they had been recorded; what was recorded stands.
void add_limits(const std::string& summary, Signals& signals) {
  const auto run = nlohmann::json::parse(summary, nullptr, false);
  if (!run.is_object() || !run.contains("limits") || !run["limits"].is_object()) return;
  const auto add = [&](const std::string& name, const nlohmann::json& value) {
    if (!value.is_number() || signals.find(name) != nullptr) return;
    signals.all.push_back({name, {}, {}, {0.0}, {value.get<double>()}});
  };
  for (const auto& [name, value] : run["limits"].items()) {
    add(name, value);
    if (!value.is_array()) continue;
    for (std::size_t i = 0; i < value.size(); ++i) {
      add(name + '[' + std::to_string(i) + ']', value[i]);
    }
  }
}

/// @param has_figures  another program found figures: positions are not all that there is to show
void load_recording(const std::string& path, bool has_figures, Run& run,
                    base::Diagnostics& diagnostics) {
  run.recording = path;
  const auto loaded = record::load_mcap(path, record::Unclosed::kReadToLastChunk);
  if (!loaded) {
    diagnostics.error({}, loaded.error());
    return;
  }
  run.cut_off = !loaded.value().closed;
  if (run.cut_off) {
    diagnostics.warning(
        {path, 0, 0},
        "the recording has no end, as after a crash: the report shows its intact part, " +
            std::to_string(loaded.value().samples.size()) + " samples");
  }
  run.signals = signals_of(loaded.value());
  const double zero_s = begin_at_zero_of_run(run);
  add_limits(run.summary, run.signals);
  run.joints = joints_of(run.signals);
  run.velocities = velocities_of(run.signals, run.joints);
  run.efforts = efforts_of(run.signals);
  run.moments = moments_of(run.summary, run.signals, zero_s);
  if (run.joints.empty() && !has_figures) {
    diagnostics.warning({path, 0, 0},
                        std::string("no positions to show; looked for ") + what_is_looked_for(),
                        "record them: name them in the Reporter's property `what`");
  }
}

void load_trace(const fs::path& path, const Phases& phases, Run& run,
                base::Diagnostics& diagnostics) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return;
  const auto text = platform::read_file(path.string(), kLargestText);
  if (!text) return diagnostics.error({}, text.error());
  const auto trace = parse_trace(text.value(), path.string());
  if (!trace) return diagnostics.error({}, trace.error());
  Timeline timeline = find_timeline(trace.value());
  if (timeline.lanes.empty()) return;
  run.timeline = std::move(timeline);
  for (const Phase& phase : phases.all) {
    run.phase_computing_us.push_back(computing_of(phase, trace.value()));
  }
}

std::string name_of(const fs::path& folder) {
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(folder, ignored);
  return whole.filename().empty() ? folder.string() : whole.filename().string();
}

std::optional<Run> load_run(const fs::path& folder, const Content& content, const Runs& runs,
                            base::Diagnostics& diagnostics) {
  Run run;
  run.name = name_of(folder);
  run.summary = load_json(folder / kSummaryFile, diagnostics);
  if (content.recordings.empty() && run.summary.empty()) return std::nullopt;
  if (content.recordings.size() > 1) {
    diagnostics.warning(
        {content.recordings[1], 0, 0},
        "a second recording of one run; the report shows the first, " + content.recordings[0],
        "give each run a folder of its own");
  }
  if (!content.recordings.empty()) {
    load_recording(content.recordings[0], !runs.figures_json.empty(), run, diagnostics);
  }
  load_trace(folder / kTraceFile, runs.phases, run, diagnostics);
  return run;
}

}  // namespace

Runs load_runs(const std::string& folder, base::Diagnostics& diagnostics) {
  Runs runs;
  runs.name = name_of(folder);
  const Content content = content_of(folder, diagnostics);
  runs.figures_json = load_json(fs::path(folder) / kFiguresFile, diagnostics);
  runs.what_if_json = load_json(fs::path(folder) / kWhatIfFile, diagnostics);
  const fs::path phases = fs::path(folder) / kPhasesFile;
  runs.phases = parse_phases(load_json(phases, diagnostics), phases.string(), diagnostics);
  const auto load = [&](const fs::path& from, const Content& has) {
    auto run = load_run(from, has, runs, diagnostics);
    if (run) runs.runs.push_back(std::move(*run));
  };
  load(folder, content);
  for (const std::string& inner : content.folders) load(inner, content_of(inner, diagnostics));
  runs.cycle_json = load_json(fs::path(folder) / kCycleFile, diagnostics);
  const fs::path goals = fs::path(folder) / kGoalsFile;
  runs.goals = parse_goals(load_json(goals, diagnostics), goals.string(), diagnostics);
  if (runs.runs.empty() && diagnostics.ok()) {
    diagnostics.error({},
                      "no run in '" + folder + "': expected a recording (*.mcap) or " +
                          kSummaryFile + " in it, or in folders in it",
                      "`armature run FILE --out FOLDER` leaves one");
  }
  return runs;
}

}  // namespace armature::report
