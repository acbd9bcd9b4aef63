// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/arm_simulation.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::Pointwise;

class Simulated : public ::testing::TestWithParam<const ArmNumbers*> {
 protected:
  ArmSimulation make(ArmSimulation::Config config = {}) const {
    config.urdf_file = description_of(arm);
    auto made = ArmSimulation::load(arm, config);
    EXPECT_TRUE(made.ok()) << made.error();
    return std::move(made).value();
  }
  Vector positions(const ArmSimulation& simulation) const {
    Vector result;
    for (std::size_t i = 0; i < arm.joints(); ++i) result.push_back(simulation.joint_position(i));
    return result;
  }
  Vector velocities(const ArmSimulation& simulation) const {
    Vector result;
    for (std::size_t i = 0; i < arm.joints(); ++i) result.push_back(simulation.joint_velocity(i));
    return result;
  }
  void drive(ArmSimulation& simulation, const Vector& joint_torques) const {
    Vector torques(arm.joints());
    transmission.motor_torques(joint_torques, torques);
    for (std::size_t i = 0; i < arm.joints(); ++i) simulation.set_torque(i, torques[i]);
  }

  const ArmNumbers& arm = *GetParam();
  control::InverseDynamics links = dynamics_of(arm);
  control::Transmission transmission = transmission_of(arm);
};
INSTANTIATE_TEST_SUITE_P(Wam, Simulated, ::testing::Values(&wam4(), &wam7()), name_of_arm);

TEST_P(Simulated, IsAtHomeAtTheBeginningAndItsMotorsAreWhereTheFactsHaveThem) {
  const ArmSimulation simulation = make();
  EXPECT_EQ(positions(simulation), arm.home);
  EXPECT_NEAR(simulation.angle(1), -56.5, 1e-12);
  EXPECT_NEAR(simulation.angle(2), 56.5, 1e-12);
  EXPECT_NEAR(simulation.angle(3), -56.34, 1e-12);
  EXPECT_EQ(simulation.rate(3), 0.0);
}

// With its motors' inertia, also between the joints of a differential; the bound is that of the
// principal axes of inertia that MuJoCo computes.
TEST_P(Simulated, AcceleratesAsItsDynamicsAndRotorsSay) {
  ArmSimulation simulation = make();
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random = [&](double range) {
    Vector numbers(arm.joints());
    for (double& number : numbers) number = range * uniform(engine);
    return numbers;
  };
  for (int i = 0; i < 200; ++i) {
    const Vector q = random(0.8), qd = random(2.0), qdd = random(10.0);
    Vector motion = q, torques(arm.joints());
    motion.insert(motion.end(), qd.begin(), qd.end());
    motion.insert(motion.end(), qdd.begin(), qdd.end());
    ASSERT_TRUE(links.step(motion, torques));
    transmission.add_rotor_torques(qd, qdd, torques);
    simulation.set_state(q, qd);
    drive(simulation, torques);
    simulation.advance(100us);
    Vector acceleration = velocities(simulation);
    for (std::size_t j = 0; j < arm.joints(); ++j)
      acceleration[j] = (acceleration[j] - qd[j]) / 1e-4;
    EXPECT_THAT(acceleration, Pointwise(DoubleNear(1e-4), qdd));
  }
}

TEST_P(Simulated, ExactCompensationOfGravityHoldsItStillWithoutFrictionAnywhere) {
  const Vector middle{0.3, -0.7, 0.4, 1.2, -0.5, 0.6, 0.2};
  const Vector stretched{-2.0, 1.9, 2.5, -0.8, 1.0, -1.5, 2.8};
  for (const Vector& all : {middle, stretched}) {
    const Vector start(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(arm.joints()));
    ArmSimulation simulation = make({.start = start, .motor_friction = false});
    Vector torques(arm.joints());
    for (int cycle = 0; cycle < 5000; ++cycle) {
      ASSERT_TRUE(links.gravity(positions(simulation), torques));
      drive(simulation, torques);
      simulation.advance(2ms);
    }
    EXPECT_LT(largest_difference(positions(simulation), start), 1e-9);
  }
}

TEST_P(Simulated, MotorsThatDoNotDriveBrakeAndTheArmSinksSlowly) {
  Vector level(arm.joints(), 0.0);
  level[1] = 1.0;
  ArmSimulation braked = make({.start = level});
  braked.advance(1s);
  // Where gravity is all that its shoulder's two motors brake.
  Vector torques(arm.joints());
  ASSERT_TRUE(links.gravity(positions(braked), torques));
  const double braking = 0.457 * 0.457 / 3.473 + 7.549e-5 * 60.0 / (2.0 * M_PI);
  const double expected = -torques[1] / (2.0 * 28.25 * 28.25 * braking);
  EXPECT_NEAR(braked.joint_velocity(1), expected, 0.03 * expected);

  ArmSimulation driven = make({.start = level});
  for (std::size_t i = 0; i < arm.joints(); ++i) driven.set_torque(i, 0.0);
  driven.advance(200ms);
  EXPECT_GT(driven.joint_velocity(1), 5.0 * braked.joint_velocity(1)) << "it falls";
  for (std::size_t i = 0; i < arm.joints(); ++i) driven.brake(i);
  driven.advance(200ms);
  EXPECT_LT(driven.joint_velocity(1), 2.0 * expected);
}

