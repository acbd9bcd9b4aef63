// SPDX-License-Identifier: Apache-2.0
// What motions of a tool cost: a cycle of the player at 1 kHz with the WAM's seven joints, and the
// planning of a line and of a jog.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "armature/control/cartesian/cartesian_plan.hpp"
#include "armature/control/taught/taught_player.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

using namespace std::chrono_literals;
using control::InverseKinematics;
using control::PosePath;
using control::TaughtPlayer;
using Numbers = std::vector<double>;

constexpr const char* kUrdf = ARMATURE_SOURCE_DIR "/robots/wam/wam7.urdf";
constexpr double kMeanBound = 5'000.0;    // [ns], half a per cent of a cycle at 1 kHz
constexpr double kWorstBound = 50'000.0;  // [ns]
constexpr double kPlanBound = 500.0;      // [ms]
constexpr double kJogBound = 100.0;       // [ms]: an operator does not notice it
constexpr int kCalls = 5;

/// The arm, and a line of its tool of 0.3 m that also turns.
struct Tool {
  Tool() {
    for (const auto& each : arm.limits()) {
      limits.lower.push_back(each.lower);
      limits.upper.push_back(each.upper);
    }
  }

  static InverseKinematics load() {
    base::Diagnostics diagnostics;
    auto arm = InverseKinematics::load(kUrdf, {.base_link = {}, .tip_link = "tool"}, diagnostics);
    if (arm) return std::move(*arm);
    std::fprintf(stderr, "%s\n", diagnostics.to_text().c_str());
    std::abort();
  }
  control::Pose moved(const control::PoseNumbers& by) {
    control::PoseNumbers numbers = control::numbers_of(arm.pose_at(start));
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] += by[i];
    return control::pose_of(numbers);
  }
  PosePath line() {
    return PosePath::line(moved({}), moved({0.05, 0.28, 0.1, 0.0, 0.0, 0.3})).value();
  }
  TaughtPlayer player() const {
    std::vector<control::OnlineTrajectory::Axis> axes;
    for (std::size_t i = 0; i < start.size(); ++i) {
      axes.push_back({2.0, 8.0, 80.0, limits.lower[i], limits.upper[i]});
    }
    return TaughtPlayer::make({axes, 60.0}).value();
  }

  InverseKinematics arm = load();
  control::CartesianLimits limits;
  Numbers start{0.2, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5};
};

/// Each cycle of a motion, the shortest of some plays: what the machine does besides is not its
/// cost.
Numbers cycles_of(TaughtPlayer& player, const Tool& tool, const control::CartesianPlan& plan) {
  Numbers shortest;
  for (int call = 0; call < kCalls; ++call) {
    static_cast<void>(player.play_from_here({tool.start}, plan.points, plan.speed, nullptr));
    for (std::size_t cycle = 0; player.under_way(); ++cycle) {
      const auto begin = std::chrono::steady_clock::now();
      player.step(1ms);
      const auto end = std::chrono::steady_clock::now();
      const double cost = std::chrono::duration<double, std::nano>(end - begin).count();
      if (cycle == shortest.size()) shortest.push_back(cost);
      shortest[cycle] = std::min(shortest[cycle], cost);
    }
  }
  return shortest;
}

void measure_cycles(benchmark::State& state, bool worst) {
  Tool tool;
  const auto plan = control::plan_cartesian(tool.arm, tool.line(), tool.start, tool.limits).value();
  TaughtPlayer player = tool.player();
  double sum = 0.0;
  double count = 0.0;
  double most = 0.0;
  for ([[maybe_unused]] auto _ : state) {
    for (const double each : cycles_of(player, tool, plan)) {
      sum += each;
      count += 1.0;
      most = std::max(most, each);
    }
  }
  Result result;
  result.value = worst ? most : sum / count;
  result.unit = "ns";
  result.bound = value_at_most(worst ? kWorstBound : kMeanBound);
  publish(state, result);
}

/// The median of all rounds.
template <typename Plan>
void measure_plans(benchmark::State& state, double bound, const Plan& plan) {
  Tool tool;
  Numbers all;
  for ([[maybe_unused]] auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(plan(tool));
    const auto end = std::chrono::steady_clock::now();
    all.push_back(std::chrono::duration<double, std::milli>(end - begin).count());
  }
  std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2));
  Result result;
  result.value = all[all.size() / 2];
  result.unit = "ms";
  result.bound = value_at_most(bound);
  publish(state, result);
}

}  // namespace

void add_cartesian(const Suite& suite) {
  suite.add("cartesian/7/mean", 5, [](auto& state) { measure_cycles(state, false); });
  suite.add("cartesian/7/worst", 5, [](auto& state) { measure_cycles(state, true); });
  suite.add("cartesian/7/plan", 21, [](auto& state) {
    measure_plans(state, kPlanBound, [](Tool& tool) {
      return control::plan_cartesian(tool.arm, tool.line(), tool.start, tool.limits).value();
    });
  });
  suite.add("cartesian/7/plan_jog", 21, [](auto& state) {
    measure_plans(state, kJogBound, [](Tool& tool) {
      const auto line = PosePath::line(tool.moved({}), tool.moved({0, 0.7, 0.7, 0, 0, 0})).value();
      return control::plan_jog(tool.arm, line, tool.start, tool.limits).value();
    });
  });
}

}  // namespace armature::benchmarks
