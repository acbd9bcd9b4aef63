// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/torque_path.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using Mode = TorquePath::Mode;
using Result = TorquePath::Result;

constexpr double kBraking = 5.0;  // [rad/s^2]

TorquePath::Config config_of(const ArmNumbers& arm) {
  TorquePath::Config config;
  config.hold = arm.gains;
  for (std::size_t i = 0; i < arm.joints(); ++i) {
    config.limits.push_back({.lower = -2.0,
                             .upper = 3.2,
                             .max_velocity = 2.5,
                             .max_acceleration = kBraking,
                             .max_effort = 20.0,
                             .period = 2ms,
                             .arming_time = 1s,
                             .effort_rate = 20.0});
  }
  config.max_torque.assign(arm.joints(), 40.0);
  config.max_growth.assign(arm.joints(), 2.0);
  config.max_acceleration.assign(arm.joints(), kBraking);
  config.hand_over = 500ms;
  return config;
}

class TorquePathTest : public ::testing::Test {
 protected:
  void make(const TorquePath::Config& config) {
    auto made = TorquePath::make(config, transmission_of(arm), dynamics_of(arm));
    ASSERT_TRUE(made.ok()) << made.error();
    path.emplace(std::move(made).value());
    measure(posture);
  }
  void make() { make(config_of(arm)); }
  void measure(const Vector& positions, const Vector& velocities = Vector(4, 0.0)) {
    path->measure(positions, velocities);
  }
  void hold_for(int cycles) {
    for (int i = 0; i < cycles; ++i) path->step_hold(now += 2ms);
  }
  Result drive(const Vector& command) { return path->step_drive(command, now += 2ms); }
  Vector torques() const { return {path->joint_torques().begin(), path->joint_torques().end()}; }
  Vector weight() const { return {path->weight().begin(), path->weight().end()}; }
  double weight_of_joint_2() {
    make();
    return weight()[1];
  }
  void arm_it() {
    path->begin_to_hold();
    hold_for(100);
    ASSERT_TRUE(path->begin_to_drive());
  }

  const ArmNumbers& arm = wam4();
  const Vector posture{0.3, 0.8, 0.2, 1.0};
  std::optional<TorquePath> path;
  base::Time now{};
};

TEST_F(TorquePathTest, OffAllTorquesAreZero) {
  make();
  path->begin_to_hold();
  hold_for(10);
  path->go_off();
  EXPECT_EQ(torques(), Vector(4, 0.0));
  EXPECT_FALSE(path->begin_to_drive()) << "only an arm that is held is driven";
}

TEST_F(TorquePathTest, HoldsTheWeightOfAnArmAtRest) {
  make();
  path->begin_to_hold();
  hold_for(100);
  EXPECT_LT(largest_difference(torques(), weight()), 1e-9);
  EXPECT_GT(largest(weight()), 5.0);
}

TEST_F(TorquePathTest, DrivesBackAJointThatWasPushed) {
  make();
  path->begin_to_hold();
  hold_for(10);
  Vector pushed = posture;
  pushed[0] += 0.01;
  measure(pushed);
  hold_for(10);
  EXPECT_NEAR(torques()[0], -9.0, 0.2) << "900 Nm/rad";
}

TEST_F(TorquePathTest, BrakesAMovingArmWithTheDeclaredAcceleration) {
  make();
  measure(posture, {1.0, 0.0, 0.0, 0.0});
  path->begin_to_hold();
  // A joint that follows: 1 rad/s is braked in 0.2 s, on 0.1 rad.
  Vector at = posture;
  for (int i = 1; i <= 100; ++i) {
    const double t = 0.002 * i;
    at[0] = posture[0] + t - 0.5 * kBraking * t * t;
    measure(at);
    hold_for(1);
    EXPECT_LT(std::abs(torques()[0]), 0.1) << "nothing has to be done about it";
  }
  EXPECT_NEAR(at[0], posture[0] + 0.1, 1e-9);
}

/// Whether it was measured before or after it was disarmed in a cycle.
TEST_F(TorquePathTest, BeginningToHoldAMovingArmMakesNoStep) {
  for (const bool measured_after : {false, true}) {
    make();
    const Vector rates{0.5, 0.0, 0.0, 0.0};
    Vector at = posture;
    measure(at, rates);
    path->begin_to_hold();
    Vector before;
    for (int i = 0; i < 10; ++i) {
      if (i > 0 || measured_after) at[0] += 0.5 * 0.002;
      if (i > 0 || measured_after) measure(at, rates);
      hold_for(1);
      if (i > 0) {
        EXPECT_LT(std::abs(torques()[0] - before[0]), 0.5) << i;
      }
      before = torques();
    }
  }
}

