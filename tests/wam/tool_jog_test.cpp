// SPDX-License-Identifier: Apache-2.0
// The arm's tool, jogged by an operator who holds on to it, in its deployment and in simulated
// time.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wam/on_paths.hpp"

namespace armature::wam {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

class WamToolJogged : public WamOnPaths {
 protected:
  std::vector<types::Value> numbers_of_jog(int axis, double velocity) {
    return {types::Value::of(axis), types::Value::of(velocity)};
  }
  std::string jog(int axis, double velocity) {
    return arm.call("Planner", "jog", numbers_of_jog(axis, velocity));
  }
  bool renew(int axis, double velocity) {
    const auto answer =
        arm.application().call("Planner", "keepJogging", numbers_of_jog(axis, velocity));
    EXPECT_TRUE(answer) << answer.error();
    return answer && *static_cast<const bool*>(answer.value()->data());
  }
  /// Holds on to it, renews it each 50 ms, and looks at limits in each cycle.
  void hold(base::Duration time, int axis, double velocity) {
    for (base::Duration passed{}; passed < time; passed += 50ms) {
      EXPECT_TRUE(renew(axis, velocity));
      watch(50ms);
    }
  }
  void watch(base::Duration time) {
    for (base::Duration passed{}; passed < time; passed += Arm::kPeriod) {
      arm.cycle();
      const Pose now = tool();
      const double speed = control::distance(now, last_).way / 0.002;
      fastest_ = std::max(fastest_, speed);
      turning_ = std::max(turning_, control::distance(now, last_).angle / 0.002);
      acceleration_ = std::max(acceleration_, std::abs(speed - last_speed_) / 0.002);
      last_ = now;
      last_speed_ = speed;
      const Vector velocities = arm.value<Vector>("Generator", "nAxesDesiredVelocity");
      for (const double each : velocities) EXPECT_LE(std::abs(each), 2.0);
    }
  }
  Pose tool() { return kinematics_->pose_at(desired()); }
  bool rests() { return arm.value<Vector>("Generator", "nAxesDesiredVelocity") == Vector(7, 0.0); }
  std::string end() {
    return std::string(arm.value<component::Reason>("Planner", "jog_end").view());
  }
  void SetUp() override {
    WamOnPaths::SetUp();
    last_ = tool();
  }
  /// Of the tool from where it began, along each axis [m].
  Vector way() {
    const Pose now = tool();
    return {now.position[0] - begin_.position[0], now.position[1] - begin_.position[1],
            now.position[2] - begin_.position[2]};
  }

  Pose last_;
  double last_speed_ = 0.0;
  double fastest_ = 0.0;
  double turning_ = 0.0;
  double acceleration_ = 0.0;
};

TEST_F(WamToolJogged, MovesAlongAnAxisOfTheBaseAsLongAsItIsRenewed) {
  auto begun = arm.application().begin("Planner", "jog", numbers_of_jog(2, 0.1));
  ASSERT_TRUE(begun) << begun.error();
  hold(1s, 2, 0.1);
  EXPECT_EQ(begun.value().stage(), CommandStage::kAccepted);
  EXPECT_NEAR(way()[1], 0.1, 0.02);
  const double let_go = way()[1];
  watch(148ms);
  EXPECT_NEAR(way()[1] - let_go, 0.1 * 0.098, 0.006) << "150 ms after the last renewal";
  while (!begun.value().ended()) watch(2ms);
  EXPECT_TRUE(rests()) << "it ends at rest";
  EXPECT_EQ(begun.value().stage(), CommandStage::kDone);
  watch(1s);
  EXPECT_LT(way()[1] - let_go, 0.1 * 0.15 + 0.02);
  EXPECT_NEAR(way()[0], 0.0, 1e-3);
  EXPECT_NEAR(way()[2], 0.0, 1e-3);
  EXPECT_LT(control::distance(tool(), begin_).angle, 5e-3);
  const Vector rest = desired();
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(renew(2, 0.1));
  watch(1s);
  EXPECT_EQ(desired(), rest) << "renewals that come late move nothing";
  EXPECT_LT(fastest_, 0.102);
  EXPECT_LT(acceleration_, 1.05) << "max_tool_acceleration";
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(arm.positions()[i], rest[i], 0.02);
  EXPECT_TRUE(arm.armed()) << arm.log;
}

TEST_F(WamToolJogged, MovesAlongAndAboutTheAxesOfTheTool) {
  arm.set("Planner", "jog_frame", std::string("tool"));
  ASSERT_EQ(jog(3, -0.1), "");
  hold(1s, 3, -0.1);
  watch(1s);
  const Vector moved = way();
  double along = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < 3; ++i) along += moved[i] * begin_.rotation[3 * i + 2];
  for (std::size_t i = 0; i < 3; ++i) {
    across += std::pow(moved[i] - along * begin_.rotation[3 * i + 2], 2);
  }
  EXPECT_NEAR(along, -0.12, 0.03);
  EXPECT_LT(std::sqrt(across), 1e-3);
  const Pose before = tool();
  ASSERT_EQ(jog(6, 0.3), "");
  hold(1s, 6, 0.3);
  watch(1s);
  EXPECT_LT(control::distance(tool(), before).way, 1e-3) << "it turns where it is";
  EXPECT_NEAR(control::distance(tool(), before).angle, 0.35, 0.06);
  double same = 0.0;  // the tool's z, which it turns about
  for (std::size_t i = 0; i < 3; ++i) {
    same += tool().rotation[3 * i + 2] * before.rotation[3 * i + 2];
  }
  EXPECT_NEAR(same, 1.0, 1e-5);
  EXPECT_LT(turning_, 0.31);
}

