// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/plant.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"

namespace armature::sim {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr double kGravity = 9.81;
constexpr double kMass = 2.0;
constexpr double kRadius = 0.1;
constexpr double kInertia = 0.03 + kMass * kRadius * kRadius;  // about the axis
constexpr double kWeight = kMass * kGravity * kRadius;         // torque where it is level

/// A pendulum about the horizontal, level at 0, with positive angles upwards; its arm carries a
/// wheel about the arm's axis, which passes through its centre of mass: gravity does not turn it.
std::string pendulum(double damping, double friction, const std::string& type = "revolute") {
  const std::string dynamics = "<dynamics damping='" + std::to_string(damping) + "' friction='" +
                               std::to_string(friction) + "'/>";
  return "<robot name='pendulum'><link name='base'/>"
         "<joint name='swing' type='" +
         type +
         "'><parent link='base'/><child link='arm'/><axis xyz='0 -1 0'/>"
         "<limit lower='-3' upper='3' effort='1' velocity='1'/>" +
         dynamics +
         "</joint><link name='arm'><inertial><origin xyz='0.1 0 0'/><mass value='2'/>"
         "<inertia ixx='0.03' iyy='0.03' izz='0.03' ixy='0' ixz='0' iyz='0'/></inertial></link>"
         "<joint name='spin' type='continuous'><parent link='arm'/><child link='wheel'/>"
         "<axis xyz='1 0 0'/>" +
         dynamics +
         "</joint><link name='wheel'><inertial><mass value='0.000001'/>"
         "<inertia ixx='0.01' iyy='0.00501' izz='0.00501' ixy='0' ixz='0' iyz='0'/></inertial>"
         "</link></robot>";
}

constexpr std::size_t kSwing = 0;
constexpr std::size_t kSpin = 1;
constexpr double kSpinInertia = 0.01;

Plant make(double damping, double friction, const Plant::Options& options = {}) {
  auto made = Plant::parse(pendulum(damping, friction), "pendulum", options);
  EXPECT_TRUE(made.ok()) << made.error();
  return std::move(made).value();
}

TEST(Plant, KnowsItsJointsByName) {
  const Plant plant = make(0.0, 0.0);
  EXPECT_EQ(plant.joints(), 2u);
  EXPECT_EQ(plant.name(kSwing), "swing");
  EXPECT_EQ(plant.find("spin"), kSpin);
  EXPECT_EQ(plant.find("wheel"), std::nullopt);
}

TEST(Plant, SwingsWithThePeriodOfAPendulum) {
  Plant plant = make(0.0, 0.0);
  constexpr double kAmplitude = 0.02;
  // The wheel turns with the arm.
  const double frequency = std::sqrt(kWeight / (kInertia + 0.00501));
  plant.set_state(kSwing, -std::numbers::pi / 2.0 + kAmplitude, 0.0);
  for (int i = 1; i <= 100; ++i) {
    plant.step(10ms);
    const double expected = kAmplitude * std::cos(frequency * 0.01 * i);
    ASSERT_NEAR(plant.position(kSwing) + std::numbers::pi / 2.0, expected, kAmplitude * 0.002);
  }
}

TEST(Plant, AFreeFallTurnsHeightIntoSpeedAndBack) {
  Plant plant = make(0.0, 0.0);
  plant.set_state(kSwing, -0.3, 0.0);
  double furthest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    plant.step(1ms);
    const double height = std::sin(plant.position(kSwing)) - std::sin(-0.3);
    const double v = plant.velocity(kSwing);
    ASSERT_NEAR(0.5 * (kInertia + 0.00501) * v * v, -kWeight * height, 2e-3 * kWeight);
    furthest = std::min(furthest, plant.position(kSwing));
  }
  EXPECT_NEAR(furthest, -std::numbers::pi + 0.3, 1e-3) << "it swings through to the other side";
}

TEST(Plant, AnArmatureAddsToTheInertiaOfItsJoint) {
  Plant::Options options;
  options.armature = {{"spin", 0.04}};
  Plant plant = make(0.0, 0.0, options);
  plant.set_effort(kSpin, 0.1);
  plant.step(1s);
  EXPECT_NEAR(plant.velocity(kSpin), 0.1 / (kSpinInertia + 0.04), 1e-6);
}

