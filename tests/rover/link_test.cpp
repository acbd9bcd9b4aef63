// SPDX-License-Identifier: Apache-2.0
// The rover in several processes, with a network whose delays are simulated, in simulated time.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/rover/linked.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;

constexpr double kDegree = std::numbers::pi / 180.0;
const std::vector<std::string> kOne{"rover.yaml"};
const std::vector<std::string> kTwo{"robot.yaml", "pilot.yaml"};
const std::vector<std::string> kThree{"chassis.yaml", "vision.yaml", "pilot.yaml"};

/// Of the same ways of the ball as in experiment.lua.
struct Figures {
  Following at_rest;
  Following line;
  Following circle;  ///< once it is followed steadily
  Following eight;   ///< without the way to it
};

Following without_the_way(const std::vector<Sight>& sights, std::size_t images) {
  return following({sights.begin() + static_cast<std::ptrdiff_t>(images), sights.end()});
}

/// Of the last 15 s.
Following on_circle(Linked& rover, base::Duration duration) {
  rover.go(BallWay::kCircle);
  const std::vector<Sight> sights = rover.watch(duration);
  return without_the_way(sights, sights.size() - 300);
}

Figures figures_of(Linked& rover) {
  Figures figures;
  figures.at_rest = without_the_way(rover.watch(6s), 80);
  rover.go(BallWay::kLine);
  figures.line = following(rover.watch(10s));
  figures.circle = on_circle(rover, 30s);
  rover.go(BallWay::kEight);
  figures.eight = without_the_way(rover.watch(36s), 120);
  return figures;
}

void print(const char* what, const Following& found) {
  std::cout << what << ": " << found.distance_error_m << " m, " << found.bearing_rad / kDegree
            << " degrees, nearest " << found.nearest_m << " m\n";
}

/// Within 5 %, and what no camera sees: 2 mm and 0.05 degrees.
void expect_same(const char* where, const Following& one, const Following& other) {
  print(where, one);
  print(where, other);
  EXPECT_NEAR(other.distance_error_m, one.distance_error_m, 0.05 * one.distance_error_m + 0.002)
      << where;
  EXPECT_NEAR(other.bearing_rad, one.bearing_rad, 0.05 * one.bearing_rad + 0.05 * kDegree) << where;
  EXPECT_NEAR(other.nearest_m, one.nearest_m, 0.05 * one.nearest_m) << where;
}

TEST(SimulatedLink, FollowsWithDelaysThatVaryAndStalls) {
  const Delays delays{.least = 0ms, .most = 100ms, .stalls = 0.01, .stall = 300ms};
  for (const std::uint32_t seed : {1U, 100U, 1000U}) {
    Linked rover(kTwo, delays, seed);
    rover.run_for(3s);
    const Following found = on_circle(rover, 45s);
    print("circle, two processes", found);
    EXPECT_LE(found.bearing_rad, 12 * kDegree);
    EXPECT_LE(found.distance_error_m, 0.4);
    EXPECT_GE(found.nearest_m, 0.5);
    EXPECT_EQ(rover.of_pilot<std::int64_t>("Follow", "Refused"), 0);
    EXPECT_EQ(rover.of_pilot<std::int64_t>("Follow", "Failures"), 0);
    EXPECT_GE(rover.chassis_of_pilot().most_under_way(), 4U);
    EXPECT_GE(rover.chassis_of_pilot().given(), 900U) << "of 20 Hz in 48 s";
  }
}

TEST(SimulatedLink, OneProcessAndThreeHaveTheSameFigures) {
  Linked one(kOne);
  Linked three(kThree, {.least = 0ms, .most = 2ms});
  const Figures of_one = figures_of(one);
  const Figures of_three = figures_of(three);
  expect_same("rest", of_one.at_rest, of_three.at_rest);
  expect_same("line", of_one.line, of_three.line);
  expect_same("circle", of_one.circle, of_three.circle);
  expect_same("eight", of_one.eight, of_three.eight);
}

TEST(SimulatedLink, TwiceTheSameToTheBit) {
  std::vector<double> before;
  for (int run = 0; run < 2; ++run) {
    Linked rover(kTwo, {.least = 0ms, .most = 100ms, .stalls = 0.01, .stall = 300ms});
    rover.go(BallWay::kEight);
    std::vector<double> now;
    for (const Sight& sight : rover.watch(5s)) {
      now.insert(now.end(), {sight.view.x, sight.view.y, sight.view.heading});
    }
    if (run == 1) {
      EXPECT_EQ(now, before);
    }
    before = now;
  }
}

}  // namespace
}  // namespace armature::rover