TEST_F(WamToolJogged, TurnsAboutAnAxisOfTheBase) {
  ASSERT_EQ(jog(6, -0.2), "");
  hold(1s, 6, -0.2);
  watch(1s);
  EXPECT_LT(control::distance(tool(), begin_).way, 1e-3);
  EXPECT_NEAR(control::numbers_of(tool())[5] - control::numbers_of(begin_)[5], -0.23, 0.04);
}

TEST_F(WamToolJogged, ItIsRenewedByItsOwnNumbersOnly) {
  ASSERT_EQ(jog(2, 0.1), "");
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(renew(2, -0.1));
    EXPECT_FALSE(renew(1, 0.1));
    watch(50ms);
  }
  EXPECT_TRUE(rests());
  EXPECT_LT(way()[1], 0.1 * 0.15 + 0.02);
}

TEST_F(WamToolJogged, CancelledItBrakesAtOnce) {
  auto begun = arm.application().begin("Planner", "jog", numbers_of_jog(2, 0.2));
  ASSERT_TRUE(begun) << begun.error();
  hold(500ms, 2, 0.2);
  const double before = way()[1];
  begun.value().cancel();
  watch(500ms);
  EXPECT_TRUE(rests());
  EXPECT_EQ(begun.value().stage(), CommandStage::kCancelled);
  EXPECT_LT(way()[1] - before, 0.06);
  EXPECT_LT(acceleration_, 1.05);
}

/// The generator itself lets go: it needs nobody who tells it to.
TEST_F(WamToolJogged, ItBrakesWhenThePlannerDiesOrIsStopped) {
  ASSERT_EQ(jog(2, 0.1), "");
  hold(500ms, 2, 0.1);
  const double before = way()[1];
  arm.application().find("Planner")->fault("it died");
  watch(1s);
  EXPECT_TRUE(rests());
  EXPECT_LT(way()[1] - before, 0.1 * 0.15 + 0.02);
  EXPECT_TRUE(arm.armed()) << arm.log;
  EXPECT_LT(acceleration_, 1.05);
}

TEST_F(WamToolJogged, ItEndsSmoothlyWhereTheArmCannotGoOnAndSaysWhy) {
  for (const int axis : {1, 2, 3}) {
    for (const double velocity : {0.2, -0.2}) {
      SCOPED_TRACE(axis * velocity);
      ASSERT_EQ(arm.move_to({0.2, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5}, 3.0), "");
      arm.run_for(4s);
      last_ = tool();
      last_speed_ = 0.0;
      const Pose from = last_;
      ASSERT_EQ(jog(axis, velocity), "");
      EXPECT_THAT(end(), AnyOf(HasSubstr(" would be at "), HasSubstr("reach"),
                               HasSubstr("singular"), HasSubstr("1 m is the most at once")));
      int renewals = 0;
      for (; renewals < 200 && renew(axis, velocity); ++renewals) watch(50ms);
      EXPECT_LT(renewals, 200);
      watch(1s);
      EXPECT_TRUE(rests());
      EXPECT_GT(control::distance(tool(), from).way, 0.02);
      EXPECT_THAT(jog(axis, velocity), AnyOf(HasSubstr(" m along the path of "), ""))
          << "there is hardly any way left";
      watch(1s);
      ASSERT_EQ(jog(axis, -velocity), "") << "and back";
      hold(300ms, axis, -velocity);
      watch(1s);
    }
  }
  EXPECT_LT(fastest_, 0.204);
  EXPECT_LT(acceleration_, 1.1);
  EXPECT_TRUE(arm.armed()) << arm.log;
}

