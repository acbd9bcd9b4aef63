// SPDX-License-Identifier: Apache-2.0
// What a new target costs in the middle of a motion: random limits, states and targets of N axes.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "armature/control/online/online_trajectory.hpp"
#include "armature/testing/random_motion.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

using control::OnlineTrajectory;
using Numbers = std::vector<double>;

constexpr double kMeanBound = 25'000.0;    // [ns]
constexpr double kWorstBound = 100'000.0;  // [ns]

/// A trajectory in some motion, and its next target.
struct Problem {
  Problem(testing::RandomMotion& random, std::size_t axes) : trajectory(make(random, axes)) {}

  /// The time of one call [ns]; the first of the target, as the same one costs nothing.
  double solve_ns() {
    static_cast<void>(trajectory.begin_at({start[0], start[1], start[2]}));
    const auto begin = std::chrono::steady_clock::now();
    static_cast<void>(trajectory.move_to({target[0], target[1], target[2]}));
    const auto end = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::nano>(end - begin).count();
  }

  Numbers start[3];
  Numbers target[3];
  OnlineTrajectory trajectory;

 private:
  static void add(Numbers (&numbers)[3], const control::MotionSample& sample) {
    numbers[0].push_back(sample.position);
    numbers[1].push_back(sample.velocity);
    numbers[2].push_back(sample.acceleration);
  }
  OnlineTrajectory make(testing::RandomMotion& random, std::size_t axes) {
    OnlineTrajectory::Config config;
    for (std::size_t i = 0; i < axes; ++i) {
      const auto limits = random.limits();
      config.axes.push_back({limits.velocity, limits.acceleration, limits.jerk});
      const auto wanted = random.state(limits);
      add(start, random.start(limits, wanted));
      add(target, wanted);
    }
    return OnlineTrajectory::make(config).value();
  }
};

/// The shortest of some calls for each problem: what the machine does besides is not its cost.
std::vector<double> costs(std::size_t axes, std::int64_t rounds) {
  constexpr int kCalls = 5;
  testing::RandomMotion random(axes);
  std::vector<double> all;
  for (std::int64_t i = 0; i < rounds; ++i) {
    Problem problem(random, axes);
    double shortest = problem.solve_ns();
    for (int call = 1; call < kCalls; ++call) shortest = std::min(shortest, problem.solve_ns());
    all.push_back(shortest);
  }
  return all;
}

void measure(benchmark::State& state, std::size_t axes, bool worst) {
  std::vector<double> all;
  for ([[maybe_unused]] auto _ : state) {
    const std::vector<double> some = costs(axes, 100);
    all.insert(all.end(), some.begin(), some.end());
  }
  double sum = 0.0;
  for (const double each : all) sum += each;
  Result result;
  result.value = worst ? *std::ranges::max_element(all) : sum / static_cast<double>(all.size());
  result.unit = "ns";
  result.bound = value_at_most(worst ? kWorstBound : kMeanBound);
  publish(state, result);
}

}  // namespace

void add_online_trajectories(const Suite& suite) {
  for (const std::size_t axes : {1u, 7u, 14u}) {
    const std::string name = "online_trajectory/" + std::to_string(axes);
    suite.add(name + "/mean", 200, [axes](auto& state) { measure(state, axes, false); });
    suite.add(name + "/worst", 200, [axes](auto& state) { measure(state, axes, true); });
  }
}

}  // namespace armature::benchmarks