TEST_F(TorquePathTest, PassesACommandOnTopOfTheWeightOnceItHasGrown) {
  make();
  arm_it();
  const Vector command{3.0, -2.0, 1.0, 0.5};
  for (int i = 0; i < 600; ++i) drive(command);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(torques()[i], weight()[i] + command[i], 1e-9);
  Vector motors(4);
  transmission_of(arm).motor_torques(torques(), motors);
  EXPECT_EQ(Vector(path->motor_torques().begin(), path->motor_torques().end()), motors);
}

TEST_F(TorquePathTest, AfterArmingACommandGrowsSlowly) {
  make();
  arm_it();
  EXPECT_EQ(drive({10.0, 0.0, 0.0, 0.0}), Result::kClipped);
  EXPECT_NEAR(torques()[0], weight()[0], 1e-9) << "the first torque is that before";
  for (int i = 0; i < 200; ++i) {
    const double before = torques()[0];
    drive({10.0, 0.0, 0.0, 0.0});
    EXPECT_NEAR(torques()[0] - before, 0.02, 0.022) << "20 Nm in a second at most";
  }
  EXPECT_NEAR(torques()[0] - weight()[0], 200 * 0.04, 0.3);
  EXPECT_EQ(path->clipped(), 201);
}

/// It would be driven with until it has died away.
TEST_F(TorquePathTest, TheNoiseOfTheLastHeldTorqueIsNotTakenOver) {
  make();
  path->begin_to_hold();
  hold_for(100);
  Vector noisy = posture;
  noisy[0] += 1e-4;
  measure(noisy);
  hold_for(1);
  const double noise = torques()[0] - weight()[0];
  EXPECT_LT(noise, -0.3);
  measure(posture);
  path->begin_to_drive();
  drive(Vector(4, 0.0));
  EXPECT_LT(std::abs(torques()[0] - weight()[0]), 0.15 * std::abs(noise));
}

TEST_F(TorquePathTest, ACommandThatHoldsTheWeightIsJudgedWithoutIt) {
  TorquePath::Config config = config_of(arm);
  config.command_has_weight = true;
  make(config);
  arm_it();
  EXPECT_EQ(drive(weight()), Result::kPassed);
  EXPECT_LT(largest_difference(torques(), weight()), 1e-9);
}

