// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/controller_npid_ff/controller_npid_ff.hpp"

#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Vector = std::vector<double>;

class ControllerNpidFf : public ::testing::Test {
 protected:
  ControllerNpidFf() {
    controller.set("joints", 2);
    controller.set("motor_resistance", "[2.0, 1.0]");
    controller.set("motor_torque_constant", "[0.035]");
    controller.set("motor_gear_ratio", "[100, 50]");
    controller.set("motor_rotor_inertia", "[1.2e-5]");
    controller.set("viscous_friction", "[0.02]");
    controller.set("coulomb_friction", "[0.08, 0.04]");
  }
  void start() { ASSERT_TRUE(controller.start()) << controller.reason(); }
  void ask() {
    controller.write("reference", reference);
    controller.raise("Sample");
    controller.write("sensor", Vector{0.5, 0.6, 0.0, 0.0});
  }
  void answer(int pid, double out) { controller.write("Out" + std::to_string(pid), out); }
  const Vector& act() { return controller.output<Vector>("act"); }

  const Vector reference{1.0, 2.0, 0.3, -0.4, 5.0, 6.0};
  testing::Harness controller{std::make_unique<ControllerNPIDFF>("Controller")};
};

/// What a motor needs for `torque` at the joint while it turns with `velocity`.
double voltage(double resistance, double gear_ratio, double torque, double velocity) {
  constexpr double kTorqueConstant = 0.035;
  const double current = torque / (gear_ratio * kTorqueConstant);
  return resistance * current + kTorqueConstant * gear_ratio * velocity;
}

TEST_F(ControllerNpidFf, AddsTheVoltageOfTheModelsTorqueToThatOfThePids) {
  start();
  ask();
  EXPECT_THAT(controller.output<Vector>("In_model"), ElementsAre(1.0, 2.0, 0.3, -0.4, 5.0, 6.0));
  controller.write("Out_model", Vector{0.7, 0.9});
  answer(1, 0.25);
  EXPECT_EQ(controller.writes("act"), 0u);
  answer(2, -0.5);
  ASSERT_EQ(controller.writes("act"), 1u);
  const double first = 0.7 + 1.2e-5 * 100 * 100 * 5.0 + 0.02 * 0.3 + 0.08;
  const double second = 0.9 + 1.2e-5 * 50 * 50 * 6.0 - 0.02 * 0.4 - 0.04;
  EXPECT_NEAR(act()[0], 0.25 + voltage(2.0, 100.0, first, 0.3), 1e-12);
  EXPECT_NEAR(act()[1], -0.5 + voltage(1.0, 50.0, second, -0.4), 1e-12);
}

TEST_F(ControllerNpidFf, AsksTheModelBeforeThePids) {
  start();
  controller.write("reference", reference);
  EXPECT_EQ(controller.writes("In_model"), 0u);
  controller.raise("Sample");
  controller.write("sensor", Vector{0.5, 0.6, 0.0, 0.0});
  EXPECT_EQ(controller.writes("In_model"), 1u);
  EXPECT_EQ(controller.output<double>("Ref2"), 2.0);
}

TEST_F(ControllerNpidFf, UsesTheMotionOfTheRoundThoughTheReferenceWentOn) {
  start();
  ask();
  controller.write("Out_model", Vector{0.0, 0.0});
  answer(1, 0.0);
  controller.write("reference", Vector(6, 100.0));
  answer(2, 0.0);
  const double torque = 1.2e-5 * 100 * 100 * 5.0 + 0.02 * 0.3 + 0.08;
  EXPECT_NEAR(act()[0], voltage(2.0, 100.0, torque, 0.3), 1e-12);
}

TEST_F(ControllerNpidFf, AModelThatDoesNotAnswerIsNamedAndItsLastTorquesAreUsed) {
  start();
  ask();
  controller.write("Out_model", Vector{0.7, 0.9});
  answer(1, 0.0);
  answer(2, 0.0);
  const Vector before = act();
  ask();
  answer(1, 0.0);
  answer(2, 0.0);
  EXPECT_EQ(controller.writes("act"), 1u);
  ask();
  EXPECT_EQ(controller.get<component::Reason>("missing_names").view(), "Out_model");
  EXPECT_THAT(controller.get<std::vector<int>>("missing"), ElementsAre(0, 0, 1));
  answer(1, 0.0);
  answer(2, 0.0);
  EXPECT_EQ(controller.writes("act"), 2u);
  EXPECT_EQ(act(), before);
}

TEST_F(ControllerNpidFf, GivesAModelUpAfterTooManyRounds) {
  start();
  for (int round = 0; round < 4; ++round) {
    ask();
    answer(1, 0.0);
    answer(2, 0.0);
  }
  EXPECT_EQ(controller.state(), component::State::kException);
  EXPECT_EQ(controller.reason(), "Out_model (number 3) did not answer in 3 rounds in a row");
}

TEST_F(ControllerNpidFf, RefusesParametersOfAnotherNumberOfJoints) {
  controller.set("motor_gear_ratio", "[100, 50, 20]");
  EXPECT_FALSE(controller.start());
  EXPECT_EQ(controller.reason(),
            "motor_gear_ratio: found 3 numbers, expected 2, one for each joint, or one for all");
}

TEST_F(ControllerNpidFf, RefusesAMotorThatCannotBeNamingTheJoint) {
  controller.set("motor_resistance", "[2.0, 0.0]");
  EXPECT_FALSE(controller.start());
  EXPECT_THAT(controller.reason(),
              HasSubstr("joint 2: DcMotor: resistance_ohm is 0, expected a finite number above 0"));
}

TEST_F(ControllerNpidFf, AParameterThatChangedWhileItWasStoppedCounts) {
  start();
  controller.stop();
  controller.set("motor_resistance", "[0.0]");
  EXPECT_FALSE(controller.start());
  controller.set("motor_resistance", "[4.0]");
  start();
  ask();
  controller.write("Out_model", Vector{0.7, 0.9});
  answer(1, 0.0);
  answer(2, 0.0);
  const double torque = 0.7 + 1.2e-5 * 100 * 100 * 5.0 + 0.02 * 0.3 + 0.08;
  EXPECT_NEAR(act()[0], voltage(4.0, 100.0, torque, 0.3), 1e-12);
}

}  // namespace
}  // namespace armature::controllers
