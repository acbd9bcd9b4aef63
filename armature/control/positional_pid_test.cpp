// SPDX-License-Identifier: Apache-2.0
#include "armature/control/positional_pid.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::HasSubstr;

PositionalPid make(const PositionalPid::Config& config) {
  const auto made = PositionalPid::make(config);
  EXPECT_TRUE(made.ok()) << made.error();
  return made.value();
}

TEST(PositionalPid, OfTheFirstJointOfTheWamIsAsItsFactsHaveIt) {
  PositionalPid unlimited = make({.kp = 900, .ki = 2.5, .kd = 10, .period_s = 0.002});
  EXPECT_NEAR(unlimited.step(0.01), 59.0, 1e-12);
  PositionalPid pid = make({.kp = 900, .ki = 2.5, .kd = 10, .max_output = 25, .period_s = 0.002});
  EXPECT_EQ(pid.step(0.01), 25.0);
  EXPECT_NEAR(pid.step(0.01), 9.00005, 1e-12);
}

TEST(PositionalPid, IsItsFormulaForAnyErrors) {
  PositionalPid pid = make({.kp = 30, .ki = 20, .kd = 0.4, .period_s = 0.01});
  double sum = 0.0, last = 0.0;
  for (int k = 0; k < 200; ++k) {
    const double error = std::sin(0.1 * k) + 0.2;
    sum += last;
    EXPECT_NEAR(pid.step(error), 30 * error + 20 * 0.01 * sum + 0.4 * (error - last) / 0.01, 1e-9);
    last = error;
  }
}

TEST(PositionalPid, ItsSumWindsUpToItsOwnLimitOnly) {
  PositionalPid pid = make({.ki = 100, .max_integral = 3, .max_output = 2, .period_s = 0.01});
  for (int k = 0; k < 10; ++k) pid.step(1.0);
  EXPECT_EQ(pid.state().integral, 3.0);
  EXPECT_EQ(pid.step(-1.0), 2.0);
  EXPECT_EQ(pid.step(-1.0), 2.0);
  EXPECT_EQ(pid.step(-1.0), 1.0) << "3 - 2 x 100 x 0.01";
}

TEST(PositionalPid, AResetForgetsThePast) {
  PositionalPid pid = make({.kp = 1, .ki = 1, .kd = 1, .period_s = 0.5});
  const double first = pid.step(0.3);
  pid.step(0.7);
  pid.reset();
  EXPECT_EQ(pid.step(0.3), first);
}

TEST(PositionalPid, ResetToItsErrorItDoesNotKick) {
  PositionalPid pid = make({.kp = 2, .ki = 1, .kd = 1, .period_s = 0.5});
  pid.step(0.9);
  pid.reset_to(0.3);
  EXPECT_NEAR(pid.step(0.3), 2 * 0.3 + 1 * 0.5 * 0.3, 1e-15);
}

TEST(PositionalPid, AnErrorThatIsNoNumberIsNotHidden) {
  PositionalPid pid = make({.kp = 1, .ki = 1, .period_s = 0.5});
  pid.step(0.3);
  EXPECT_TRUE(std::isnan(pid.step(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(pid.step(std::numeric_limits<double>::infinity())));
  EXPECT_NEAR(pid.step(0.3), 0.3 + 0.5 * 0.3, 1e-15) << "the state is as it was";
}

TEST(PositionalPid, RefusesWhatCannotBeNamingIt) {
  const auto mistake = PositionalPid::make({.kp = -1, .period_s = 0}).error();
  EXPECT_THAT(mistake, HasSubstr("kp is -1"));
  EXPECT_THAT(mistake, HasSubstr("period_s is 0"));
}

}  // namespace
}  // namespace armature::control
