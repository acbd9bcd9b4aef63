// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/folders.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "armature/base/seconds.hpp"
#include "armature/exec/run_end.hpp"
#include "armature/platform/confinement.hpp"
#include "armature/platform/file.hpp"
#include "armature/record/mcap_reader.hpp"

namespace armature::replay {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlackBox = "blackbox-";
constexpr const char* kSummary = "run.json";

std::vector<fs::path> recordings_in(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".mcap") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// Of a black box the component without the time on the wall: `blackbox-AIC1`.
std::string plain_name(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with(kBlackBox)) return name;
  constexpr std::size_t kTime = sizeof "-2026-11-22T10-20-30" - 1;
  const std::size_t hour = name.rfind('T');
  constexpr std::size_t kDate = sizeof "-2026-11-22" - 1;
  const bool timed =
      hour != std::string::npos && hour > kDate && name.size() >= hour - kDate + kTime;
  return timed ? name.substr(0, hour - kDate) : name;
}

/// Files by their plain names, those of one name in the order in which they were written.
std::map<std::string, std::vector<fs::path>> by_name(const std::string& folder) {
  std::map<std::string, std::vector<fs::path>> named;
  for (const fs::path& file : recordings_in(folder)) named[plain_name(file)].push_back(file);
  return named;
}

std::vector<std::string> recorders_in(const std::string& outline) {
  std::vector<std::string> names;
  std::string_view rest = outline;
  constexpr std::string_view kComponent = "component ";
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    const std::size_t model = line.find(" model Reporter ");
    if (!line.starts_with(kComponent) || model == std::string_view::npos) continue;
    names.emplace_back(line.substr(kComponent.size(), model - kComponent.size()));
  }
  return names;
}

class FolderComparison {
 public:
  FolderComparison(bool complete, const ComparisonOptions& options, base::Diagnostics& diagnostics)
      : complete_(complete), options_(options), diagnostics_(diagnostics) {}

  void compare_all(const std::string& was, const std::string& is) {
    const auto recorded = by_name(was);
    const auto replayed = by_name(is);
    for (const auto& [name, files] : recorded) {
      if (!is_of_interest(name, replayed)) continue;
      const auto others = replayed.find(name);
      const std::size_t count = others == replayed.end() ? 0 : others->second.size();
      for (std::size_t i = 0; i < files.size(); ++i) {
        if (i < count) {
          compare_files(files[i], others->second[i]);
        } else if (complete_) {
          lacks(files[i], "the replay has none", name);
        }
      }
    }
    if (!complete_ || options_.channels != nullptr) return;
    for (const auto& [name, files] : replayed) {
      const auto others = recorded.find(name);
      const std::size_t count = others == recorded.end() ? 0 : others->second.size();
      if (files.size() > count) lacks(files[count], "the recorded run had none", name);
    }
  }

  Comparison take() { return std::move(found_); }

 private:
  using Files = std::map<std::string, std::vector<fs::path>>;

  /// Of some components there is neither a black box nor what a recorder had of others.
  bool is_of_interest(const std::string& name, const Files& replayed) const {
    return options_.channels == nullptr ||
           (!name.starts_with(kBlackBox) && replayed.contains(name));
  }

  void compare_files(const fs::path& was, const fs::path& is) {
    const auto before = record::load_mcap(was.string(), record::Unclosed::kReadToLastChunk);
    const auto after = record::load_mcap(is.string(), record::Unclosed::kReadToLastChunk);
    if (!before) diagnostics_.error({}, before.error());
    if (!after) diagnostics_.error({}, after.error());
    if (!before || !after) return;
    if (!before.value().closed) {
      diagnostics_.warning({},
                           "'" + was.string() + "' was cut off; what is whole of it is compared");
    }
    found_.add(compare(before.value(), after.value(), options_));
  }

  /// A black box that only one of them has is a difference: a fault.
  void lacks(const fs::path& file, const std::string& what, const std::string& name) {
    if (!std::string_view(name).starts_with(kBlackBox)) {
      diagnostics_.error({}, "'" + file.string() + "' has no counterpart: " + what);
      return;
    }
    const auto recording = record::load_mcap(file.string(), record::Unclosed::kReadToLastChunk);
    base::Time time{};
    if (recording && !recording.value().samples.empty())
      time = recording.value().samples.back().time;
    if (time >= options_.until) return;
    Difference fault{name.substr(kBlackBox.size()), time, 0, "a black box of a fault", what};
    if (what.find("recorded") != std::string::npos) std::swap(fault.was, fault.is);
    Comparison only;
    only.differences.push_back(std::move(fault));
    found_.add(std::move(only));
  }

  const bool complete_;
  const ComparisonOptions& options_;
  base::Diagnostics& diagnostics_;
  Comparison found_;
};

/// What a run has left at its end; no object if it has left none.
nlohmann::json summary_in(const std::string& folder) {
  const auto text = platform::read_file(folder + '/' + kSummary);
  return text ? nlohmann::json::parse(text.value(), nullptr, false) : nlohmann::json();
}

