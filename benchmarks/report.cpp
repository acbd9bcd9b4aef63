// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/report.hpp"

#include <cstdio>
#include <optional>
#include <thread>

#include <nlohmann/json.hpp>

#include "armature/platform/file.hpp"
#include "armature/platform/process.hpp"

namespace armature::benchmarks {
namespace {

using Run = benchmark::BenchmarkReporter::Run;

std::optional<double> counter(const Run& run, const char* name) {
  const auto found = run.counters.find(name);
  if (found == run.counters.end()) return std::nullopt;
  return found->second.value;
}

std::optional<double> ratio(const Run& run) {
  const std::optional<double> reference = counter(run, "reference");
  if (!reference || *reference == 0.0) return std::nullopt;
  return *counter(run, "value") / *reference;
}

std::string text(const char* format, std::optional<double> number) {
  if (!number) return "";
  char text[32];
  std::snprintf(text, sizeof text, format, *number);
  return text;
}

/// `<= 12  met`, empty if nothing is to be reached.
std::string verdict(const Run& run) {
  std::optional<double> found = ratio(run);
  std::optional<double> limit = counter(run, "ratio_bound");
  if (!limit) {
    found = counter(run, "value");
    limit = counter(run, "value_bound");
  }
  if (!limit || !found) return "";
  return text("<= %g", limit) + (*found <= *limit ? "  met" : "  MISSED");
}

std::string model_of_cpu() {
  const base::Result<std::string> info = platform::read_file("/proc/cpuinfo");
  if (!info) return "unknown CPU";
  const std::string key = "model name\t: ";
  const std::size_t at = info.value().find(key);
  if (at == std::string::npos) return "unknown CPU";
  const std::size_t begin = at + key.size();
  return info.value().substr(begin, info.value().find('\n', begin) - begin);
}

nlohmann::json number(std::optional<double> value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

}  // namespace

bool Report::ReportContext(const Context&) {
  std::printf("%s, %u CPUs, %s, GCC %s\n\n", model_of_cpu().c_str(),
              std::thread::hardware_concurrency(), platform::kernel_version().c_str(), __VERSION__);
  std::printf("%-34s %12s %-6s %12s %8s %11s  %s\n", "entry", "value", "unit", "reference", "ratio",
              "allocations", "to reach");
  return true;
}

void Report::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) report(run);
}

void Report::report(const Run& run) {
  const char* const name = run.run_name.function_name.c_str();
  if (run.error_occurred) {
    ++failures_;
    std::printf("%-34s FAILED: %s\n", name, run.error_message.c_str());
    return;
  }
  entries_.push_back(run);
  std::printf("%-34s %12s %-6s %12s %8s %11s  %s\n", name,
              text("%.4g", counter(run, "value")).c_str(), run.report_label.c_str(),
              text("%.4g", counter(run, "reference")).c_str(), text("%.2f", ratio(run)).c_str(),
              text("%.3g", counter(run, "allocations")).c_str(), verdict(run).c_str());
  std::fflush(stdout);
}

bool Report::write_json(const std::string& path) const {
  auto all = nlohmann::ordered_json::array();
  for (const Run& run : entries_) {
    all.push_back(nlohmann::ordered_json{{"name", run.run_name.function_name},
                                         {"value", number(counter(run, "value"))},
                                         {"unit", run.report_label},
                                         {"reference", number(counter(run, "reference"))},
                                         {"ratio", number(ratio(run))},
                                         {"allocations", number(counter(run, "allocations"))}});
  }
  const base::Result<void> written = platform::write_file(path, all.dump(2) + "\n");
  if (!written) std::fprintf(stderr, "armature_bench: error: %s\n", written.error().c_str());
  return written.ok();
}

}  // namespace armature::benchmarks
