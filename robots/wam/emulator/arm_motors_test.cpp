// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/arm_motors.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/wam/emulator/emulator.hpp"
#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

ArmSimulation simulation_of(const ArmNumbers& arm, const Vector& start = {}) {
  ArmSimulation::Config config;
  config.urdf_file = description_of(arm);
  config.start = start;
  auto made = ArmSimulation::load(arm, config);
  EXPECT_TRUE(made.ok()) << made.error();
  return std::move(made).value();
}

/// Somewhere in the range, where gravity pulls.
Vector raised(const ArmNumbers& arm) {
  Vector joints(arm.joints(), 0.2);
  joints[1] = 0.9;
  joints[3] = 1.2;
  return joints;
}

Vector joints_of(const ArmMotors& motors) {
  Vector joints;
  for (std::size_t i = 0; i < motors.count(); ++i) {
    joints.push_back(motors.arm().joint_position(i));
  }
  return joints;
}

class Motored : public ::testing::TestWithParam<const ArmNumbers*> {
 protected:
  const ArmNumbers& arm() const { return *GetParam(); }
};

TEST_P(Motored, MovesAsTheSimulationDoesAtWhateverTimesItIsAsked) {
  constexpr base::Time kBegin{5s};
  ArmMotors motors(simulation_of(arm(), raised(arm())), kBegin);
  ArmSimulation alone = simulation_of(arm(), raised(arm()));
  motors.drive(0, 0.3);
  alone.set_torque(0, 0.3);
  for (const base::Duration at : {130us, 131us, 900us, 100'000us}) motors.advance_to(kBegin + at);
  alone.advance(100ms);
  for (std::size_t i = 0; i < motors.count(); ++i) EXPECT_EQ(motors.angle(i), alone.angle(i));
  EXPECT_GT(std::abs(alone.angle(0) - -42.0 * 0.2), 0.1);
}

TEST_P(Motored, SinksSlowlyWhileItsMotorsAreBraked) {
  ArmMotors motors(simulation_of(arm(), raised(arm())), base::Time{});
  motors.advance_to(base::Time{100ms});
  const double fallen = largest_difference(joints_of(motors), raised(arm()));
  EXPECT_GT(fallen, 1e-4);
  EXPECT_LT(fallen, 0.2);
}

TEST_P(Motored, AnOperatorCarriesItHomeSlowlyAndHoldsItThere) {
  ArmMotors motors(simulation_of(arm(), raised(arm())), base::Time{});
  motors.carry_to(arm().home);
  double fastest = 0.0;
  Vector before = joints_of(motors);
  base::Time now{};
  for (; !motors.arrived(); now += 10ms) {
    ASSERT_LT(now, base::Time{20s});
    motors.advance_to(now);
    fastest = std::max(fastest, largest_difference(joints_of(motors), before) / 0.01);
    before = joints_of(motors);
  }
  EXPECT_NEAR(fastest, ArmMotors::kCarryingRate, 1e-6);
  motors.advance_to(now + 10s);
  EXPECT_EQ(joints_of(motors), arm().home);
  EXPECT_TRUE(motors.carried());
}

TEST_P(Motored, WhoCarriesItLetsGoAsSoonAsAMotorDrives) {
  ArmMotors motors(simulation_of(arm(), raised(arm())), base::Time{});
  motors.carry_to(arm().home);
  motors.advance_to(base::Time{100ms});
  EXPECT_TRUE(motors.carried());
  motors.drive(0, 0.0);
  EXPECT_FALSE(motors.carried());
  motors.advance_to(base::Time{200ms});
  EXPECT_GT(largest_difference(joints_of(motors), arm().home), 0.5);
}

TEST_P(Motored, AllocatesNothing) {
  ArmMotors motors(simulation_of(arm()), base::Time{});
  testing::RealtimeGuard guard;
  guard.watch([&] {
    motors.advance_to(base::Time{1ms});
    motors.drive(0, 0.1);
    motors.advance_to(base::Time{2ms});
    motors.brake(0);
    motors.carry_to(arm().home);
    motors.advance_to(base::Time{3ms});
  });
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
}

TEST_P(Motored, PucksCountTheMotorsOfTheArm) {
  ArmMotors motors(simulation_of(arm()), base::Time{});
  auto emulator = Emulator::make(Emulator::standard(arm().joints()), motors).value();
  emulator->board().reset();
  emulator->board().shift_idle();
  emulator->advance_to(base::Time{1s});
  const std::int32_t before = emulator->puck(0).counts();
  Vector turned = arm().home;
  turned[0] += 0.1;
  motors.carry_to(turned);
  emulator->advance_to(base::Time{2s});
  EXPECT_NEAR(emulator->puck(0).counts() - before, -42.0 * 0.1 / 6.283185307 * 4096.0, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Arms, Motored, ::testing::Values(&wam7(), &wam4()), name_of_arm);

}  // namespace
}  // namespace armature::wam
