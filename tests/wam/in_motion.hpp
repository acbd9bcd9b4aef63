// SPDX-License-Identifier: Apache-2.0
// The arm in the middle of a motion, in which something is about to break.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wam/arm.hpp"

namespace armature::wam {

using namespace std::chrono_literals;
using component::State;

inline const Vector kTarget{0.6, -1.0, 0.4, 2.0, -0.5, 0.4, 0.5};

class WamInMotion : public ::testing::Test {
 protected:
  WamInMotion() : arm("npid7.yaml") {
    arm.start_armed();
    EXPECT_EQ(arm.move_to(kTarget, 5.0), "");
    arm.run_for(2500ms);
  }
  SafetyBoard& board() { return arm.emulator().board(); }
  /// Out of service within that time, with a reason.
  void expect_fault_within(base::Duration time, const std::string& why) {
    arm.run_for(time);
    EXPECT_EQ(arm.state("WAM"), State::kException);
    EXPECT_THAT(arm.reason("WAM"), ::testing::HasSubstr(why));
    arm.run_for(20ms);
    EXPECT_FALSE(arm.armed());
  }
  void expect_braked() {
    arm.let_emulator_run(2ms);
    for (std::size_t i = 0; i < arm.joints(); ++i) {
      const Puck& puck = arm.emulator().puck(i);
      EXPECT_TRUE(puck.state() == PuckState::kOff || puck.mode() == PuckMode::kIdle) << i;
    }
  }
  void expect_rests() {
    const Vector rest = arm.positions();
    arm.run_for(5s);
    EXPECT_LT(largest_apart(arm.positions(), rest), 0.002);
  }
  /// Of a motor's torque from cycle to cycle [Nm].
  double largest_step_of(int cycles) {
    Vector torques = arm.motor_torques();
    double step = 0.0;
    for (int cycle = 0; cycle < cycles; ++cycle) {
      arm.cycle();
      step = std::max(step, largest_apart(arm.motor_torques(), torques));
      torques = arm.motor_torques();
    }
    return step;
  }
  void return_to_service() {
    ASSERT_TRUE(arm.application().reset_component("WAM")) << arm.reason("WAM");
    ASSERT_TRUE(arm.application().start_component("WAM")) << arm.reason("WAM");
    start_stopped();
    arm.run_for(1s);
    ASSERT_EQ(arm.safety_state(), "ACTIVATED") << arm.waits_for() << arm.log;
  }
  /// Those that a reaction stopped with it, writers first.
  void start_stopped() {
    for (const char* name : {"Sensor", "BridgeRef", "Reference", "Generator", "Controller"})
      start(name);
    for (int i = 1; i <= 7; ++i) start("PID" + std::to_string(i));
    for (const char* name : {"Actuator", "Arming"}) start(name);
  }
  void start(const std::string& name) {
    if (arm.state(name.c_str()) != State::kStopped) return;
    EXPECT_TRUE(arm.application().start_component(name)) << name;
  }
  /// Nothing moves until it is armed; then a motion is made as if nothing had happened.
  void expect_moves_only_once_armed() {
    const Vector rest = arm.positions();
    arm.run_for(2s);
    EXPECT_LT(largest_apart(arm.positions(), rest), 0.003) << "nothing goes on by itself";
    EXPECT_FALSE(arm.armed());
    arm.arm();
    arm.run_for(1s);
    EXPECT_LT(largest_apart(arm.positions(), rest), 0.005) << "arming moves nothing";
    ASSERT_EQ(arm.move_to(kTarget, 5.0), "");
    arm.run_for(7s);
    EXPECT_LT(largest_apart(arm.positions(), kTarget), 0.01);
    EXPECT_TRUE(arm.armed());
  }

  Arm arm;
};

}  // namespace armature::wam