TEST_F(TorquePathTest, WhatDrivesOnBeyondALimitIsCutAndTheWeightIsHeld) {
  make();
  arm_it();
  for (int i = 0; i < 1000; ++i) drive({5.0, 0.0, 0.0, 0.0});
  measure({3.19, 0.8, 0.2, 1.0}, {1.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(drive({5.0, 0.0, 0.0, 0.0}), Result::kClipped);
  EXPECT_LT(largest_difference(torques(), weight()), 1e-9);
  EXPECT_EQ(drive({-5.0, 0.0, 0.0, 0.0}), Result::kPassed) << "it brakes";
}

TEST_F(TorquePathTest, NoTorqueGrowsFasterThanDeclaredNorAboveTheLargest) {
  TorquePath::Config config = config_of(arm);
  for (auto& limits : config.limits) limits.arming_time = {};
  config.max_torque.assign(4, 15.0);
  config.hand_over = {};
  make(config);
  arm_it();
  Vector before = torques();
  for (int i = 0; i < 40; ++i) {
    drive(i < 20 ? Vector(4, 20.0) : Vector(4, -20.0));
    for (std::size_t joint = 0; joint < 4; ++joint) {
      EXPECT_LE(std::abs(torques()[joint]), 15.0);
      EXPECT_LE(std::abs(torques()[joint]) - std::abs(before[joint]), 2.0 + 1e-9);
    }
    before = torques();
  }
  EXPECT_NEAR(before[0], -15.0, 1e-9);
}

TEST_F(TorquePathTest, TowardsZeroATorqueMayGoAtOnce) {
  TorquePath::Config config = config_of(arm);
  for (auto& limits : config.limits) limits.arming_time = {};
  make(config);
  arm_it();
  for (int i = 0; i < 300; ++i) drive({18.0, 0.0, 0.0, 0.0});
  const double before = torques()[0];
  drive({1.0, 0.0, 0.0, 0.0});
  EXPECT_NEAR(before - torques()[0], 17.0, 1e-9);
}

TEST_F(TorquePathTest, GoingOverFromDrivingToHoldingAndBackMakesNoStep) {
  make();
  arm_it();
  for (int i = 0; i < 1000; ++i) drive({8.0, -4.0, 2.0, 1.0});
  Vector before = torques();
  path->begin_to_hold();
  for (int i = 0; i < 400; ++i) {
    if (i == 100) path->begin_to_drive();
    i < 100 ? path->step_hold(now += 2ms) : static_cast<void>(drive(Vector(4, 0.0)));
    EXPECT_LT(largest_difference(torques(), before), 0.08) << i;
    before = torques();
  }
  EXPECT_LT(largest_difference(torques(), weight()), 1e-9) << "what drove it has died away";
}

TEST_F(TorquePathTest, WhatIsNoNumberDrivesNothing) {
  make();
  arm_it();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 600; ++i) drive(Vector(4, 0.0));
  EXPECT_EQ(drive({0.0, nan, 0.0, 0.0}), Result::kNotFinite);
  EXPECT_LT(largest_difference(torques(), weight()), 1e-9);
  measure({nan, 0.0, 0.0, 0.0});
  EXPECT_EQ(drive(Vector(4, 0.0)), Result::kNotFinite);
}

TEST(TorquePathConfig, MistakesAreNamed) {
  const ArmNumbers& arm = wam4();
  const auto error_of = [&](auto change) {
    TorquePath::Config config = config_of(arm);
    change(config);
    const auto made = TorquePath::make(config, transmission_of(arm), dynamics_of(arm));
    return made.ok() ? std::string() : made.error();
  };
  EXPECT_THAT(error_of([](auto& config) { config.max_growth[1] = 0.0; }),
              HasSubstr("MaxTorqueGrowth has 0.000000, expected above 0"));
  EXPECT_THAT(error_of([](auto& config) { config.max_torque.pop_back(); }),
              HasSubstr("MaxTorque has 3 numbers, expected 4"));
  EXPECT_THAT(error_of([](auto& config) { config.limits[2].upper = -3.0; }), HasSubstr("joint 3"));
  EXPECT_THAT(error_of([](auto& config) { config.hold[3].kp = -1.0; }), HasSubstr("joint 4"));
}

TEST_F(TorquePathTest, ATorqueAboveItsLimitHasAllRefusedIfThatIsDeclared) {
  auto config = config_of(arm);
  config.over_limit = OverLimit::kRefuseAll;
  make(config);
  arm_it();
  EXPECT_NE(drive({5.0, 0.0, 0.0, 0.0}), Result::kRefused);
  const Vector before = torques();
  EXPECT_EQ(path->first_over_limit(Vector{5.0, 0.0, 21.0, 0.0}), 2u);
  EXPECT_EQ(drive({5.0, 0.0, 21.0, 0.0}), Result::kRefused);
  EXPECT_EQ(torques(), before) << "nothing has changed";
  EXPECT_NE(drive({5.0, 0.0, 19.0, 0.0}), Result::kRefused);
}

TEST_F(TorquePathTest, TheLimitWithTheWeightIsOneToo) {
  auto config = config_of(arm);
  config.over_limit = OverLimit::kRefuseAll;
  config.max_torque[1] = std::abs(weight_of_joint_2()) + 5.0;
  make(config);
  arm_it();
  const double down = std::copysign(1.0, weight()[1]);
  EXPECT_EQ(drive({0.0, 6.0 * down, 0.0, 0.0}), Result::kRefused);
  EXPECT_NE(drive({0.0, -6.0 * down, 0.0, 0.0}), Result::kRefused) << "against the weight";
}

TEST_F(TorquePathTest, ByDefaultATorqueAboveItsLimitIsCutAndTheOthersPass) {
  make();
  arm_it();
  for (int i = 0; i < 700; ++i) drive({1.0, 0.0, 21.0, 0.0});
  EXPECT_EQ(drive({1.0, 0.0, 21.0, 0.0}), Result::kClipped);
  EXPECT_NEAR(torques()[2] - weight()[2], 20.0, 1e-9);
  EXPECT_NEAR(torques()[0] - weight()[0], 1.0, 1e-9);
}

TEST_F(TorquePathTest, WeightlessNothingButTheWeightIsDrivenAndGoingOverMakesNoStep) {
  make();
  EXPECT_FALSE(path->begin_to_float()) << "off";
  path->begin_to_hold();
  hold_for(10);
  Vector pushed = posture;
  pushed[0] += 0.005;
  measure(pushed);
  hold_for(200);
  const Vector held = torques();
  EXPECT_GT(std::abs(held[0] - weight()[0]), 1.0);
  ASSERT_TRUE(path->begin_to_float());
  EXPECT_EQ(path->mode(), Mode::kWeightless);
  path->step_float(now += 2ms);
  EXPECT_LT(largest_difference(torques(), held), 0.1);
  for (int i = 0; i < 300; ++i) path->step_float(now += 2ms);
  EXPECT_LT(largest_difference(torques(), weight()), 1e-9);
  EXPECT_FALSE(path->begin_to_drive()) << "only an arm that is held is driven";
  path->begin_to_hold();
  EXPECT_TRUE(path->begin_to_drive());
}

}  // namespace
}  // namespace armature::wam
