// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/trajectory.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::ros2::internal {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000'000;

const TrajectoryLimits kLimits{{"pan", "tilt"}, {-1.0, -2.0}, {1.0, 2.0}, 10.0};

Trajectory trajectory() {
  return {.joints = {"tilt", "pan"},
          .points = {{{0.5, 0.1}, {0.0, 0.0}, {}, {}, kSecond},
                     {{1.5, -0.9}, {0.0, 0.0}, {}, {}, 3 * kSecond}}};
}

/// Where a joint is on its way, at a time from the start of the trajectory; between samples a line.
double at(const control::TaughtSamples& way, std::size_t joint, double time_s) {
  for (std::size_t i = 1; i < way.times_s.size(); ++i) {
    if (way.times_s[i] - 0.12 < time_s) continue;
    const double share =
        (time_s - (way.times_s[i - 1] - 0.12)) / (way.times_s[i] - way.times_s[i - 1]);
    return (1.0 - share) * way.positions[(i - 1) * way.axes + joint] +
           share * way.positions[i * way.axes + joint];
  }
  return way.positions[way.positions.size() - way.axes + joint];
}

TEST(Trajectory, IsRefusedAsAWholeForWhateverIsWrongWithIt) {
  EXPECT_EQ(objection_to(trajectory(), kLimits), "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Wrong {
    void (*break_it)(Trajectory&, double);
    const char* why;
  };
  const Wrong all[] = {
      {[](Trajectory& t, double) { t.joints[0] = "nod"; }, "unknown joint 'nod'"},
      {[](Trajectory& t, double) { t.joints[0] = "pan"; }, "joint 'pan' stands there twice"},
      {[](Trajectory& t, double) { t.joints.pop_back(); }, "joint 'pan' is missing"},
      {[](Trajectory& t, double) { t.points[1].positions.pop_back(); },
       "point 2: 1 positions, expected 2"},
      {[](Trajectory& t, double) { t.points[1].velocities = {0.0}; },
       "point 2: 1 velocities, expected 2"},
      {[](Trajectory& t, double n) { t.points[1].positions[0] = n; },
       "point 2: a number of positions is not finite"},
      {[](Trajectory& t, double n) { t.points[0].velocities[1] = n; },
       "point 1: a number of velocities is not finite"},
      {[](Trajectory& t, double n) {
         t.points[0].accelerations = {n, n};
       },
       "a number of accelerations is not finite"},
      {[](Trajectory& t, double) {
         t.points[0].accelerations = {0.0, 0.0}, t.points[0].velocities.clear();
       },
       "point 1: accelerations without velocities"},
      {[](Trajectory& t, double) {
         t.points[0].effort = {1.0, 1.0};
       },
       "point 1: efforts"},
      {[](Trajectory& t, double) { t.points[1].time_ns = kSecond; },
       "point 2: time_from_start is not later"},
      {[](Trajectory& t, double) { t.points[0].time_ns = -1; },
       "point 1: time_from_start is not later"},
      {[](Trajectory& t, double) { t.points[1].time_ns = 11 * kSecond; },
       "expected at most max_duration"},
      {[](Trajectory& t, double) { t.points[1].positions[1] = -1.1; },
       "point 2: joint 'pan' is to be at -1.1"},
  };
  for (const Wrong& wrong : all) {
    Trajectory broken = trajectory();
    wrong.break_it(broken, nan);
    EXPECT_THAT(objection_to(broken, kLimits), HasSubstr(wrong.why));
  }
}

TEST(Trajectory, GoesThroughItsPointsFromWhereTheJointsAre) {
  const auto way = way_of(trajectory(), kLimits, std::vector{0.2, -0.3});
  EXPECT_DOUBLE_EQ(at(way, 0, -0.1), 0.2);
  EXPECT_DOUBLE_EQ(at(way, 1, -0.1), -0.3);
  EXPECT_NEAR(at(way, 0, 1.0), 0.1, 1e-4);  // pan, which the message has behind tilt
  EXPECT_NEAR(at(way, 1, 1.0), 0.5, 1e-4);
  EXPECT_NEAR(at(way, 0, 2.0), -0.4, 1e-4);  // in the middle, at rest at both ends
  EXPECT_NEAR(at(way, 0, 3.05), -0.9, 1e-4);
}

TEST(Trajectory, HasTheVelocitiesAndAccelerationsThatAreGiven) {
  Trajectory one{.joints = {"pan", "tilt"},
                 .points = {{{0.5, 0.0}, {1.0, 0.0}, {}, {}, kSecond},
                            {{1.0, 0.0}, {0.0, 0.0}, {}, {}, 2 * kSecond}}};
  auto way = way_of(one, kLimits, std::vector{0.0, 0.0});
  EXPECT_NEAR((at(way, 0, 1.01) - at(way, 0, 0.99)) / 0.02, 1.0, 0.02);
  one.points[0].accelerations = {0.0, 0.0};
  one.points[1].accelerations = {0.0, 0.0};
  way = way_of(one, kLimits, std::vector{0.0, 0.0});
  EXPECT_NEAR((at(way, 0, 1.01) - at(way, 0, 0.99)) / 0.02, 1.0, 0.02);
  EXPECT_NEAR((at(way, 0, 1.05) - 2.0 * at(way, 0, 1.0) + at(way, 0, 0.95)) / 0.0025, 0.0, 0.2);
  one.points[0].velocities.clear();
  one.points[0].accelerations.clear();
  way = way_of(one, kLimits, std::vector{0.0, 0.0});
  EXPECT_NEAR(at(way, 0, 0.5), 0.25, 1e-6);  // a line, as in ROS 2
}

TEST(Trajectory, BecomesASmoothPathThatStaysWithinTheLimits) {
  const Trajectory along_the_limit{.joints = {"pan", "tilt"},
                                   .points = {{{1.0, 2.0}, {}, {}, {}, 2 * kSecond}}};
  // It rests a little beyond the limit, as a controller leaves it.
  const auto way = way_of(along_the_limit, kLimits, std::vector{1.003, -2.0});
  const auto path = smooth_path_of(way, kLimits);
  ASSERT_TRUE(path) << path.error();
  EXPECT_LT(path.value().largest_deviation, 0.005);
  for (std::size_t i = 0; i < path.value().points.size(); ++i) {
    EXPECT_GE(path.value().points[i], kLimits.lower[i % 2]);
    EXPECT_LE(path.value().points[i], kLimits.upper[i % 2]);
  }
  EXPECT_NEAR(path.value().positions_at(path.value().duration_s())[1], 2.0, 1e-3);
}

}  // namespace
}  // namespace armature::ros2::internal
