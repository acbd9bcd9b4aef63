// SPDX-License-Identifier: Apache-2.0
// What a small robot's process occupies, and how long a program compiles.
#include <cstdlib>
#include <string>
#include <vector>

#include "armature/platform/clock.hpp"
#include "benchmarks/child.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

constexpr double kResidentBound = 12.0;  // MB
constexpr double kCompileBound = 3.0;    // s
constexpr std::int64_t kRounds = 5;
constexpr base::Duration kUntilSteady = std::chrono::milliseconds(500);  // some hundred cycles
constexpr const char* kDeployment = ARMATURE_SOURCE_DIR "/benchmarks/control_cycle/cycle.yaml";

void run_resident(benchmark::State& state, const std::string& realtime) {
  std::vector<double> megabytes;
  for ([[maybe_unused]] auto round : state) {
    const Child robot({ARMATURE_PROGRAM, "run", "--realtime", realtime, "--library-path",
                       ARMATURE_LIBRARIES, kDeployment});
    platform::sleep_until(platform::monotonic_now() + kUntilSteady);
    megabytes.push_back(robot.resident_bytes() / 1e6);
  }
  Result result{median(megabytes), "MB", std::nullopt, std::nullopt, std::nullopt};
  result.bound = value_at_most(kResidentBound);
  publish(state, result);
}

double seconds_to_compile(const std::string& source) {
  const base::Time begin = platform::monotonic_now();
  Child compiler(
      {"g++", "-std=c++20", "-O2", "-I", ARMATURE_SOURCE_DIR, "-c", source, "-o", "/dev/null"});
  compiler.wait();
  return std::chrono::duration<double>(platform::monotonic_now() - begin).count();
}

void run_compiler(benchmark::State& state) {
  setenv("CCACHE_DISABLE", "1", 1);  // NOLINT(concurrency-mt-unsafe)
  std::vector<double> seconds;
  std::vector<double> references;
  for ([[maybe_unused]] auto round : state) {
    seconds.push_back(seconds_to_compile(ARMATURE_SOURCE_DIR "/tests/compile_time/program.cpp"));
    references.push_back(
        seconds_to_compile(ARMATURE_SOURCE_DIR "/benchmarks/standard_headers.cpp"));
  }
  publish(state,
          {median(seconds), "s", median(references), std::nullopt, value_at_most(kCompileBound)});
}

}  // namespace

void add_footprints(const Suite& suite) {
  suite.add("resident_two_joints", kRounds,
            [](benchmark::State& state) { run_resident(state, "off"); });
  suite.add("resident_two_joints/locked", kRounds,
            [](benchmark::State& state) { run_resident(state, "prefer"); });
  suite.add("compile_time", kRounds, run_compiler);
}

}  // namespace armature::benchmarks
