// SPDX-License-Identifier: Apache-2.0
// The sampled-control cycle in one thread, in simulated time, beside a hand-written loop.
#include <string>

#include "armature/exec/application.hpp"
#include "benchmarks/control_cycle/comparison.hpp"
#include "benchmarks/control_cycle/cycle.hpp"
#include "benchmarks/control_cycle/monolithic.hpp"
#include "benchmarks/simulated.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

constexpr double kBound = 10.0;
constexpr std::int64_t kRounds = 301;
/// So that a disturbance of a millisecond is one of few rounds, and the reference has its turn of
/// a length, too.
constexpr std::chrono::milliseconds kBatch{3};

void run_cycle(benchmark::State& state, int joints) {
  exec::Application application(make_cycle(joints, one_thread()), simulated());
  const base::Diagnostics started = application.start();
  if (!started.ok()) return state.SkipWithError(started.to_text().c_str());
  application.run_for(std::chrono::milliseconds(10));
  arm(application);
  MonolithicController loop(joints);

  Result result = measure_in_turn(
      state, [&](std::int64_t count) { application.run_for(std::chrono::milliseconds(count)); },
      [&](std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) loop.cycle();
      },
      kBatch);
  result.bound = ratio_at_most(kBound);
  publish(state, result);
  const std::string difference = difference_of(application, loop, joints);
  if (!difference.empty()) state.SkipWithError(difference.c_str());
}

}  // namespace

void add_cycles(const Suite& suite) {
  for (const int joints : {2, 7, 64, 256, 1000}) {
    suite.add("cycle/" + std::to_string(joints), kRounds,
              [joints](benchmark::State& state) { run_cycle(state, joints); });
  }
}

}  // namespace armature::benchmarks
