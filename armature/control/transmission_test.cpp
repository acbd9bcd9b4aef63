// SPDX-License-Identifier: Apache-2.0
#include "armature/control/transmission.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::Pointwise;
using Vector = std::vector<double>;

/// Two motors drive two joints by their sum and difference, a third one by a gear that reverses.
Transmission differential() {
  auto made = Transmission::make(
      {.turns = {10.0, -5.0, 0.0, 10.0, 5.0, 0.0, 0.0, 0.0, -20.0}, .rotor_inertia = {1, 3, 2}});
  EXPECT_TRUE(made.ok()) << made.error();
  return made.value();
}

TEST(Transmission, TheMotorsOfADifferentialTurnWithBothJoints) {
  Vector motors(3), joints(3);
  differential().motor_angles(Vector{0.1, 0.2, 0.3}, motors);
  EXPECT_THAT(motors, Pointwise(DoubleNear(1e-15), Vector{0.0, 2.0, -6.0}));
  differential().joint_angles(motors, joints);
  EXPECT_THAT(joints, Pointwise(DoubleNear(1e-15), Vector{0.1, 0.2, 0.3}));
}

TEST(Transmission, TheTorquesOfADifferentialAddUpToOneJointAndCancelAtTheOther) {
  Vector joints(3), motors(3);
  differential().joint_torques(Vector{1.0, 1.0, 0.5}, joints);
  EXPECT_THAT(joints, Pointwise(DoubleNear(1e-15), Vector{20.0, 0.0, -10.0}));
  differential().motor_torques(joints, motors);
  EXPECT_THAT(motors, Pointwise(DoubleNear(1e-15), Vector{1.0, 1.0, 0.5}));
}

TEST(Transmission, LosesNoPower) {
  const Vector rates{0.3, -0.7, 1.1}, torques{2.0, -1.0, 0.4};
  Vector motor_rates(3), motor_torques(3);
  differential().motor_angles(rates, motor_rates);
  differential().motor_torques(torques, motor_torques);
  double at_joints = 0.0, at_motors = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    at_joints += rates[i] * torques[i];
    at_motors += motor_rates[i] * motor_torques[i];
  }
  EXPECT_NEAR(at_motors, at_joints, 1e-14);
}

TEST(Transmission, UnequalRotorsCoupleTheJointsOfADifferential) {
  const Transmission transmission = differential();
  EXPECT_EQ(transmission.rotor_inertia(0, 0), 100.0 * (1.0 + 3.0));
  EXPECT_EQ(transmission.rotor_inertia(1, 1), 25.0 * (1.0 + 3.0));
  EXPECT_EQ(transmission.rotor_inertia(0, 1), 50.0 * (3.0 - 1.0));
  EXPECT_EQ(transmission.rotor_inertia(1, 0), transmission.rotor_inertia(0, 1));
  EXPECT_EQ(transmission.rotor_inertia(2, 2), 400.0 * 2.0);
  Vector torques{1.0, 2.0, 3.0};
  transmission.add_rotor_torques(Vector(3, 0.0), Vector{1.0, 0.0, 2.0}, torques);
  EXPECT_THAT(torques, Pointwise(DoubleNear(1e-12), Vector{401.0, 102.0, 1603.0}));
}

TEST(Transmission, TheFrictionOfTheMotorsIsThatOfTheirRates) {
  const Transmission transmission = Transmission::make({.turns = {10.0, -5.0, 10.0, 5.0},
                                                        .rotor_inertia = {0.0, 0.0},
                                                        .viscous_friction = {0.01, 0.03}})
                                        .value();
  const Vector rates{0.3, -0.7};
  Vector torques(2, 1.0), motors(2), expected(2);
  transmission.add_rotor_torques(rates, Vector(2, 5.0), torques);
  transmission.motor_angles(rates, motors);
  motors[0] *= 0.01;
  motors[1] *= 0.03;
  transmission.joint_torques(motors, expected);
  EXPECT_NEAR(torques[0], 1.0 + expected[0], 1e-14);
  EXPECT_NEAR(torques[1], 1.0 + expected[1], 1e-14);
}

TEST(Transmission, AGearForEachJointIsItsDiagonal) {
  const auto made = Transmission::make({.turns = {10.0, -5.0}, .rotor_inertia = {1.0, 2.0}});
  ASSERT_TRUE(made.ok()) << made.error();
  EXPECT_EQ(made.value().rotor_inertia(1, 1), 50.0);
  EXPECT_EQ(made.value().rotor_inertia(0, 1), 0.0);
}

TEST(Transmission, RefusesWhatCannotBeAndSaysWhatWasExpected) {
  const auto mistake = [](const Transmission::Config& config) {
    return Transmission::make(config).error();
  };
  EXPECT_THAT(mistake({}), HasSubstr("rotor_inertia is empty"));
  EXPECT_EQ(mistake({.turns = {1, 2, 3}, .rotor_inertia = {0, 0}}),
            "Transmission: turns has 3 numbers, expected 4, a row of 2 for each motor, or the 2 of "
            "the diagonal");
  EXPECT_THAT(mistake({.turns = {1, 2, 2, 4}, .rotor_inertia = {0, 0}}),
              HasSubstr("turns has no inverse"));
  EXPECT_THAT(mistake({.turns = {std::numeric_limits<double>::infinity()}, .rotor_inertia = {0}}),
              HasSubstr("turns has no inverse"));
  EXPECT_THAT(mistake({.turns = {1}, .rotor_inertia = {-1}}), HasSubstr("below 0"));
  EXPECT_EQ(mistake({.turns = {1}, .rotor_inertia = {1}, .viscous_friction = {1, 2}}),
            "Transmission: viscous_friction is expected to be 1 finite numbers of at least 0, or "
            "none");
}

}  // namespace
}  // namespace armature::control
