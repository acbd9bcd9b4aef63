// SPDX-License-Identifier: Apache-2.0
// Online trajectories under the real-time guard: every function that says it is real-time.
#include <algorithm>
#include <chrono>
#include <string_view>
#include <vector>

#include "armature/control/online/axis_problem.hpp"
#include "armature/control/online/bring_within.hpp"
#include "armature/control/online/online_trajectory.hpp"
#include "armature/control/online/plateau.hpp"
#include "armature/control/online/stops.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::control {
namespace {

using namespace std::chrono_literals;

constexpr JerkLimits kLimits{1.0, 2.0, 20.0};
constexpr MotionSample kStart{0.0, 0.3, -0.5};
constexpr MotionSample kTarget{1.0, 0.2, 0.1};

TEST(RealtimeFunctions, OnlineTrajectory) {
  auto trajectory =
      OnlineTrajectory::make({std::vector(7, OnlineTrajectory::Axis{1, 2, 20, -9, 9})}).value();
  const std::vector<double> zero(7, 0.0);
  const std::vector<double> half(7, 0.5);
  bool accepted = true;
  expect_realtime("OnlineTrajectory::hold",
                  [&] { accepted = accepted && trajectory.hold(zero).accepted(); });
  expect_realtime("OnlineTrajectory::check_target",
                  [&] { accepted = accepted && trajectory.check_target({half}).accepted(); });
  expect_realtime("OnlineTrajectory::begin_at", [&] {
    accepted = accepted && trajectory.begin_at({zero, half, half}).accepted();
  });
  bool there = false;
  expect_realtime("OnlineTrajectory::move_to", [&] {
    there = !there;
    accepted = accepted && trajectory.move_to({there ? half : zero, half}).accepted();
    trajectory.step(10ms);
  });
  expect_realtime("OnlineTrajectory::jog", [&] {
    accepted = accepted && trajectory.hold(zero).accepted() && trajectory.jog(1, 0.5).accepted();
  });
  std::string_view text;
  expect_realtime("control::to_text", [&] {
    text = to_text(trajectory.move_to({half, {}, {}}, -1.0).refusal);
  });
  EXPECT_EQ(text, "the time is negative");
  expect_realtime("OnlineTrajectory::step", [&] { trajectory.step(10ms); });
  expect_realtime("OnlineTrajectory::stop", [&] { trajectory.stop(); });
  EXPECT_TRUE(accepted);
}

TEST(RealtimeFunctions, AxisProblem) {
  double duration_s = 0.0;
  expect_realtime("AxisProblem::AxisProblem",
                  [&] { duration_s += AxisProblem(kLimits, kStart, kTarget).first_duration(0.0); });
  const AxisProblem problem(kLimits, kStart, kTarget);
  expect_realtime("AxisProblem::first_duration", [&] { duration_s = problem.first_duration(0.0); });
  PhasedMotion motion;
  double longer_s = duration_s;
  expect_realtime("AxisProblem::append_to", [&] {
    motion.begin(kStart);
    longer_s += 0.02;  // in turn with a plateau and as a blend
    problem.append_to(motion, problem.first_duration(longer_s));
  });
  EXPECT_NEAR(motion.end().position, kTarget.position, 1e-9);
  MotionSample sample;
  expect_realtime("PhasedMotion::at", [&] { sample = motion.at(motion.duration_s()); });
  EXPECT_NEAR(sample.velocity, kTarget.velocity, 1e-9);
  double highest = 0.0;
  expect_realtime("PhasedMotion::extent", [&] { highest = motion.extent().highest; });
  EXPECT_NEAR(std::max(highest, 1.0), highest, 1e-9) << "no less than where it ends";
  expect_realtime("PhasedMotion::append", [&] { motion.append(0.1, 1.0); });
}

TEST(RealtimeFunctions, Stops) {
  PhasedMotion motion;
  expect_realtime("control::stop_from", [&] { motion = stop_from(kLimits, kStart); });
  EXPECT_NEAR(motion.end().velocity, 0.0, 1e-9);
  PhasedMotion::Extent extent{};
  expect_realtime("control::extent_of_stops", [&] { extent = extent_of_stops(kLimits, motion); });
  EXPECT_GE(extent.highest, motion.end().position - 1e-9);
}

TEST(RealtimeFunctions, FurthestReach) {
  const MotionEnds ends{0.3, -0.5, 0.2, 0.1};
  double sum = 0.0;
  expect_realtime("FurthestReach::FurthestReach",
                  [&] { sum += FurthestReach(kLimits, ends).distance(3.0); });
  const FurthestReach reach(kLimits, ends);
  expect_realtime("FurthestReach::distance", [&] { sum += reach.distance(2.0); });
  expect_realtime("FurthestReach::first_duration",
                  [&] { sum += reach.first_duration(0.0, 1.0, 1e-12); });
  PhasedMotion motion;
  expect_realtime("FurthestReach::append_to", [&] {
    motion.begin({});
    reach.append_to(motion, 2.0, 1.0);
  });
  bool found = false;
  expect_realtime("control::find_plateau",
                  [&] { found = find_plateau(kLimits, ends, 1.0, 5.0).has_value(); });
  EXPECT_TRUE(found);
  EXPECT_GT(sum, 0.0);
}

TEST(RealtimeFunctions, BringWithin) {
  PhasedMotion motion;
  expect_realtime("control::bring_within", [&] {
    motion.begin({0.0, 3.0, 4.0});
    bring_within(kLimits, motion);
  });
  bool inside = false;
  expect_realtime("control::within", [&] {
    inside = within(kLimits, motion.end().velocity, motion.end().acceleration, 1.0);
  });
  EXPECT_TRUE(inside);
}

}  // namespace
}  // namespace armature::control
