// SPDX-License-Identifier: Apache-2.0
// Measures armature beside what it is to be compared with; README.md says what each entry is.
#include <cstdio>
#include <regex>
#include <string>

#include <CLI/CLI.hpp>

#include "benchmarks/report.hpp"
#include "benchmarks/suite.hpp"

namespace {

/// Latency is measured while the heap is small: its memory is locked.
void add_all(const armature::benchmarks::Suite& suite) {
  using namespace armature::benchmarks;
  add_cycles(suite);
  add_timelines(suite);
  add_watches(suite);
  add_threaded_cycles(suite);
  add_models(suite);
  add_online_trajectories(suite);
  add_cartesian(suite);
  add_drives(suite);
  add_vision(suite);
  add_calls(suite);
  add_event_commands(suite);
  add_crossings(suite);
  add_latency(suite);
  add_queries(suite);
  add_deployments(suite);
  add_remote(suite);
  add_fan_outs(suite);
  add_footprints(suite);
}

int measure(const std::string& filter, bool quick, const std::string& json) {
  armature::benchmarks::Report report;
  try {
    add_all(armature::benchmarks::Suite(filter, quick));
  } catch (const std::regex_error& mistake) {
    std::fprintf(stderr, "armature_bench: error: --filter %s: %s\n", filter.c_str(),
                 mistake.what());
    return 2;
  }
  if (benchmark::RunSpecifiedBenchmarks(&report) == 0) {
    std::fprintf(stderr, "armature_bench: error: no entry's name contains '%s'\n", filter.c_str());
    return 2;
  }
  const bool written = json.empty() || report.write_json(json);
  return report.complete() && written ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options("Measures armature beside references.");
  std::string filter;
  std::string json;
  bool quick = false;
  options.add_option("--json", json, "file that the entries are written to");
  options.add_option("--filter", filter, "regular expression: only entries whose name contains it");
  options.add_flag("--quick", quick, "few rounds: shows that everything runs, not how fast");
  CLI11_PARSE(options, argc, argv);
  return measure(filter, quick, json);
}
