// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/velocity_pid/velocity_pid.hpp"

#include <chrono>
#include <limits>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class VelocityPidTest : public ::testing::Test {
 protected:
  VelocityPidTest() {
    pid.set("Kp", 2.0);
    pid.set("Ki", 0.5);
    pid.set("UMin", -10.0);
    pid.set("UMax", 10.0);
    pid.set("Period", 0.01);
  }
  double step(double displacement) {
    pid.advance(10ms);
    pid.write("Sen", displacement);
    return pid.output<double>("Out");
  }

  testing::Harness pid{std::make_unique<VelocityPid>("PID1")};
};

TEST_F(VelocityPidTest, FollowsTheVelocityThatTheDisplacementsHave) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  pid.write("Ref", 3.0);
  EXPECT_DOUBLE_EQ(step(0.01), 0.5 * 2.0);  // at 1 rad/s: Ki e alone, no kick
  EXPECT_DOUBLE_EQ(step(0.02), 1.0 - 2.0 * 1.0 + 0.5 * 1.0);
  EXPECT_DOUBLE_EQ(step(0.03), -0.5 - 2.0 * 1.0);
}

TEST_F(VelocityPidTest, WritesNothingBeforeTheFirstReferenceSinceTheStart) {
  pid.write("Ref", 3.0);
  pid.advance(10ms);
  ASSERT_TRUE(pid.start()) << pid.reason();
  step(0.0);
  EXPECT_EQ(pid.writes("Out"), 0U);
  pid.write("Ref", 3.0);
  step(0.0);
  EXPECT_EQ(pid.writes("Out"), 1U);
}

TEST_F(VelocityPidTest, AWheelThatWasHeldDoesNotCatchUp) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  pid.write("Ref", 3.0);
  for (int k = 0; k < 9; ++k) step(0.0);
  pid.write("Ref", 3.0);
  for (int k = 0; k < 9; ++k) step(0.0);
  EXPECT_EQ(step(0.0), 10.0);
  pid.write("Ref", 0.0);
  EXPECT_LT(step(0.0), 10.0 - 2.0 * 3.0 + 0.1);
}

TEST_F(VelocityPidTest, ForgetsThePastWhenItIsArmed) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  pid.write("Ref", 3.0);
  step(0.0);
  pid.write("Ref", 0.0);
  pid.raise("Arm");
  EXPECT_EQ(step(0.0), 0.0);
}

TEST_F(VelocityPidTest, ANumberThatIsNoneIsAFaultAndIsNotHandedOn) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  pid.write("Ref", std::numeric_limits<double>::quiet_NaN());
  step(0.01);
  EXPECT_EQ(pid.writes("Out"), 0U);
  EXPECT_EQ(pid.state(), component::State::kException);
  EXPECT_EQ(pid.reason(), "Ref is nan and the measured velocity 1, expected finite numbers");
}

TEST_F(VelocityPidTest, StopsWithoutAReferenceFor100Ms) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  pid.write("Ref", 3.0);
  for (int k = 0; k < 9; ++k) {
    step(0.0);
    pid.run_cycles();
  }
  EXPECT_EQ(pid.state(), component::State::kRunning);
  for (int k = 0; k < 4; ++k) {
    step(0.0);
    pid.run_cycles();
  }
  EXPECT_NE(pid.state(), component::State::kRunning);
}

}  // namespace
}  // namespace armature::controllers
