// SPDX-License-Identifier: Apache-2.0
// Motions that cannot be are refused, and those that are accepted do not end in the board's fault.
#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/wam/tip_speed.hpp"
#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

const Vector kThere{0.5, -1.2, 0.0, 2.0};

TEST(WamMotions, OfAnArmThatIsNotArmedAreRefused) {
  Arm arm("npid4.yaml");
  arm.start_active();
  const Vector before = arm.positions();
  EXPECT_THAT(arm.move_to(kThere, 5.0), HasSubstr("the robot is not armed: arm first"));
  arm.run_for(2s);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(arm.positions()[i], before[i], 0.01);
  arm.arm();
  EXPECT_EQ(arm.move_to(kThere, 5.0), "");
}

TEST(WamMotions, OfAnArmThatIsNotArmedAnyMoreAreRefused) {
  Arm arm("npid4.yaml");
  arm.start_armed();
  ASSERT_EQ(arm.call("Arming", "disarm"), "");
  arm.run_for(20ms);
  EXPECT_THAT(arm.move_to(kThere, 5.0), HasSubstr("the robot is not armed: arm first"));
}

TEST(WamMotions, ThatWouldEndInTheBoardsVelocityFaultAreRefusedWithTheShortestTime) {
  Arm arm("npid4.yaml");
  arm.start_armed();
  arm.run_for(1s);
  const std::string refusal = arm.move_to(kThere, 0.1);
  EXPECT_THAT(refusal, HasSubstr("the motion is faster than the limits allow: it takes "));
  EXPECT_THAT(refusal, HasSubstr("s at least, found 0.1 s"));
  arm.run_for(1s);
  EXPECT_EQ(arm.state("WAM"), component::State::kRunning);
}

TEST(WamMotions, AreAtTheirFastestWithinWhatTheBoardAllows) {
  Arm arm("npid4.yaml");
  arm.start_armed();
  arm.run_for(1s);
  ASSERT_EQ(arm.move_to(kThere, 0.0), "");
  double fastest = 0.0;
  for (int k = 0; k < 2000; ++k) {
    arm.cycle();
    fastest = std::max(
        fastest,
        TipSpeed::of(arm.desired(), arm.value<Vector>("Generator", "nAxesDesiredVelocity")));
  }
  EXPECT_NEAR(fastest, 0.95, 0.02) << "[m/s]";
  EXPECT_EQ(arm.state("WAM"), component::State::kRunning) << arm.reason("WAM");
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(arm.positions()[i], kThere[i], 0.02);
}

TEST(WamMotions, HomeIsReachedFromNearbyToo) {
  Arm arm("npid4.yaml");
  arm.start_armed();
  ASSERT_EQ(arm.move_to({0.01, -1.99, 0.0, 3.12}, 2.0), "");
  arm.run_for(3s);
  ASSERT_EQ(arm.call("WAM", "moveHome"), "");
  arm.run_for(3s);
  EXPECT_NEAR(arm.desired()[0], 0.0, 1e-6);
}

TEST(WamMotions, AJogMovesOneJointAsLongAsItIsRenewed) {
  Arm arm("npid4.yaml");
  arm.start_active();
  const auto asked = [&arm](const char* operation) {
    return arm.call("Generator", operation, {types::Value::of(2), types::Value::of(0.5)});
  };
  EXPECT_THAT(asked("jog"), HasSubstr("the robot is not armed: arm first"));
  arm.arm();
  arm.run_for(1s);
  const Vector before = arm.desired();
  ASSERT_EQ(asked("jog"), "");
  for (int i = 0; i < 20; ++i) {
    arm.run_for(50ms);
    ASSERT_EQ(asked("keepJogging"), "");
  }
  const Vector let_go = arm.desired();
  EXPECT_NEAR(let_go[1] - before[1], 0.5, 0.1);
  arm.run_for(150ms);
  EXPECT_NEAR(arm.desired()[1] - let_go[1], 0.5 * 0.15, 0.01);
  arm.run_for(1s);
  const Vector rest = arm.desired();
  EXPECT_LT(rest[1] - let_go[1], 0.5 * 0.15 + 0.1);
  EXPECT_EQ(arm.value<Vector>("Generator", "nAxesDesiredVelocity"), Vector(4, 0.0));
  for (int i = 0; i < 20; ++i) asked("keepJogging");
  arm.run_for(1s);
  EXPECT_EQ(arm.desired(), rest) << "renewals that come late move nothing";
  for (const std::size_t other : {0u, 2u, 3u}) EXPECT_EQ(rest[other], before[other]);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(arm.positions()[i], rest[i], 0.02);
  EXPECT_TRUE(arm.armed()) << arm.reason("WAM");
}

/// The WAM with the other generator, exchanged by one line.
class WamMovedOnline : public ::testing::Test {
 protected:
  WamMovedOnline() : arm("online7.yaml") {
    arm.start_armed();
    arm.run_for(1s);
  }
  /// Of the motion as it is desired, in so many cycles.
  double fastest_tip(int cycles) {
    double fastest = 0.0;
    for (int k = 0; k < cycles; ++k) {
      arm.cycle();
      const Vector velocities = arm.value<Vector>("Generator", "nAxesDesiredVelocity");
      fastest = std::max(fastest, TipSpeed::of(arm.desired(), velocities));
    }
    return fastest;
  }
  Arm arm;
};

TEST_F(WamMovedOnline, IsAtItsFastestWithinWhatTheBoardAllows) {
  const Vector there{1.2, 0.2, 0.0, 1.5, 0.3, 0.0, 0.2};
  EXPECT_THAT(arm.move_to(there, 0.1), HasSubstr("s at least, found 0.1 s"));
  ASSERT_EQ(arm.move_to(there, 0.0), "");
  EXPECT_NEAR(fastest_tip(3000), 0.9 * 0.95, 0.02) << "[m/s]";
  EXPECT_EQ(arm.state("WAM"), component::State::kRunning) << arm.reason("WAM");
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(arm.positions()[i], there[i], 0.02) << i;
}

TEST_F(WamMovedOnline, IsJoggedAsLongAsItIsRenewed) {
  const auto asked = [this](const char* operation) {
    return arm.call("Generator", operation, {types::Value::of(2), types::Value::of(0.5)});
  };
  const Vector before = arm.desired();
  ASSERT_EQ(asked("jog"), "");
  for (int i = 0; i < 20; ++i) {
    arm.run_for(50ms);
    ASSERT_EQ(asked("keepJogging"), "");
  }
  const Vector let_go = arm.desired();
  EXPECT_NEAR(let_go[1] - before[1], 0.5, 0.1);
  arm.run_for(1s);
  EXPECT_LT(arm.desired()[1] - let_go[1], 0.5 * 0.15 + 0.1);
  EXPECT_EQ(arm.value<Vector>("Generator", "nAxesDesiredVelocity"), Vector(7, 0.0));
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(arm.positions()[i], arm.desired()[i], 0.02);
  EXPECT_TRUE(arm.armed()) << arm.reason("WAM");
}

}  // namespace
}  // namespace armature::wam
