// SPDX-License-Identifier: Apache-2.0
// The arm that is weightless once the operator has activated it, if the deployment says so.
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;
using Mode = TorquePath::Mode;

const char* const kFloats = "WAM.after_activation=weightless";

class WamWeightless : public ::testing::Test {
 protected:
  explicit WamWeightless(std::vector<std::string> overrides = {kFloats})
      : arm("npid7.yaml", std::move(overrides)) {}
  void start_floating() {
    arm.start_active();
    arm.run_for(2s);
    ASSERT_EQ(mode(), Mode::kWeightless) << arm.log;
  }
  Mode mode() { return arm.hardware().torque_path().mode(); }
  /// A hand pushes a joint, counted from 0, and lets go.
  void push(std::size_t joint, double velocity) {
    Vector velocities(7, 0.0);
    velocities[joint] = velocity;
    arm.hardware().emulated()->motors().push(velocities);
  }

  Arm arm;
};

TEST_F(WamWeightless, IsHeldForASecondThenFloatsAndStaysWhereItIs) {
  arm.start_active();
  arm.run_for(500ms);
  EXPECT_EQ(mode(), Mode::kHolding);
  EXPECT_THAT(arm.log, HasSubstr("then it becomes weightless: hold it when you press it"));
  const Vector begin = arm.positions();
  arm.run_for(1500ms);
  EXPECT_EQ(mode(), Mode::kWeightless);
  EXPECT_TRUE(arm.value<bool>("WAM", "weightless"));
  EXPECT_FALSE(arm.armed()) << "nobody has armed it";
  arm.run_for(10s);
  EXPECT_EQ(mode(), Mode::kWeightless);
  EXPECT_LT(largest_apart(arm.positions(), begin), 0.01) << "gravity alone moves it nowhere";
}

TEST_F(WamWeightless, AHandLeadsItAndNothingDrivesItBack) {
  start_floating();
  const double begin = arm.positions()[1];
  push(1, 0.5);
  arm.run_for(2s);
  EXPECT_EQ(mode(), Mode::kWeightless) << arm.log;
  EXPECT_GT(std::abs(arm.positions()[1] - begin), 0.02);
  EXPECT_EQ(arm.state("WAM"), component::State::kRunning) << arm.reason("WAM");
  EXPECT_EQ(arm.hardware().torque_path().moving_torques()[1], 0.0);
}

TEST_F(WamWeightless, CommandsArePassedOnlyOnceItIsArmed) {
  start_floating();
  EXPECT_NE(arm.move_to({0.1, -1.9, 0.0, 3.0, 0.0, 0.0, 0.0}, 5.0), "") << "not armed";
  const Vector begin = arm.positions();
  arm.arm();
  EXPECT_FALSE(arm.value<bool>("WAM", "weightless"));
  arm.run_for(2s);
  EXPECT_LT(largest_apart(arm.positions(), begin), 0.01) << "armed, it stays where it is";
}

TEST_F(WamWeightless, IsNotArmedWhileAHandMovesIt) {
  start_floating();
  push(1, 0.6);
  arm.run_for(10ms);
  static_cast<void>(arm.call("Arming", "arm"));
  arm.run_for(20ms);
  EXPECT_FALSE(arm.armed());
}

TEST_F(WamWeightless, DisarmingHoldsItAndItStaysHeld) {
  start_floating();
  ASSERT_EQ(arm.call("Arming", "disarm"), "");
  arm.run_for(10ms);
  EXPECT_EQ(mode(), Mode::kHolding);
  arm.run_for(5s);
  EXPECT_EQ(mode(), Mode::kHolding);
  EXPECT_EQ(arm.state("WAM"), component::State::kRunning) << arm.reason("WAM");
}

TEST_F(WamWeightless, ThatIsTooFastIsHeld) {
  start_floating();
  push(6, 8.0);  // the wrist, so that the tip is not too fast for the board
  arm.run_for(1s);
  EXPECT_EQ(mode(), Mode::kHolding) << arm.log;
  EXPECT_THAT(arm.log, HasSubstr("no longer weightless, and holds the arm where it is: "));
  EXPECT_EQ(arm.state("WAM"), component::State::kRunning) << arm.reason("WAM");
}

TEST_F(WamWeightless, ShiftIdleEndsItAndTheNextActivationBeginsAnew) {
  start_floating();
  arm.set("WAM", "emulated_operator", false);
  ASSERT_EQ(arm.call("WAM", "shiftIdle"), "");
  arm.run_for(100ms);
  EXPECT_EQ(mode(), Mode::kOff);
  EXPECT_FALSE(arm.value<bool>("WAM", "weightless"));
  EXPECT_TRUE(arm.pucks_are_idle());
}

class WamWithALoad : public WamWeightless {
 protected:
  /// The host takes the arm for heavier than it is: the other way round a stop would bear the
  /// difference, since home lies at two of them.
  WamWithALoad()
      : WamWeightless({kFloats, "WAM.gravity=[0, 0, -9.89]", "WAM.WeightlessMaxLoad=[0.05]"}) {}
};

TEST_F(WamWithALoad, StaysHeldAndSaysWhichJointNeedsMore) {
  arm.start_active();
  arm.run_for(5s);
  EXPECT_EQ(mode(), Mode::kHolding);
  EXPECT_THAT(arm.log, HasSubstr("stays held, and is not weightless: joint 2 needs "));
  EXPECT_FALSE(arm.value<bool>("WAM", "weightless"));
}

TEST(WamAfterActivation, HoldsUnlessTheDeploymentSaysOtherwise) {
  Arm arm("npid7.yaml");
  arm.start_active();
  arm.run_for(3s);
  EXPECT_EQ(arm.hardware().torque_path().mode(), Mode::kHolding);
  EXPECT_THAT(arm.log, Not(HasSubstr("weightless")));
}

}  // namespace
}  // namespace armature::wam
