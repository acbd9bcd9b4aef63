// SPDX-License-Identifier: Apache-2.0
// What somebody who watches costs the cycle: beside the same cycle in the same run, in simulated
// time, 200 numbers copied 60 times a second, or all that the joints have if that is less.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "armature/component/interface.hpp"
#include "armature/exec/application.hpp"
#include "armature/types/number_place.hpp"
#include "benchmarks/control_cycle/cycle.hpp"
#include "benchmarks/simulated.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

constexpr double kBound = 1.02;
constexpr std::int64_t kRounds = 301;
constexpr std::size_t kNumbers = 200;
constexpr std::chrono::microseconds kInterval{16'667};
constexpr std::chrono::milliseconds kBatch{3};

std::vector<exec::WatchedNumber> numbers_of(const exec::Application& application) {
  std::vector<exec::WatchedNumber> numbers;
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    for (const auto* port : component::interface_of(*entry.component).outputs) {
      for (auto& place : types::NumberPlace::all_in(port->type(), port->current())) {
        numbers.push_back({entry.component.get(), port, nullptr, std::move(place)});
      }
    }
  }
  numbers.resize(std::min(numbers.size(), kNumbers));
  return numbers;
}

void run_with_and_without(benchmark::State& state, int joints) {
  exec::Application with(make_cycle(joints, one_thread()), simulated());
  exec::Application without(make_cycle(joints, one_thread()), simulated());
  for (exec::Application* each : {&with, &without}) {
    const base::Diagnostics started = each->start();
    if (!started.ok()) return state.SkipWithError(started.to_text().c_str());
  }
  const auto handle = with.watch(numbers_of(with), kInterval);
  if (!handle) return state.SkipWithError(handle.error().c_str());
  Result result = measure_in_turn(
      state,
      [&](std::int64_t count) {
        with.run_for(std::chrono::milliseconds(count));
        benchmark::DoNotOptimize(with.watched(handle.value()));
      },
      [&](std::int64_t count) { without.run_for(std::chrono::milliseconds(count)); }, kBatch);
  result.bound = ratio_at_most(kBound);
  publish(state, result);
}

}  // namespace

void add_watches(const Suite& suite) {
  for (const int joints : {2, 7, 64}) {
    suite.add("watched/" + std::to_string(joints), kRounds,
              [joints](benchmark::State& state) { run_with_and_without(state, joints); });
  }
}

}  // namespace armature::benchmarks