TEST(Plant, ACouplingIsAnEntryOfTheInertiaMatrix) {
  Plant::Options options;
  options.armature = {{"swing", 0.03}, {"spin", 0.02}};
  options.couplings = {{"spin", "swing", 0.015}};
  options.gravity = {0.0, 0.0, 0.0};
  Plant plant = make(0.0, 0.0, options);
  plant.set_effort(kSwing, 0.1);
  plant.set_effort(kSpin, -0.2);
  plant.step(options.inner_step);
  // Effort = matrix * acceleration. The axes of the two joints are at right angles.
  const double swing = plant.velocity(kSwing) / 1e-4, spin = plant.velocity(kSpin) / 1e-4;
  EXPECT_NEAR((kInertia + 0.00501 + 0.03) * swing + 0.015 * spin, 0.1, 1e-6);
  EXPECT_NEAR(0.015 * swing + (kSpinInertia + 0.02) * spin, -0.2, 1e-6);
}

TEST(Plant, ACouplingThatCannotBeIsRefused) {
  Plant::Options options;
  options.couplings = {{"swing", "wheel", 0.01}};
  EXPECT_EQ(Plant::parse(pendulum(0.0, 0.0), "pendulum", options).error(),
            "pendulum: the coupling of 'swing' and 'wheel' is expected to be a finite number "
            "between two joints of one chain");
}

TEST(Plant, GravityIsAnOption) {
  Plant::Options options;
  options.gravity = {0.0, 0.0, 5.0};
  Plant plant = make(0.0, 0.0, options);
  plant.step(options.inner_step);
  EXPECT_NEAR(plant.velocity(kSwing) / 1e-4, kMass * 5.0 * kRadius / (kInertia + 0.00501), 1e-6);
}

TEST(Plant, ViscousFrictionLimitsTheSpeedExponentially) {
  Plant plant = make(0.02, 0.0);
  plant.set_brake(kSwing, 100.0);
  plant.set_effort(kSpin, 0.1);
  for (int i = 1; i <= 30; ++i) {
    plant.step(100ms);
    const double expected = 0.1 / 0.02 * (1.0 - std::exp(-0.02 / kSpinInertia * 0.1 * i));
    ASSERT_NEAR(plant.velocity(kSpin), expected, 1e-3 * expected);
  }
}

TEST(Plant, CoulombFrictionStopsAJointWhereItsEnergyIsUsedUp) {
  Plant plant = make(0.0, 0.08);
  plant.set_brake(kSwing, 100.0);
  plant.set_state(kSpin, 0.0, 2.0);
  plant.step(1s);
  EXPECT_NEAR(plant.position(kSpin), 0.5 * kSpinInertia * 4.0 / 0.08, 2e-4);
  EXPECT_NEAR(plant.velocity(kSpin), 0.0, 1e-12);
}

TEST(Plant, AnEffortBeyondFrictionAcceleratesWithTheDifference) {
  Plant plant = make(0.0, 0.08);
  plant.set_brake(kSwing, 100.0);
  plant.set_effort(kSpin, 0.09);
  plant.step(1s);
  EXPECT_NEAR(plant.velocity(kSpin), 0.01 / kSpinInertia, 1e-4);
}

TEST(Plant, FrictionHoldsAJointAtRestAgainstLess) {
  Plant plant = make(0.02, 0.08);
  plant.set_brake(kSwing, 100.0);
  for (const double effort : {0.0799, -0.0799}) {
    plant.set_effort(kSpin, effort);
    plant.step(10s);
    EXPECT_NEAR(plant.position(kSpin), 0.0, 1e-7);
  }
}

TEST(Plant, ABrakeHoldsAgainstLessAndSlipsAgainstMore) {
  Plant plant = make(0.0, 0.0);
  plant.set_brake(kSwing, kWeight * 1.01);
  plant.step(10s);
  EXPECT_NEAR(plant.position(kSwing), 0.0, 1e-7);
  plant.set_brake(kSwing, kWeight * 0.9);
  plant.step(100ms);
  const double acceleration = 0.1 * kWeight / (kInertia + 0.00501);
  EXPECT_NEAR(plant.velocity(kSwing), -acceleration * 0.1, 0.01 * acceleration);
  plant.set_brake(kSwing, 100.0);
  plant.step(10ms);
  const double stopped = plant.position(kSwing);
  plant.step(1s);
  EXPECT_NEAR(plant.position(kSwing), stopped, 1e-7);
}

