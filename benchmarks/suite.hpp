// SPDX-License-Identifier: Apache-2.0
#pragma once

// How measurements become entries: Google Benchmark runs them, one iteration for each round of
// "ours, then the reference".

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace armature::benchmarks {

/// What is to be reached.
struct Bound {
  enum class Of { kRatio, kValue };
  Of of;
  double at_most;
};
inline Bound ratio_at_most(double limit) { return {Bound::Of::kRatio, limit}; }
inline Bound value_at_most(double limit) { return {Bound::Of::kValue, limit}; }

/// One entry of the results, but for its name.
struct Result {
  double value = 0.0;
  std::string unit;
  std::optional<double> reference;
  std::optional<double> allocations;  ///< for each operation that is measured
  std::optional<Bound> bound;
};

/// Makes `result` the outcome of the running benchmark.
void publish(benchmark::State& state, const Result& result);

double median(std::vector<double> values);

/// Does something `count` times.
using Work = std::function<void(std::int64_t count)>;

/// Measures `ours` and `reference` in turn, so that whatever disturbs one disturbs the other: [ns]
/// for one time, medians of all rounds. Both do the same number, in all.
/// @param batch  how long each turn takes at least: long against the clock, and against waking up
///               the threads that do the work; short against disturbances
Result measure_in_turn(benchmark::State& state, const Work& ours, const Work& reference,
                       std::chrono::microseconds batch = std::chrono::microseconds(300));

/// The benchmarks that were asked for.
class Suite {
 public:
  /// @param filter  regular expression that their names contain
  Suite(const std::string& filter, bool quick) : filter_(filter), quick_(quick) {}

  /// Few and short: only to see that everything runs.
  bool quick() const { return quick_; }

  /// Registers a benchmark of so many rounds, if it was asked for.
  void add(const std::string& name, std::int64_t rounds,
           const std::function<void(benchmark::State&)>& run) const;

 private:
  std::regex filter_;
  bool quick_;
};

// --- themes, a file each -------------------------------------------------------------------------
void add_cycles(const Suite& suite);
void add_threaded_cycles(const Suite& suite);
void add_timelines(const Suite& suite);
void add_watches(const Suite& suite);
void add_models(const Suite& suite);
void add_online_trajectories(const Suite& suite);
void add_cartesian(const Suite& suite);
void add_drives(const Suite& suite);
void add_vision(const Suite& suite);
void add_calls(const Suite& suite);
void add_event_commands(const Suite& suite);
void add_crossings(const Suite& suite);
void add_latency(const Suite& suite);
void add_deployments(const Suite& suite);
void add_queries(const Suite& suite);
void add_remote(const Suite& suite);
void add_fan_outs(const Suite& suite);
void add_footprints(const Suite& suite);

}  // namespace armature::benchmarks
