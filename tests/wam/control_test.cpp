// SPDX-License-Identifier: Apache-2.0
// The arm's controllers as their deployments have them, on the simulated arm.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wam/robot.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

std::string text_of(const Vector& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return "[" + text + "]";
}

/// A tour from home through the arm's range, each motion in 5 s.
std::vector<Vector> tour(std::size_t joints) {
  std::vector<Vector> targets{{0.0, 0.0, 0.0, 1.57, 0.0, 0.0, 0.0},
                              {1.2, 1.0, -0.8, 0.6, -1.5, 0.8, 1.2},
                              {-1.0, -0.9, 0.9, 2.2, 0.6, -0.9, -1.4},
                              {0.0, -1.9, 0.0, 3.0, 0.0, 0.0, 0.0}};
  for (Vector& target : targets) target.resize(joints);
  return targets;
}

struct Tracking {
  Vector largest;   ///< [rad] of each joint
  Vector absolute;  ///< integral [rad s]
};

/// Moves through the tour by the operator's Reference, with 1 s of rest behind each motion.
Tracking track(Robot& robot) {
  Tracking tracking{Vector(robot.joints(), 0.0), Vector(robot.joints(), 0.0)};
  for (int i = 0; i < 250; ++i) robot.cycle();
  for (const Vector& target : tour(robot.joints())) {
    robot.set("Reference", "jointPosition", target);
    const auto moved = robot.call("Reference", "moveToRefOperation");
    EXPECT_TRUE(moved) << moved.error();
    for (int cycle = 0; cycle < 3000; ++cycle) {
      // What the controller is to follow in a cycle was written in the one before.
      const auto desired = robot.value<Vector>("Generator", "nAxesDesiredPosition");
      robot.cycle();
      const Vector positions = robot.positions();
      for (std::size_t i = 0; i < robot.joints(); ++i) {
        const double error = std::abs(desired[i] - positions[i]);
        tracking.largest[i] = std::max(tracking.largest[i], error);
        tracking.absolute[i] += 0.002 * error;
      }
    }
    const Vector positions = robot.positions();
    for (std::size_t i = 0; i < robot.joints(); ++i) {
      EXPECT_NEAR(positions[i], target[i], 0.02) << "joint " << i + 1;
    }
  }
  EXPECT_EQ(robot.application().faults(), 0u);
  EXPECT_EQ(robot.application().reactions(), 0u);
  return tracking;
}

class Control : public ::testing::TestWithParam<std::tuple<int, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Wam, Control,
                         ::testing::Combine(::testing::Values(4, 7),
                                            ::testing::Values("npid", "controller_wam",
                                                              "computed_torque", "gravity_pd")),
                         [](const auto& tested) {
                           return std::string(std::get<1>(tested.param)) + "_of_" +
                                  std::to_string(std::get<0>(tested.param)) + "_joints";
                         });

TEST_P(Control, TracksMotionsOfFiveSecondsWithinTwoHundredthsOfARadian) {
  Robot robot({.joints = std::get<0>(GetParam()), .controller = std::get<1>(GetParam())});
  const Tracking tracking = track(robot);
  std::cout << "largest " << text_of(tracking.largest) << "\n IAE " << text_of(tracking.absolute)
            << " limited " << robot.bench().limited() << "\n";
  for (const double largest : tracking.largest) EXPECT_LT(largest, 0.02);
}

}  // namespace
}  // namespace armature::wam
