// SPDX-License-Identifier: Apache-2.0
// Going over from one controller of the arm to the other while it moves.
#include <algorithm>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "armature/exec/modes.hpp"
#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

const Vector kTarget{1.0, 0.5, -0.8, 1.2, -1.0, 0.8, 1.0};

class SwitchInMotion : public ::testing::TestWithParam<int> {
 protected:
  SwitchInMotion() : arm("modes" + std::to_string(GetParam()) + ".yaml") {
    arm.start_armed();
    arm.run_for(1500ms);
    EXPECT_EQ(arm.move_to(Vector(kTarget.begin(), kTarget.begin() + GetParam()), 5.0), "");
    torques_ = arm.motor_torques();
  }
  std::string mode() { return std::string(arm.value<exec::ModeName>("Modes", "mode").view()); }
  void switch_over() {
    const std::string to = mode() == "npid" ? "computed_torque" : "npid";
    EXPECT_TRUE(arm.application().switch_mode(to));
    ++switches;
  }
  /// The largest change of a motor's torque from cycle to cycle [Nm], and of the error.
  void cycle() {
    const Vector desired = arm.desired();
    arm.cycle();
    const auto measured = arm.value<Vector>("Sensor", "sensor");
    for (std::size_t i = 0; i < arm.joints(); ++i) {
      error = std::max(error, std::abs(desired[i] - measured[i]));
    }
    const Vector torques = arm.motor_torques();
    step = std::max(step, largest_apart(torques, torques_));
    torques_ = torques;
  }

  Arm arm;
  double step = 0.0;
  double error = 0.0;
  int switches = 0;

 private:
  Vector torques_;
};
INSTANTIATE_TEST_SUITE_P(Wam, SwitchInMotion, ::testing::Values(4, 7));

TEST_P(SwitchInMotion, MakesNoStepAndTheArmFollowsAsBefore) {
  // Each controller alone, then both by turns.
  for (int cycles = 0; cycles < 3500; ++cycles) cycle();
  switch_over();
  arm.run_for(1s);
  ASSERT_EQ(arm.move_to(Vector(arm.joints(), 0.3), 5.0), "");
  for (int cycles = 0; cycles < 3500; ++cycles) cycle();
  const double step_alone = std::exchange(step, 0.0);
  ASSERT_EQ(arm.move_to(Vector(kTarget.begin(), kTarget.begin() + GetParam()), 5.0), "");
  std::mt19937 random(7);
  for (int cycles = 0, next = 100; cycles < 3500; ++cycles) {
    if (cycles == next) {
      switch_over();
      next += 30 + static_cast<int>(random() % 300);
    }
    cycle();
  }
  EXPECT_GT(switches, 10);
  EXPECT_LT(error, 0.02);
  EXPECT_LT(step, 1.1 * step_alone) << "the motors' torques change no faster than with one alone";
  EXPECT_TRUE(arm.armed());
  EXPECT_EQ(arm.value<int>("WAM", "cycles_without_command"), 0);
  EXPECT_EQ(arm.application().faults(), 0u) << arm.log;
}

TEST_P(SwitchInMotion, ArmsNothing) {
  ASSERT_EQ(arm.call("Arming", "disarm"), "");
  arm.run_for(100ms);
  switch_over();
  arm.run_for(1s);
  EXPECT_FALSE(arm.armed());
  const Vector rest = arm.positions();
  switch_over();
  arm.run_for(2s);
  EXPECT_LT(largest_apart(arm.positions(), rest), 0.002);
}

/// A resting arm goes over to a controller that drives nothing, at `cycles` after it was told to
/// rest: what it took over dies away, and pushes it.
double pushed(const char* switch_time, int cycles) {
  Arm arm("../../../tests/wam/weightless7.yaml",
          {std::string("Weightless.SwitchTime=") + switch_time});
  arm.start_armed();
  arm.run_for(1s);
  EXPECT_EQ(arm.move_to({0.5, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5}, 5.0), "");
  arm.run_for(8s);
  for (int k = 0; k < cycles; ++k) arm.cycle();
  const Vector rest = arm.positions();
  EXPECT_TRUE(arm.application().switch_mode("weightless"));
  double farthest = 0.0;
  for (int k = 0; k < 1000; ++k) {
    arm.cycle();
    farthest = std::max(farthest, largest_apart(arm.positions(), rest));
  }
  EXPECT_TRUE(arm.armed()) << arm.log;
  return farthest;
}

TEST(SwitchAtRest, ToAControllerThatDrivesNothingPushesTheArmNowhere) {
  for (const char* switch_time : {"0.02", "0.5"}) {
    for (const int cycles : {0, 1, 2, 3, 7}) {
      EXPECT_LT(pushed(switch_time, cycles), 0.05)
          << "SwitchTime " << switch_time << ", " << cycles << " cycles later";
    }
  }
}

}  // namespace
}  // namespace armature::wam