/// A run ends by a fault, by a reaction, or in order: a replay has neither the time limit of the
/// run nor its signals.
std::string summary_text(const nlohmann::json& summary, const char* what) {
  const nlohmann::json value = summary.value(what, nlohmann::json());
  if (!value.is_string()) return value.dump();
  const auto end = types::value_named<exec::RunEnd>(value.get<std::string>());
  const bool of_itself = end == exec::RunEnd::kFaulted || end == exec::RunEnd::kStoppedByReaction;
  return of_itself ? value.get<std::string>() : "in order";
}

/// When the first of the two ended.
base::Time end_in(const nlohmann::json& one, const nlohmann::json& other) {
  constexpr double kLongestRun = 1e9;  // seconds
  double end_s = kLongestRun;
  for (const nlohmann::json* const each : {&one, &other}) {
    const nlohmann::json duration = each->value("duration_s", nlohmann::json());
    if (duration.is_number()) end_s = std::clamp(duration.get<double>(), 0.0, end_s);
  }
  return base::Time{} + base::from_seconds(end_s);
}

}  // namespace

std::vector<std::unique_ptr<record::McapRecording>> load_recordings(
    const std::string& folder, const std::set<std::string>& names, base::Diagnostics& diagnostics) {
  std::vector<std::unique_ptr<record::McapRecording>> all;
  for (const fs::path& file : recordings_in(folder)) {
    if (!names.contains(file.filename().string())) continue;
    auto recording = record::load_mcap(file.string(), record::Unclosed::kReadToLastChunk);
    if (recording) {
      all.push_back(std::make_unique<record::McapRecording>(std::move(recording).value()));
    } else {
      diagnostics.error({}, recording.error());
    }
  }
  return all;
}

bool has_recordings(const std::string& folder) { return !recordings_in(folder).empty(); }

Losses losses_of(const std::string& folder, const Experiment& experiment) {
  const nlohmann::json summary = summary_in(folder);
  if (!summary.is_object() || !summary.contains("counters")) return {};
  const auto& counters = summary["counters"];
  if (!counters.is_object()) return {};
  Losses losses{true, 0};
  for (const std::string& recorder : recorders_in(experiment.outline)) {
    for (const char* const counter : {".dropped", ".not_written"}) {
      const auto found = counters.find(recorder + counter);
      if (found == counters.end() || !found->contains("value")) continue;
      const auto& value = (*found)["value"];
      if (!value.is_number_unsigned()) return {};  // nobody knows
      losses.samples += value.get<std::uint64_t>();
    }
  }
  return losses;
}

Comparison compare_folders(const std::string& was, const std::string& is, bool complete,
                           const ComparisonOptions& options, base::Diagnostics& diagnostics) {
  FolderComparison comparison(complete, options, diagnostics);
  comparison.compare_all(was, is);
  return comparison.take();
}

void compare_summaries(const std::string& was, const std::string& is, Comparison& to) {
  const nlohmann::json before = summary_in(was);
  const nlohmann::json after = summary_in(is);
  if (!before.is_object() || !after.is_object()) return;
  for (const char* const what : {"end", "faults", "reactions"}) {
    const std::string then = summary_text(before, what);
    const std::string now = summary_text(after, what);
    if (then == now) continue;
    to.differences.push_back({"the run", end_in(before, after), 0, std::string(what) + ": " + then,
                              std::string(what) + ": " + now});
    return;
  }
}

base::Time end_of_recordings(const std::string& folder) {
  base::Time end = base::Time::min();
  for (const fs::path& file : recordings_in(folder)) {
    const auto recording = record::load_mcap(file.string(), record::Unclosed::kReadToLastChunk);
    if (!recording) continue;
    for (const auto& sample : recording.value().samples) end = std::max(end, sample.time);
  }
  return end;
}

base::Result<void> make_place(const std::string& folder, const std::string& run) {
  std::error_code failure;
  if (platform::lies_in(run, folder)) {
    return base::Error{"'" + folder +
                       "' has the recorded run in it, and would be emptied: name an "
                       "empty or a new folder with -o"};
  }
  fs::create_directories(folder, failure);
  if (failure) return base::Error{"cannot make the folder '" + folder + "': " + failure.message()};
  const fs::path mark = fs::path(folder) / kReplayFile;
  if (!fs::exists(mark, failure) && !fs::is_empty(folder, failure)) {
    return base::Error{
        "'" + folder +
        "' has files that no replay has made: name an empty or a new folder with -o"};
  }
  for (const auto& entry : fs::directory_iterator(folder, failure)) {
    if (entry.path().filename() != kReplayFile) fs::remove_all(entry.path(), failure);
  }
  return platform::write_file(mark.string(), "{}\n");
}

base::Result<void> copy_run(const std::string& from, const std::string& to) {
  std::error_code failure;
  fs::create_directories(to, failure);
  std::vector<fs::path> files = recordings_in(from);
  std::erase_if(
      files, [](const fs::path& file) { return file.filename().string().starts_with(kBlackBox); });
  files.push_back(fs::path(from) / kSummary);
  for (const fs::path& file : files) {
    if (!fs::exists(file, failure)) continue;
    fs::copy_file(file, fs::path(to) / file.filename(), fs::copy_options::overwrite_existing,
                  failure);
    if (failure) {
      return base::Error{"cannot copy '" + file.string() + "' to '" + to +
                         "': " + failure.message()};
    }
  }
  return {};
}

}  // namespace armature::replay