TEST(Plant, AJointStopsAtItsLimits) {
  Plant plant = make(0.0, 0.0);
  for (const double side : {1.0, -1.0}) {
    plant.set_effort(kSwing, side * 10.0);
    plant.step(10s);
    EXPECT_NEAR(plant.position(kSwing), side * 3.0, 0.01);
  }
}

TEST(Plant, TimePassesInWholeInnerStepsAndTheRestIsMadeUp) {
  Plant::Options options;
  options.inner_step = 100us;
  Plant whole = make(0.0, 0.0, options);
  Plant split = make(0.0, 0.0, options);
  whole.step(700us);
  for (int i = 0; i < 10; ++i) split.step(70us);
  EXPECT_EQ(split.time(), 700us);
  EXPECT_EQ(split.position(kSwing), whole.position(kSwing));
  split.step(99us);
  EXPECT_EQ(split.time(), 700us);
}

TEST(Plant, DivergenceIsReportedAndTheStateStaysAsItWas) {
  for (const double wild : {std::numeric_limits<double>::quiet_NaN(), 1e200}) {
    Plant plant = make(0.0, 0.0);
    plant.step(100ms);
    const double before = plant.position(kSwing);
    plant.set_effort(kSpin, wild);
    EXPECT_EQ(plant.step(1ms), PlantStatus::kDiverged);
    EXPECT_EQ(plant.time(), 100ms);
    EXPECT_EQ(plant.position(kSwing), before);
    plant.set_effort(kSpin, 0.0);
    EXPECT_EQ(plant.step(1ms), PlantStatus::kDiverged);
  }
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

TEST(Plant, TwoRunsAreEqualToTheBit) {
  const auto run = [] {
    Plant plant = make(0.01, 0.05);
    std::vector<double> positions;
    for (int i = 0; i < 1000; ++i) {
      plant.set_effort(kSwing, std::sin(0.1 * i));
      plant.set_effort(kSpin, 0.1 * std::cos(0.3 * i));
      plant.set_brake(kSwing, i % 300 > 250 ? 10.0 : 0.0);
      plant.step(1ms);
      positions.push_back(plant.position(kSwing));
      positions.push_back(plant.position(kSpin));
    }
    return positions;
  };
  EXPECT_EQ(run(), run());
}

TEST(Plant, AllocatesNothingWhileItSteps) {
  Plant plant = make(0.01, 0.05);
  testing::RealtimeGuard guard;
  const auto violations = guard.watch([&] {
    for (int i = 0; i < 200; ++i) {
      plant.set_effort(kSwing, i % 2 == 0 ? 10.0 : -10.0);
      plant.set_brake(kSpin, i % 3 == 0 ? 1.0 : 0.0);
      plant.step(10ms);
    }
    plant.set_effort(kSwing, std::numeric_limits<double>::quiet_NaN());
    plant.step(1ms);
  });
  EXPECT_EQ(violations, 0u) << guard.report();
  EXPECT_EQ(plant.status(), PlantStatus::kDiverged);
}

TEST(Plant, AMistakeIsNamedWithItsFile) {
  const auto error = [](const std::string& urdf, const Plant::Options& options = {}) {
    const auto made = Plant::parse(urdf, "arm.urdf", options);
    return made.ok() ? "no error" : made.error();
  };
  EXPECT_THAT(Plant::load("/nowhere/arm.urdf", {}).error(),
              HasSubstr("/nowhere/arm.urdf: cannot be read"));
  EXPECT_THAT(error(""), HasSubstr("arm.urdf: the file is empty"));
  EXPECT_THAT(error("<robot"), HasSubstr("arm.urdf: XML"));
  EXPECT_THAT(error("<robot name='r'><link name='base'/></robot>"), HasSubstr("no joint moves"));
  EXPECT_THAT(error(pendulum(0.0, 0.0, "floating")), HasSubstr("arm.urdf: "));
  EXPECT_THAT(error(pendulum(0.0, 0.0), {.inner_step = 0ns, .armature = {}}),
              HasSubstr("inner_step is 0 ns"));
  EXPECT_THAT(error(pendulum(0.0, 0.0), {.inner_step = 1ms, .armature = {{"elbow", 1.0}}}),
              HasSubstr("the armature of joint 'elbow' is given, but the description has no such"));
  EXPECT_THAT(error(pendulum(0.0, 0.0), {.inner_step = 1ms, .armature = {{"spin", -1.0}}}),
              HasSubstr("joint 'spin' is expected to be a finite number"));
}

}  // namespace
}  // namespace armature::sim