TEST_P(Simulated, TheJointsStopAtTheEndsOfTheirRange) {
  ArmSimulation simulation = make({.start = Vector(arm.joints(), 0.0)});
  Vector torques(arm.joints(), 0.0);
  torques[0] = 5.0;
  torques[3] = 10.0;
  drive(simulation, torques);
  simulation.advance(10s);
  EXPECT_NEAR(simulation.joint_position(0), 2.6, 0.01);
  EXPECT_NEAR(simulation.joint_position(3), 3.1416, 0.01);
}

TEST_P(Simulated, CoulombFrictionHoldsAtRest) {
  ArmSimulation simulation =
      make({.start = Vector(arm.joints(), 0.0), .coulomb_friction = Vector(arm.joints(), 0.5)});
  Vector torques(arm.joints(), 0.0);
  torques[0] = 0.49;
  Vector gravity(arm.joints());
  ASSERT_TRUE(links.gravity(positions(simulation), gravity));
  for (std::size_t i = 0; i < arm.joints(); ++i) torques[i] += gravity[i];
  drive(simulation, torques);
  simulation.advance(2s);
  EXPECT_NEAR(simulation.joint_position(0), 0.0, 1e-6);
}

TEST_P(Simulated, AnglesAndRatesOfTheMotorsFollowTheJoints) {
  ArmSimulation simulation = make();
  for (std::size_t i = 0; i < arm.joints(); ++i) simulation.set_torque(i, 0.01);
  simulation.advance(100ms);
  Vector angles(arm.joints()), rates(arm.joints());
  transmission.motor_angles(positions(simulation), angles);
  transmission.motor_angles(velocities(simulation), rates);
  for (std::size_t i = 0; i < arm.joints(); ++i) {
    EXPECT_EQ(simulation.angle(i), angles[i]);
    EXPECT_EQ(simulation.rate(i), rates[i]);
  }
  EXPECT_GT(largest(rates), 0.1);
}

TEST_P(Simulated, HowTimeIsDividedChangesNothing) {
  ArmSimulation often = make(), once = make();
  for (ArmSimulation* each : {&often, &once}) each->set_torque(0, 0.3);
  for (int i = 0; i < 1000; ++i) often.advance(130us);
  once.advance(130ms);
  EXPECT_EQ(positions(often), positions(once));
}

TEST_P(Simulated, StandsStillAndSaysSoWhenItsNumbersHaveDiverged) {
  ArmSimulation simulation = make();
  simulation.set_torque(0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(simulation.advance(1s), sim::PlantStatus::kDiverged);
  EXPECT_EQ(positions(simulation), arm.home);
}

TEST_P(Simulated, AllocatesNothingWhileItSteps) {
  ArmSimulation simulation = make();
  testing::RealtimeGuard guard;
  const auto violations = guard.watch([&] {
    for (int i = 0; i < 50; ++i) {
      simulation.set_torque(0, 0.1 * i);
      if (i % 10 == 5) simulation.brake(0);
      simulation.advance(2ms);
    }
  });
  EXPECT_EQ(violations, 0u) << guard.report();
}

TEST(SimulatedArm, RefusesAnotherRobotsFileAndOtherNumbersOfJoints) {
  EXPECT_EQ(ArmSimulation::load(wam7(), {.urdf_file = "/nowhere/wam7.urdf"}).error(),
            "/nowhere/wam7.urdf: cannot be read, expected a URDF file");
  EXPECT_THAT(ArmSimulation::load(wam4(), {.urdf_file = description_of(wam7())}).error(),
              HasSubstr("wam7.urdf: expected the moving joints joint1 to joint4, in this order"));
  EXPECT_THAT(ArmSimulation::load(wam7(), {.urdf_file = description_of(wam4())}).error(),
              HasSubstr("wam4.urdf: the armature of joint 'joint5' is given"));
  EXPECT_EQ(
      ArmSimulation::load(wam4(), {.urdf_file = description_of(wam4()), .start = {1.0}}).error(),
      "ArmSimulation: start has 1 numbers, expected 4, one for each joint");
}

TEST(SimulatedArm, RefusesToBeginBeyondItsStopsOrNowhere) {
  const auto begin_at = [](double angle) {
    return ArmSimulation::load(
        wam4(), {.urdf_file = description_of(wam4()), .start = {0.0, -2.0, 0.0, angle}});
  };
  EXPECT_TRUE(begin_at(3.13).ok());
  EXPECT_THAT(begin_at(5.0).error(),
              HasSubstr("start has 5.000000 rad for joint 4, expected from"));
  EXPECT_THAT(begin_at(std::numeric_limits<double>::quiet_NaN()).error(), HasSubstr("nan rad"));
}

}  // namespace
}  // namespace armature::wam
