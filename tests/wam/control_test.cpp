// SPDX-License-Identifier: Apache-2.0
// The arm's controllers as their deployments have them, on the simulated arm.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wam/robot.hpp"

namespace armature::wam {
namespace {

using ::testing::HasSubstr;

std::string text_of(const Vector& numbers, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[static_cast<std::size_t>(i)]);
  }
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
  EXPECT_EQ(robot.bench().limited(), 0) << "no motor is asked for more than its puck gives";
  return tracking;
}

/// As MODEL.md has it.
void print(const Tracking& made, const std::string& what) {
  std::printf("%-28s largest error [mrad]", what.c_str());
  for (const double error : made.largest) std::printf(" %.2f", 1e3 * error);
  std::printf("\n");
}

/// The tour of each controller is made once for all tests.
enum class Steps { kNone, kOfPucks };
const Tracking& tracking_of(int joints, const std::string& controller, Steps steps) {
  static std::map<std::tuple<int, std::string, Steps>, Tracking> known;
  const auto key = std::make_tuple(joints, controller, steps);
  if (const auto found = known.find(key); found != known.end()) return found->second;
  Robot::Config config{.joints = joints, .controller = controller};
  if (steps == Steps::kOfPucks) config.overrides = {"Sensor.rounds=true"};
  Robot robot(config);
  const Tracking& made = known.emplace(key, track(robot)).first->second;
  print(made, controller + std::to_string(joints) + (steps == Steps::kOfPucks ? " in steps" : ""));
  return made;
}

class Control : public ::testing::TestWithParam<std::tuple<int, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Wam, Control,
                         ::testing::Combine(::testing::Values(4, 7),
                                            ::testing::Values("npid", "computed_torque",
                                                              "gravity_pd")),
                         [](const auto& tested) {
                           return std::string(std::get<1>(tested.param)) + "_of_" +
                                  std::to_string(std::get<0>(tested.param)) + "_joints";
                         });

TEST_P(Control, TracksMotionsOfFiveSecondsWithinTwoHundredthsOfARadian) {
  const auto [joints, controller] = GetParam();
  for (const double error : tracking_of(joints, controller, Steps::kNone).largest) {
    EXPECT_LT(error, 0.02);
  }
}

TEST_P(Control, TracksThemSoAlsoInTheStepsOfPucks) {
  const auto [joints, controller] = GetParam();
  for (const double error : tracking_of(joints, controller, Steps::kOfPucks).largest) {
    EXPECT_LT(error, 0.02);
  }
}

TEST_P(Control, BringsTheArmToRestAfterAPush) {
  Robot robot({.joints = std::get<0>(GetParam()), .controller = std::get<1>(GetParam())});
  for (int i = 0; i < 250; ++i) robot.cycle();
  robot.set("Reference", "jointPosition", tour(robot.joints()).front());
  ASSERT_TRUE(robot.call("Reference", "moveToRefOperation"));
  for (int i = 0; i < 3000; ++i) robot.cycle();
  const Vector before = robot.positions();
  robot.bench().arm().set_state(before, Vector(robot.joints(), 0.1));
  for (int i = 0; i < 1500; ++i) robot.cycle();
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    EXPECT_NEAR(robot.positions()[i], before[i], 1e-3) << "joint " << i + 1;
    EXPECT_NEAR(robot.bench().arm().joint_velocity(i), 0.0, 1e-3) << "joint " << i + 1;
  }
}

TEST_P(Control, HoldsTheArmWhereItIsAtTheStart) {
  Robot robot({.joints = std::get<0>(GetParam()),
               .controller = std::get<1>(GetParam()),
               .overrides = {"Sensor.start=" + text_of(tour(7)[1], std::get<0>(GetParam()))}});
  for (int i = 0; i < 1000; ++i) robot.cycle();
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    EXPECT_NEAR(robot.positions()[i], tour(robot.joints())[1][i], 0.005) << "joint " << i + 1;
  }
}

class Compared : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Wam, Compared, ::testing::Values(4, 7));

TEST_P(Compared, ComputedTorqueTracksEachJointThreeTimesAsWellAsThePids) {
  const Tracking& pids = tracking_of(GetParam(), "npid", Steps::kNone);
  const Tracking& computed = tracking_of(GetParam(), "computed_torque", Steps::kNone);
  for (std::size_t i = 0; i < pids.largest.size(); ++i) {
    EXPECT_LT(3.0 * computed.largest[i], pids.largest[i]) << "joint " << i + 1;
    EXPECT_LT(3.0 * computed.absolute[i], pids.absolute[i]) << "joint " << i + 1;
  }
}

TEST_P(Compared, ComputedTorqueIsAsMuchBetterInTheStepsOfPucks) {
  const Tracking& pids = tracking_of(GetParam(), "npid", Steps::kOfPucks);
  const Tracking& computed = tracking_of(GetParam(), "computed_torque", Steps::kOfPucks);
  for (std::size_t i = 0; i < pids.largest.size(); ++i) {
    EXPECT_LT(3.0 * computed.largest[i], pids.largest[i]) << "joint " << i + 1;
    EXPECT_LT(3.0 * computed.absolute[i], pids.absolute[i]) << "joint " << i + 1;
  }
}

TEST_P(Compared, TheDeploymentsMotorsAreThoseOfTheNumbers) {
  Robot robot({.joints = GetParam(), .controller = "computed_torque"});
  const ArmNumbers& arm = arm_of(GetParam());
  EXPECT_EQ(robot.value<Vector>("Controller", "motor_turns"), arm.transmission.turns);
  EXPECT_EQ(robot.value<Vector>("Controller", "motor_rotor_inertia"),
            arm.transmission.rotor_inertia);
  const auto friction = robot.value<Vector>("Controller", "motor_viscous_friction");
  for (std::size_t i = 0; i < arm.joints(); ++i) {
    const double expected = arm.transmission.viscous_friction[i];
    EXPECT_NEAR(friction[i], expected, 1e-4 * expected);
  }
}

TEST_P(Compared, TheDeploymentsGainsAreTheVendorsOfOneSample) {
  Robot robot({.joints = GetParam(), .controller = "npid"});
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    const JointGains& vendors = arm_of(GetParam()).gains[i];
    const std::string pid = "PID" + std::to_string(i + 1);
    EXPECT_EQ(robot.value<double>(pid.c_str(), "Kp"), vendors.kp);
    EXPECT_NEAR(robot.value<double>(pid.c_str(), "Ki"), vendors.ki * 0.002, 1e-12);
    EXPECT_NEAR(robot.value<double>(pid.c_str(), "Kd"), vendors.kd / 0.002, 1e-9);
    // The motor of joint 7 gives less than the vendor asks for.
    const double most = i == 6 ? 1.3 : vendors.max_torque;
    EXPECT_EQ(robot.value<double>(pid.c_str(), "UMax"), most);
  }
}

TEST(Motion, BeyondAStopIsRefusedByTheGeneratorWithTheReason) {
  Robot robot({.joints = 4, .controller = "npid"});
  for (int i = 0; i < 250; ++i) robot.cycle();
  robot.set("Reference", "jointPosition", Vector{0.0, 0.0, 0.0, 3.2});
  auto motion = robot.application().begin("Reference", "moveToRefOperation", {});
  ASSERT_TRUE(motion) << motion.error();
  for (int i = 0; i < 5; ++i) robot.cycle();
  EXPECT_EQ(motion.value().stage(), component::CommandStage::kFailed);
  EXPECT_THAT(std::string(motion.value().reason()),
              HasSubstr("axis 4: a target is outside the limits of its axis: 3.2"));
}

}  // namespace
}  // namespace armature::wam
