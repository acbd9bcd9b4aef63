// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/pid/pid.hpp"

#include <chrono>
#include <limits>
#include <memory>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/face.hpp"
#include "armature/component/interface.hpp"
#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class PidTest : public ::testing::Test {
 protected:
  PidTest() {
    pid.set("UMin", -10.0);
    pid.set("UMax", 10.0);
    pid.set("Kp", 2.0);
    pid.set("Ki", 0.5);
    pid.set("Kd", 1.0);
  }
  double step(double desired, double measured) {
    pid.write("Ref", desired);
    pid.write("Sen", measured);
    return pid.output<double>("Out");
  }

  testing::Harness pid{std::make_unique<Pid>("PID")};
};

TEST_F(PidTest, IsThePaperOnesEquationSix) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  EXPECT_DOUBLE_EQ(step(1.0, 0.0), 0.5);  // no kick: Ki e alone
  EXPECT_DOUBLE_EQ(step(1.0, 0.2), 0.5 - 2.0 * 0.2 + 0.5 * 0.8 - 0.2);
  const double before = pid.output<double>("Out");
  EXPECT_DOUBLE_EQ(step(1.0, 0.5), before - 2.0 * 0.3 + 0.5 * 0.5 + (0.5 - 1.6 + 1.0));
}

TEST_F(PidTest, StepsOnceForEachValueOfSen) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  pid.write("Ref", 1.0);
  pid.write("Ref", 2.0);
  EXPECT_EQ(pid.writes("Out"), 0u);
  pid.write("Sen", 0.0);
  EXPECT_EQ(pid.writes("Out"), 1u);
  EXPECT_EQ(pid.output<double>("Out"), 1.0);
}

TEST_F(PidTest, SaysNothingBeforeTheFirstReference) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  pid.write("Sen", 3.0);
  EXPECT_EQ(pid.writes("Out"), 0u);
}

TEST_F(PidTest, DoesNotUseAReferenceFromBeforeItsStart) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  step(1.0, 0.0);
  pid.stop();
  pid.advance(10ms);
  ASSERT_TRUE(pid.start()) << pid.reason();
  pid.write("Sen", 0.0);
  EXPECT_EQ(pid.writes("Out"), 1u);
  step(2.0, 0.0);
  EXPECT_EQ(pid.output<double>("Out"), 1.0);
}

TEST_F(PidTest, Saturates) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  EXPECT_EQ(step(100.0, 0.0), 10.0);
  EXPECT_EQ(step(-100.0, 0.0), -10.0);
}

TEST_F(PidTest, NeitherResetNorAStartKicks) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  step(5.0, 0.0);
  step(5.0, 1.0);
  ASSERT_TRUE(pid.call("reset"));
  EXPECT_DOUBLE_EQ(step(4.0, 1.0), 0.5 * 3.0);
  pid.stop();
  ASSERT_TRUE(pid.start()) << pid.reason();
  EXPECT_DOUBLE_EQ(step(4.0, 2.0), 0.5 * 2.0);
}

TEST_F(PidTest, GainsMayChangeWhileItRunsWithoutAJump) {
  pid.set("GainFadeTime", 0.0);
  ASSERT_TRUE(pid.start()) << pid.reason();
  step(1.0, 0.0);
  const double before = step(1.0, 0.0);
  pid.set("Kp", 500.0);
  pid.set("Ki", 0.0);
  EXPECT_DOUBLE_EQ(step(1.0, 0.0), before);
  EXPECT_NEAR(step(1.0, 0.001), before - 500.0 * 0.001 - 0.001, 1e-12);
}

TEST_F(PidTest, RefusesGainsAndLimitsThatCannotBe) {
  EXPECT_THROW(pid.set("Kp", -1.0), std::invalid_argument);
  EXPECT_THROW(pid.set("Ki", std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  pid.set("UMin", 10.0);
  const auto outcome = pid.start();
  ASSERT_FALSE(outcome);
  EXPECT_THAT(pid.reason(), HasSubstr("u_max is 10, expected a number above u_min"));
}

TEST_F(PidTest, FaultsIfADifferenceIsNoNumber) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  step(1.0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(pid.state(), component::State::kException);
  EXPECT_EQ(pid.reason(), "Ref - Sen is 1 - nan, expected finite numbers");
  EXPECT_EQ(pid.writes("Out"), 0u);
}

TEST_F(PidTest, StopsBeforeItUsesAReferenceThatIsTooOld) {
  ASSERT_TRUE(pid.start()) << pid.reason();
  step(1.0, 0.0);
  pid.advance(60ms);
  pid.write("Sen", 0.1);
  EXPECT_EQ(pid.writes("Out"), 2u);
  pid.advance(60ms);
  pid.write("Sen", 0.2);
  EXPECT_EQ(pid.writes("Out"), 2u);
  EXPECT_EQ(pid.state(), component::State::kStopped);
  EXPECT_EQ(pid.reason(), "input 'Ref': its data is older than declared");
}

TEST_F(PidTest, GoesOnFromWhatItsPredecessorWroteAndDesired) {
  struct Other : component::Component {
    using Component::Component;
    component::OutputPort<double> port{this, "Out", "", "V"};
  } other("Other");
  other.port.set_sample(3.0);
  pid.write("Ref", 1.0);
  pid.advance(10ms);
  auto& out = *component::interface_of(pid.component()).outputs.front();
  out.take_over_from(&face(other.port));
  ASSERT_TRUE(pid.start()) << pid.reason();
  out.take_over_from(nullptr);
  pid.write("Sen", 0.8);
  EXPECT_DOUBLE_EQ(pid.output<double>("Out"), 3.0 + 0.5 * 0.2) << "its integral alone";
}

/// Along a ramp the damper's output changes by its gain: that of the moment.
TEST_F(PidTest, GainsThatAreChangedWhileItRunsFadeIn) {
  pid.set("Kp", 1.0);
  pid.set("Ki", 0.0);
  pid.set("Kd", 0.0);
  ASSERT_TRUE(pid.start()) << pid.reason();
  step(1.0, 0.0);
  pid.set("Kp", 3.0);
  double measured = 0.0;
  const auto gain = [&] {
    const double before = pid.output<double>("Out");
    measured -= 0.01;
    return (step(1.0, measured) - before) / 0.01;
  };
  EXPECT_NEAR(gain(), 1.0, 1e-9);
  pid.advance(100ms);
  EXPECT_NEAR(gain(), 2.0, 1e-9);
  pid.advance(50ms);
  EXPECT_NEAR(gain(), 2.5, 1e-9);
  pid.advance(50ms);
  EXPECT_NEAR(gain(), 3.0, 1e-9);
  EXPECT_NEAR(gain(), 3.0, 1e-9);
}

}  // namespace
}  // namespace armature::controllers