/// With its elbow nearly straight: out of reach a little further, and fast joints all the way.
TEST_F(WamToolJogged, AtTheBorderOfItsReachAllLimitsAreKept) {
  ASSERT_EQ(arm.move_to({0.0, 0.9, 0.0, 0.6, 0.0, 0.3, 0.0}, 5.0), "");
  arm.run_for(6s);
  last_ = tool();
  const Vector before = measured();
  for (const double velocity : {0.25, -0.25, 0.25}) {
    for (const int axis : {3, 1}) {
      SCOPED_TRACE(axis * velocity);
      const std::string why = jog(axis, velocity);
      EXPECT_THAT(why, AnyOf("", HasSubstr(" m along the path of "), HasSubstr("off the path")));
      if (!why.empty()) continue;
      for (int i = 0; i < 30 && renew(axis, velocity); ++i) watch(50ms);
      watch(1s);
      EXPECT_TRUE(rests());
    }
  }
  EXPECT_GT(largest_apart(measured(), before), 0.1) << "it was moved";
  EXPECT_LT(fastest_, 0.255);
  EXPECT_LT(acceleration_, 1.1);
  EXPECT_TRUE(arm.armed()) << arm.log;
}

TEST_F(WamToolJogged, WhatCannotBeIsRefusedAndNothingMoves) {
  const Vector before = desired();
  EXPECT_THAT(jog(0, 0.1), HasSubstr("axis 0: expected 1 to 6"));
  EXPECT_THAT(jog(7, 0.1), HasSubstr("axis 7: expected 1 to 6"));
  EXPECT_THAT(jog(1, 0.0), HasSubstr("axis 1: the velocity is 0"));
  EXPECT_THAT(jog(1, std::nan("")), HasSubstr("axis 1: the velocity is not finite"));
  EXPECT_THAT(jog(1, 0.3), HasSubstr("too fast: 0.3, expected 0.25 m/s at most"));
  EXPECT_THAT(jog(4, -1.1), HasSubstr("too fast: -1.1, expected 1 rad/s at most"));
  EXPECT_THAT(jog(1, 1e-5), HasSubstr("expected 0.0009"));
  arm.set("Planner", "jog_frame", std::string("world"));
  EXPECT_THAT(jog(1, 0.1), HasSubstr("jog_frame is 'world', expected base or tool"));
  arm.run_for(500ms);
  EXPECT_EQ(desired(), before);
}

TEST_F(WamToolJogged, ADisarmedArmIsNotJoggedAndDisarmingEndsIt) {
  ASSERT_EQ(jog(2, 0.1), "");
  hold(500ms, 2, 0.1);
  ASSERT_TRUE(arm.application().call("Arming", "disarm", {}));
  arm.run_for(20ms);
  EXPECT_FALSE(renew(2, 0.1));
  arm.run_for(1s);
  const Vector rest = measured();
  auto begun = arm.application().begin("Planner", "jog", numbers_of_jog(2, 0.1));
  for (int i = 0; i < 20; ++i) {
    renew(2, 0.1);
    arm.run_for(50ms);
  }
  ASSERT_TRUE(begun) << begun.error();
  EXPECT_EQ(begun.value().stage(), CommandStage::kFailed);
  EXPECT_THAT(std::string(begun.value().reason()), HasSubstr("not armed"));
  EXPECT_LT(largest_apart(measured(), rest), 0.01);
}

TEST_F(WamToolJogged, OneMotionAtATime) {
  ASSERT_EQ(arm.move_to({0.3, -1.1, 0.3, 2.2, -0.5, 0.4, 0.5}, 3.0), "");
  arm.run_for(500ms);
  EXPECT_THAT(jog(2, 0.1), HasSubstr("the joints move, or brake: wait until they rest"));
  arm.run_for(5s);
  ASSERT_EQ(jog(2, 0.1), "");
  hold(200ms, 2, 0.1);
  EXPECT_NE(jog(1, 0.1), "");
  EXPECT_NE(arm.move_to({0.3, -1.1, 0.3, 2.2, -0.5, 0.4, 0.5}, 3.0), "");
  EXPECT_NE(arm.call("Planner", "moveLinear",
                     {types::Value::of(numbers({begin_})), types::Value::of(0.0)}),
            "");
  hold(200ms, 2, 0.1);
}

}  // namespace
}  // namespace armature::wam
