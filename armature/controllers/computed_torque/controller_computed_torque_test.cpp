// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/computed_torque/controller_computed_torque.hpp"

#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using ::testing::HasSubstr;

using Vector = std::vector<double>;
constexpr double kPeriod = 0.002;

/// On the head of the model's test, whose weight and inertia about its tilt axis these are.
class ComputedTorque : public ::testing::Test {
 protected:
  ComputedTorque() {
    controller.set("joints", 2);
    controller.set("robot_description", std::string_view(TESTDATA "/pan_tilt.urdf"));
    controller.set("Period", kPeriod);
    controller.set("Kp", "[100, 400]");
    controller.set("Kd", "[20, 40]");
    controller.set("motor_rotor_inertia", "[1e-5, 2e-5]");
  }
  void start() { ASSERT_TRUE(controller.start()) << controller.reason(); }
  const Vector& act() { return controller.output<Vector>("act"); }
  static double weight(double tilt) { return 1.1 * 9.81 * 0.08 * std::cos(tilt); }
  static constexpr double kTilting = 0.006 + 1.1 * 0.08 * 0.08;

  testing::Harness controller{std::make_unique<ControllerComputedTorque>("Controller")};
};

TEST_F(ComputedTorque, DrivesTheTorqueOfTheWantedAcceleration) {
  controller.set("motor_turns", "[100, 50]");
  controller.set("motor_viscous_friction", "[1e-4, 3e-4]");
  start();
  controller.write("reference", Vector{0.3, 0.7, 0.0, 0.5, 0.0, 2.0});
  // The tilt joint moves with 0.1 rad/s, which the first sample takes for settled.
  controller.raise("Sample");
  controller.write("sensor", Vector{0.3, 0.65, 0.0, 0.1 * kPeriod});
  const double acceleration = 2.0 + 40.0 * (0.5 - 0.1) + 400.0 * (0.7 - 0.65);
  const double friction = 3e-4 * 50 * 50 * 0.5;
  EXPECT_NEAR(act()[1], (kTilting + 2e-5 * 50 * 50) * acceleration + weight(0.65) + friction,
              1e-12);
  EXPECT_NEAR(act()[0], 0.0, 1e-12);
}

TEST_F(ComputedTorque, TheMotorsOfADifferentialMayCoupleTheJoints) {
  controller.set("motor_turns", "[50, 50, -50, 50]");
  start();
  controller.write("reference", Vector{0.0, 0.7, 0.0, 0.0, 0.0, 2.0});
  controller.raise("Sample");
  controller.write("sensor", Vector{0.0, 0.7, 0.0, 0.0});
  EXPECT_NEAR(act()[0], 50 * 50 * (1e-5 - 2e-5) * 2.0, 1e-12);
}

TEST_F(ComputedTorque, DrivesNothingBeforeAReference) {
  controller.set("motor_turns", "[100]");
  start();
  controller.raise("Sample");
  controller.write("sensor", Vector{0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(controller.writes("act"), 0u);
}

TEST_F(ComputedTorque, TheErrorOfTheVelocityIsBehindALowPass) {
  controller.set("motor_turns", "[1]");
  controller.set("gravity", "[0, 0, 0]");
  start();
  controller.write("reference", Vector{0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  controller.raise("Sample");
  controller.write("sensor", Vector{0.0, 0.0, 0.0, 0.0});
  controller.raise("Sample");
  controller.write("sensor", Vector{0.0, 0.0, 0.0, kPeriod});
  const double velocity = 180.0 * kPeriod / (1.0 + 180.0 * kPeriod);
  EXPECT_NEAR(act()[1], -(kTilting + 2e-5) * 40.0 * velocity, 1e-12);
}

TEST_F(ComputedTorque, AGainThatChangedWhileItWasStoppedCounts) {
  controller.set("motor_turns", "[1]");
  controller.set("gravity", "[0, 0, 0]");
  start();
  controller.stop();
  controller.set("Kp", "[1000]");
  start();
  controller.write("reference", Vector{0.0, 0.1, 0.0, 0.0, 0.0, 0.0});
  controller.raise("Sample");
  controller.write("sensor", Vector{0.0, 0.0, 0.0, 0.0});
  EXPECT_NEAR(act()[1], (kTilting + 2e-5) * 100.0, 1e-12);
}

TEST_F(ComputedTorque, ANumberThatIsNotFiniteIsAFaultAndDrivesNothing) {
  controller.set("motor_turns", "[1]");
  start();
  controller.write("reference", Vector{0.0, std::nan(""), 0.0, 0.0, 0.0, 0.0});
  controller.raise("Sample");
  controller.write("sensor", Vector{0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(controller.state(), component::State::kException);
  EXPECT_THAT(controller.reason(), HasSubstr("is nan, expected finite numbers in reference"));
  EXPECT_EQ(controller.writes("act"), 0u);
}

TEST_F(ComputedTorque, RefusesWhatCannotBeSayingWhatWasExpected) {
  controller.set("motor_turns", "[1, 2, 3]");
  EXPECT_FALSE(controller.start());
  EXPECT_THAT(controller.reason(), HasSubstr("turns has 3 numbers, expected 4"));
  controller.set("motor_turns", "[1]");
  controller.set("Kd", "[1, 2, 3]");
  EXPECT_FALSE(controller.start());
  EXPECT_THAT(controller.reason(), HasSubstr("Kd: found 3 numbers, expected 2"));
  controller.set("Kd", "[1]");
  controller.set("robot_description", std::string_view("nowhere.urdf"));
  EXPECT_FALSE(controller.start());
  EXPECT_THAT(controller.reason(), HasSubstr("nowhere.urdf: error: cannot be read"));
}

}  // namespace
}  // namespace armature::controllers
