// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dc_motor.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::HasSubstr;

/// A joint of Janus.
const DcMotor::Config kJanus{.resistance_ohm = 2.0,
                             .torque_constant = 0.035,
                             .gear_ratio = 100.0,
                             .viscous_friction = 0.02,
                             .coulomb_friction = 0.08,
                             .coulomb_velocity = 0.0,
                             .rotor_inertia = 1.2e-5};

DcMotor make(const DcMotor::Config& config) { return DcMotor::make(config).value(); }

TEST(DcMotor, AtRestItIsTheWindingAlone) {
  // 1 N m at the joint are 0.01 N m at the motor, 0.01 / 0.035 A, and twice that in volts.
  EXPECT_DOUBLE_EQ(make(kJanus).voltage(1.0, 0.0), 2.0 * 0.01 / 0.035);
  EXPECT_DOUBLE_EQ(make(kJanus).current(2.0, 0.0), 1.0);
}

TEST(DcMotor, WithoutTorqueItIsBackEmfAndFriction) {
  // 1 rad/s are 100 rad/s of the motor and 3.5 V; friction of 0.1 N m needs 0.1 * 2 / 3.5 V.
  EXPECT_DOUBLE_EQ(make(kJanus).voltage(0.0, 1.0), 3.5 + 0.1 * 2.0 / 3.5);
  EXPECT_DOUBLE_EQ(make(kJanus).voltage(0.0, -1.0), -(3.5 + 0.1 * 2.0 / 3.5));
}

TEST(DcMotor, CoulombFrictionRisesLinearlyBelowItsVelocity) {
  auto config = kJanus;
  config.viscous_friction = 0.0;
  config.coulomb_velocity = 0.01;
  const DcMotor motor = make(config);
  EXPECT_DOUBLE_EQ(motor.friction(0.0), 0.0);
  EXPECT_DOUBLE_EQ(motor.friction(0.005), 0.04);
  EXPECT_DOUBLE_EQ(motor.friction(-0.01), -0.08);
  EXPECT_DOUBLE_EQ(motor.friction(5.0), 0.08);
}

TEST(DcMotor, TheRotorWeighsMoreThanTheLinks) {
  EXPECT_DOUBLE_EQ(make(kJanus).reflected_inertia(), 0.12);
}

TEST(DcMotor, WhatIsNotFiniteIsHandedOn) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(make(kJanus).voltage(kNan, 0.0)));
  EXPECT_TRUE(std::isnan(make(kJanus).voltage(0.0, kNan)));
}

TEST(DcMotor, ARefusedConfigurationNamesEveryFieldThatIsWrong) {
  auto config = kJanus;
  config.gear_ratio = -100.0;
  config.viscous_friction = -0.02;
  const auto made = DcMotor::make(config);
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error(),
            "DcMotor: gear_ratio is -100, expected a finite number above 0; viscous_friction is "
            "-0.02, expected a finite number of at least 0");
  EXPECT_THAT(DcMotor::make({}).error(), HasSubstr("resistance_ohm is 0"));
}

TEST(DcMotor, TorqueIsTheInverseOfVoltage) {
  std::mt19937_64 random(4711);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 10'000; ++i) {
    const DcMotor motor = make({.resistance_ohm = 0.1 + 10.0 * share(random),
                                .torque_constant = 0.01 + share(random),
                                .gear_ratio = 1.0 + 200.0 * share(random),
                                .viscous_friction = share(random),
                                .coulomb_friction = share(random),
                                .coulomb_velocity = i % 2 == 0 ? 0.0 : share(random)});
    const double torque = 20.0 * share(random) - 10.0;
    const double velocity = i % 10 == 0 ? 0.0 : 4.0 * share(random) - 2.0;
    const double voltage = motor.voltage(torque, velocity);
    ASSERT_NEAR(motor.torque(voltage, velocity), torque, 1e-6);
    // Electrical power less copper losses is mechanical power, friction included.
    const double current = motor.current(voltage, velocity);
    const double mechanical = (torque + motor.friction(velocity)) * velocity;
    ASSERT_NEAR(voltage * current - motor.config().resistance_ohm * current * current, mechanical,
                1e-6 * (1.0 + std::abs(voltage * current)));
  }
}

}  // namespace
}  // namespace armature::control
