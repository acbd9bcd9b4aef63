// SPDX-License-Identifier: Apache-2.0
// The controllers that know the robot's dynamics: ComputedTorque and GravityPd.
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/control/dynamics/computed_torque.hpp"
#include "armature/control/dynamics/gravity_pd.hpp"

namespace armature::control {
namespace {

using ::testing::HasSubstr;

using Vector = std::vector<double>;
constexpr double kMoment = 2.0 * 9.81 * 0.5;         // of gravity where the rod is level
constexpr double kInertia = 0.01 + 2.0 * 0.5 * 0.5;  // about the axis

/// A rod that hangs down at 0, and turns about y.
constexpr const char* kPendulum = R"(<robot name="pendulum"><link name="base"/>
  <joint name="swing" type="continuous"><parent link="base"/><child link="rod"/>
    <axis xyz="0 1 0"/></joint>
  <link name="rod"><inertial><origin xyz="0 0 -0.5"/><mass value="2"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)";

InverseDynamics links() {
  base::Diagnostics diagnostics;
  auto made = InverseDynamics::parse(kPendulum, "pendulum.urdf", {}, diagnostics);
  EXPECT_TRUE(made.has_value()) << diagnostics.to_text();
  return std::move(made.value());
}

Transmission rotor(double inertia) {
  return Transmission::make(
             {.turns = {10.0}, .rotor_inertia = {inertia}, .viscous_friction = {0.003}})
      .value();
}

TEST(ComputedTorque, IsTheTorqueOfTheWantedAccelerationWhereTheRobotIs) {
  auto control = ComputedTorque::make(links(), rotor(0.002), {.kp = {100.0}, .kd = {20.0}});
  ASSERT_TRUE(control.ok()) << control.error();
  Vector torque(1);
  ASSERT_TRUE(control.value().step(Vector{0.5, 0.3, 2.0}, Vector{0.4, 0.1}, torque));
  const double acceleration = 2.0 + 20.0 * (0.3 - 0.1) + 100.0 * (0.5 - 0.4);
  EXPECT_NEAR(torque[0], (kInertia + 0.2) * acceleration + kMoment * std::sin(0.4) + 0.3 * 0.3,
              1e-12);
}

TEST(ComputedTorque, TakesAnErrorAwayAsItsGainsSay) {
  auto control = ComputedTorque::make(links(), rotor(0.0), {.kp = {25.0}, .kd = {10.0}}).value();
  constexpr double kStep = 1e-4;
  double q = 0.0, qd = 0.0;
  Vector torque(1);
  for (int i = 0; i < 10'000; ++i) {
    control.step(Vector{1.0, 0.0, 0.0}, Vector{q, qd}, torque);
    qd += kStep * (torque[0] - kMoment * std::sin(q)) / kInertia;
    q += kStep * qd;
  }
  EXPECT_NEAR(q, 1.0 - (1.0 + 5.0) * std::exp(-5.0), 1e-3) << "critically damped, after 1 s";
}

TEST(ComputedTorque, WhatIsNoNumberIsNotHidden) {
  auto control = ComputedTorque::make(links(), rotor(0.0), {.kp = {1.0}, .kd = {1.0}}).value();
  Vector torque(1);
  control.step(Vector{std::nan(""), 0.0, 0.0}, Vector{0.0, 0.0}, torque);
  EXPECT_FALSE(std::isfinite(torque[0]));
}

TEST(GravityPd, HoldsWhereItIsAndPullsBackWhereItIsNot) {
  auto control = GravityPd::make(links(), {.kp = {30.0}, .kd = {4.0}});
  ASSERT_TRUE(control.ok()) << control.error();
  Vector torque(1);
  ASSERT_TRUE(control.value().step(Vector{0.7, 0.0, 0.0}, Vector{0.7, 0.0}, torque));
  EXPECT_NEAR(torque[0], kMoment * std::sin(0.7), 1e-12);
  ASSERT_TRUE(control.value().step(Vector{0.5, 0.3, 2.0}, Vector{0.4, 0.1}, torque));
  EXPECT_NEAR(torque[0], kMoment * std::sin(0.4) + 30.0 * 0.1 + 4.0 * 0.2, 1e-12);
}

TEST(ModelBased, VectorsOfAnotherSizeAreRefused) {
  auto computed = ComputedTorque::make(links(), rotor(0.0), {.kp = {1.0}, .kd = {1.0}}).value();
  auto gravity = GravityPd::make(links(), {.kp = {1.0}, .kd = {1.0}}).value();
  Vector torque(1, 7.0);
  const auto refused = [&torque](auto& control) {
    return !control.step(Vector(2), Vector(2), torque) &&
           !control.step(Vector(3), Vector(3), torque);
  };
  EXPECT_TRUE(refused(computed));
  EXPECT_TRUE(refused(gravity));
  EXPECT_EQ(torque[0], 7.0);
}

TEST(ModelBased, GainsThatCannotBeAreNamed) {
  EXPECT_EQ(GravityPd::make(links(), {.kp = {1.0, 2.0}, .kd = {-1.0}}).error(),
            "GravityPd: kp has 2 numbers, expected 1, one for each joint; kd of joint 1 is "
            "-1.000000, expected a finite number of at least 0");
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_THAT(ComputedTorque::make(links(), rotor(0.0), {.kp = {infinite}, .kd = {1.0}}).error(),
              HasSubstr("kp of joint 1 is inf"));
  auto two = Transmission::make({.turns = {1.0, 1.0}, .rotor_inertia = {0.0, 0.0}}).value();
  EXPECT_EQ(ComputedTorque::make(links(), two, {.kp = {1.0}, .kd = {1.0}}).error(),
            "ComputedTorque: rotors are for 2 joints, expected 1");
}

}  // namespace
}  // namespace armature::control
