// SPDX-License-Identifier: Apache-2.0
// What the timeline costs the cycle: beside the same cycle in the same run, in simulated time,
// where what is written is written at the cycle's expense.
#include <memory>
#include <string>

#include "armature/exec/application.hpp"
#include "armature/record/timeline_writer.hpp"
#include "benchmarks/control_cycle/cycle.hpp"
#include "benchmarks/simulated.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

constexpr double kBoundOn = 1.2;
constexpr std::int64_t kRounds = 301;
constexpr std::chrono::milliseconds kBatch{3};

void run_with_and_without(benchmark::State& state, int joints) {
  auto writer = record::TimelineWriter::create("/dev/null");
  if (!writer) return state.SkipWithError(writer.error().c_str());
  exec::ApplicationOptions options = simulated();
  options.timeline.sink = [&](const exec::TimelineSlice& slice) { writer.value()->add(slice); };
  exec::Application with(make_cycle(joints, one_thread()), options);
  exec::Application without(make_cycle(joints, one_thread()), simulated());
  for (exec::Application* each : {&with, &without}) {
    const base::Diagnostics started = each->start();
    if (!started.ok()) return state.SkipWithError(started.to_text().c_str());
  }
  // What a run may spend at once is spent before.
  with.run_for(std::chrono::milliseconds(state.max_iterations > 10 ? 2'000'000 / joints : 100));
  Result result = measure_in_turn(
      state, [&](std::int64_t count) { with.run_for(std::chrono::milliseconds(count)); },
      [&](std::int64_t count) { without.run_for(std::chrono::milliseconds(count)); }, kBatch);
  result.allocations.reset();
  result.bound = ratio_at_most(kBoundOn);
  publish(state, result);
}

}  // namespace

void add_timelines(const Suite& suite) {
  for (const int joints : {2, 7, 64, 256, 1000}) {
    suite.add("timeline_on/" + std::to_string(joints), kRounds,
              [joints](benchmark::State& state) { run_with_and_without(state, joints); });
  }
}

}  // namespace armature::benchmarks
