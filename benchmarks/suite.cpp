// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/suite.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>

#include "armature/platform/clock.hpp"
#include "benchmarks/allocations.hpp"

namespace armature::benchmarks {
namespace {

constexpr std::int64_t kQuickRounds = 1;

double duration_of(const Work& work, std::int64_t count) {
  const std::uint64_t begin = platform::ticks();
  work(count);
  return static_cast<double>(platform::ticks() - begin) * platform::tick_period_ns();
}

/// How many times `ours` fills a batch; warms both up.
std::int64_t batch_size(const Work& ours, const Work& reference, base::Duration batch) {
  for (std::int64_t count = 1;; count *= 2) {
    const double duration = duration_of(ours, count);
    reference(count);
    if (duration >= static_cast<double>(batch.count())) return count;
  }
}

}  // namespace

void publish(benchmark::State& state, const Result& result) {
  state.SetLabel(result.unit);
  state.counters["value"] = result.value;
  if (result.reference) state.counters["reference"] = *result.reference;
  if (result.allocations) state.counters["allocations"] = *result.allocations;
  if (!result.bound) return;
  const bool of_ratio = result.bound->of == Bound::Of::kRatio;
  state.counters[of_ratio ? "ratio_bound" : "value_bound"] = result.bound->at_most;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Result measure_in_turn(benchmark::State& state, const Work& ours, const Work& reference,
                       std::chrono::microseconds batch) {
  const std::int64_t count = batch_size(ours, reference, batch);
  const auto each = static_cast<double>(count);
  std::vector<double> values;
  std::vector<double> references;
  std::uint64_t allocated = 0;
  for ([[maybe_unused]] auto round : state) {
    const std::uint64_t before = allocations();
    const double duration = duration_of(ours, count);
    allocated += allocations() - before;
    values.push_back(duration / each);
    references.push_back(duration_of(reference, count) / each);
    state.SetIterationTime(duration * 1e-9);
  }
  const double operations = each * static_cast<double>(values.size());
  return {median(values), "ns", median(references), static_cast<double>(allocated) / operations,
          std::nullopt};
}

void Suite::add(const std::string& name, std::int64_t rounds,
                const std::function<void(benchmark::State&)>& run) const {
  if (!std::regex_search(name, filter_)) return;
  const auto guarded = [run](benchmark::State& state) {
    try {
      run(state);
    } catch (const std::exception& failure) {
      state.SkipWithError(failure.what());
    }
  };
  benchmark::RegisterBenchmark(name.c_str(), guarded)
      ->Iterations(quick_ ? std::min(rounds, kQuickRounds) : rounds)
      ->UseManualTime();
}

}  // namespace armature::benchmarks
