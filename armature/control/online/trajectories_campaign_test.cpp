// SPDX-License-Identifier: Apache-2.0
// Random problems of 1 to 14 axes, each solved, checked phase by phase, and some of them compared
// with a search of switching times. 400 of each number of axes here; as many as TRAJECTORIES says
// by scripts/campaign trajectories, which prints a row for each number of axes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "armature/control/internal/switching_search.hpp"
#include "armature/control/online/online_trajectory.hpp"
#include "armature/testing/random_motion.hpp"

namespace armature::control {
namespace {

constexpr int kMostAxes = 14;
constexpr int kSearchedOneOf = 16;
constexpr int kSearchSteps = 150;

int problems_of_each() {
  const char* const asked = std::getenv("TRAJECTORIES");
  return asked == nullptr ? 400 : std::max(1, std::atoi(asked) / kMostAxes);
}

/// Where the axes begin and are to arrive; one axis of eight begins beyond its limits.
struct RandomProblem {
  std::vector<JerkLimits> limits;
  std::vector<MotionSample> starts;
  std::vector<MotionSample> targets;

  RandomProblem(testing::RandomMotion& random, std::size_t axes) {
    for (std::size_t i = 0; i < axes; ++i) {
      limits.push_back(random.limits());
      targets.push_back(random.state(limits[i]));
      starts.push_back(random.one_of(8) == 0 ? random.beyond(limits[i])
                                             : random.start(limits[i], targets[i]));
    }
  }
};

/// The numbers of states, as a trajectory takes them.
struct Columns {
  std::vector<double> positions;
  std::vector<double> velocities;
  std::vector<double> accelerations;

  explicit Columns(const std::vector<MotionSample>& states) {
    for (const MotionSample& state : states) {
      positions.push_back(state.position);
      velocities.push_back(state.velocity);
      accelerations.push_back(state.acceleration);
    }
  }
  OnlineTrajectory::State state() const { return {positions, velocities, accelerations}; }
};

/// What is worst of all problems.
struct Worst {
  double end = 0.0;      ///< by which an axis misses its target, of 1 + what it may cover meanwhile
  double limits = 0.0;   ///< by which a limit is exceeded, in the units of the axis
  double apart_s = 0.0;  ///< between the ends of axes, of 1 + the duration
  double slower = 0.0;   ///< than the search, as a share
  int searched = 0;
  int as_fast = 0;  ///< of these, within 0.1 %
};

bool is_within(const JerkLimits& limits, const MotionSample& state) {
  return within(limits, state.velocity, state.acceleration, 1.0);
}

/// By which a motion exceeds its limits, at most, from where it is within them for the first time:
/// at the ends of its phases, and where its velocity turns.
double excess_of(const JerkLimits& limits, const PhasedMotion& motion) {
  double most = 0.0;
  bool inside = false;
  for (std::size_t i = 0; i < motion.phases(); ++i) {
    const double begin_s = motion.start_of(i);
    const double end_s = i + 1 < motion.phases() ? motion.start_of(i + 1) : motion.duration_s();
    const double jerk = motion.jerk_of(i);
    const MotionSample begin = motion.at(begin_s);
    inside = inside || is_within(limits, begin);
    most = std::max(most, std::abs(jerk) - limits.jerk);
    if (!inside) continue;
    const double turn_s = std::clamp(-begin.acceleration / jerk, 0.0, end_s - begin_s);
    for (const double there_s : {0.0, end_s - begin_s, std::isfinite(turn_s) ? turn_s : 0.0}) {
      const MotionSample there = after(begin, there_s, jerk);
      most = std::max({most, std::abs(there.velocity) - limits.velocity,
                       std::abs(there.acceleration) - limits.acceleration});
    }
  }
  return most;
}

double miss_of(const PhasedMotion& motion, const MotionSample& target, double scale) {
  const double last_s = std::nextafter(motion.duration_s(), 0.0);
  const MotionSample last = motion.at(last_s);
  return std::max({std::abs(last.position - target.position) / scale,
                   std::abs(last.velocity - target.velocity),
                   std::abs(last.acceleration - target.acceleration)});
}

void check(const RandomProblem& problem, const OnlineTrajectory& trajectory, Worst& worst) {
  const double duration_s = trajectory.duration_s();
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    const PhasedMotion& motion = trajectory.motion(i);
    const JerkLimits& limits = problem.limits[i];
    worst.limits = std::max(worst.limits, excess_of(limits, motion));
    worst.apart_s =
        std::max(worst.apart_s, std::abs(motion.duration_s() - duration_s) / (1.0 + duration_s));
    if (duration_s == 0.0) continue;
    const double scale = 1.0 + limits.velocity * duration_s;
    worst.end = std::max(worst.end, miss_of(motion, problem.targets[i], scale));
  }
}

/// One axis by itself, if it begins within its limits.
void search(const RandomProblem& problem, std::size_t axis, Worst& worst) {
  const JerkLimits& limits = problem.limits[axis];
  const MotionSample& start = problem.starts[axis];
  if (!is_within(limits, start)) return;
  const double found_s = AxisProblem(limits, start, problem.targets[axis]).first_duration(0.0);
  const double searched_s =
      SwitchingSearch(limits, start, problem.targets[axis]).duration_s(kSearchSteps);
  ++worst.searched;
  if (searched_s <= 1.001 * found_s) ++worst.as_fast;
  worst.slower = std::max(worst.slower, (found_s - 1e-6) / searched_s - 1.0);
}

class Trajectories : public ::testing::TestWithParam<int> {};

TEST_P(Trajectories, AreSolvedWithinTheirLimitsTogetherAndNoSearchFindsAFasterOne) {
  const auto axes = static_cast<std::size_t>(GetParam());
  const int problems = problems_of_each();
  testing::RandomMotion random(100 + axes);
  Worst worst;
  for (int round = 0; round < problems; ++round) {
    const RandomProblem problem(random, axes);
    OnlineTrajectory::Config config;
    for (const auto& [v, a, j] : problem.limits) config.axes.push_back({v, a, j});
    OnlineTrajectory trajectory = OnlineTrajectory::make(config).value();
    ASSERT_TRUE(trajectory.begin_at(Columns(problem.starts).state()).accepted());
    ASSERT_TRUE(trajectory.move_to(Columns(problem.targets).state()).accepted()) << round;
    check(problem, trajectory, worst);
    if (round % kSearchedOneOf == 0) {
      search(problem, static_cast<std::size_t>(round / kSearchedOneOf) % axes, worst);
    }
  }
  EXPECT_LE(worst.end, 1e-9);
  EXPECT_LE(worst.limits, 1e-9);
  EXPECT_LE(worst.apart_s, 1e-9);
  EXPECT_LE(worst.slower, 1e-3);
  EXPECT_GE(worst.as_fast, worst.searched / 2) << "a search that finds nothing is no test";
  if (std::getenv("TRAJECTORIES") != nullptr) {
    std::printf(
        "axes %2d  %8d problems  end %.1e  limits %.1e  apart %.1e  searched %6d  as fast %6d  "
        "slower %.1e\n",
        GetParam(), problems, worst.end, worst.limits, worst.apart_s, worst.searched, worst.as_fast,
        worst.slower);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Trajectories, ::testing::Range(1, kMostAxes + 1),
                         [](const auto& param) { return std::to_string(param.param) + "Axes"; });

}  // namespace
}  // namespace armature::control
