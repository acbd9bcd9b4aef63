// SPDX-License-Identifier: Apache-2.0
#include "armature/control/pid.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Pid::Config kGains{.kp = 8.0, .ki = 0.5, .kd = 2.0, .u_min = -12.0, .u_max = 12.0};

Pid make(const Pid::Config& config) { return Pid::make(config).value(); }

std::string mistake(Pid::Config config) {
  const auto made = Pid::make(config);
  return made ? "" : made.error();
}

TEST(Pid, IsEquationSix) {
  Pid pid = make(kGains);
  EXPECT_DOUBLE_EQ(pid.step(0.1), 0.5 * 0.1);
  // 0.05 + 8 (0.2 - 0.1) + 0.5 0.2 + 2 (0.2 - 2 0.1 + 0.1)
  EXPECT_DOUBLE_EQ(pid.step(0.2), 0.05 + 0.8 + 0.1 + 0.2);
  // 1.15 + 8 (0.1 - 0.2) + 0.5 0.1 + 2 (0.1 - 2 0.2 + 0.1)
  EXPECT_NEAR(pid.step(0.1), 1.15 - 0.8 + 0.05 - 0.4, 1e-12);
}

TEST(Pid, TheFirstStepDoesNotKick) {
  Pid pid = make(kGains);
  EXPECT_DOUBLE_EQ(pid.step(3.0), 1.5) << "neither kp nor kd act on an error that was there before";
  pid.step(-1.0);
  pid.reset();
  EXPECT_DOUBLE_EQ(pid.step(3.0), 1.5) << "after a reset neither";
}

TEST(Pid, TakesOverFromAPresentOutput) {
  Pid pid = make(kGains);
  pid.step(1.0);
  pid.reset_to(7.25);
  EXPECT_DOUBLE_EQ(pid.step(0.0), 7.25);
  pid.reset_to(-7.25);
  EXPECT_DOUBLE_EQ(pid.step(2.0), -6.25);
}

TEST(Pid, ATakenOverOutputIsSaturatedAndFinite) {
  Pid pid = make(kGains);
  pid.reset_to(100.0);
  EXPECT_DOUBLE_EQ(pid.step(0.0), 12.0);
  pid.reset_to(kNan);
  EXPECT_DOUBLE_EQ(pid.step(0.0), 0.0);
  pid.reset_to(-kInfinity);
  EXPECT_DOUBLE_EQ(pid.step(0.0), 0.0);
}

TEST(Pid, ResetStaysWithinLimitsThatExcludeZero) {
  Pid pid = make({.kp = 1.0, .ki = 0.0, .kd = 0.0, .u_min = 2.0, .u_max = 3.0});
  EXPECT_DOUBLE_EQ(pid.step(0.0), 2.0);
}

TEST(Pid, SaturationDoesNotWindUp) {
  Pid pid = make({.kp = 0.0, .ki = 1.0, .kd = 0.0, .u_min = -10.0, .u_max = 10.0});
  for (int i = 0; i < 1000; ++i) EXPECT_LE(pid.step(1.0), 10.0);
  EXPECT_DOUBLE_EQ(pid.state().output, 10.0);
  EXPECT_DOUBLE_EQ(pid.step(-1.0), 9.0) << "leaves the limit with the first error of other sign";
}

TEST(Pid, AnErrorThatIsNotFiniteIsHandedOnAndForgotten) {
  Pid pid = make(kGains);
  Pid twin = pid;
  for (const double error : {0.3, 0.1, -0.2}) {
    EXPECT_TRUE(std::isnan(pid.step(kNan)));
    EXPECT_TRUE(std::isnan(pid.step(kInfinity)));
    EXPECT_TRUE(std::isnan(pid.step(-kInfinity)));
    EXPECT_DOUBLE_EQ(pid.step(error), twin.step(error));
  }
}

TEST(Pid, ReconfiguredItDoesNotJump) {
  Pid pid = make(kGains);
  for (int i = 0; i < 10; ++i) pid.step(0.1);
  const double before = pid.state().output;
  auto stiffer = kGains;
  stiffer.kp = 800.0;
  stiffer.kd = 200.0;
  EXPECT_TRUE(pid.reconfigure(stiffer).ok());
  EXPECT_DOUBLE_EQ(pid.step(0.1), before + 0.5 * 0.1);
  stiffer.ki = -1.0;
  EXPECT_FALSE(pid.reconfigure(stiffer).ok());
  EXPECT_EQ(pid.config().ki, 0.5) << "nothing changes on an error";
}

TEST(Pid, ARefusedConfigurationNamesEveryFieldThatIsWrong) {
  EXPECT_EQ(mistake({.kp = -1.0, .ki = 0.0, .kd = 0.0, .u_min = -1.0, .u_max = 1.0}),
            "Pid: kp is -1, expected a finite number of at least 0");
  const auto text = mistake({.kp = 1.0, .ki = kNan, .kd = kInfinity, .u_min = 2.0, .u_max = 1.0});
  EXPECT_THAT(text, HasSubstr("ki is nan, expected"));
  EXPECT_THAT(text, HasSubstr("kd is inf, expected"));
  EXPECT_THAT(text, HasSubstr("u_max is 1, expected a number above u_min"));
  EXPECT_THAT(text, Not(HasSubstr("kp")));
  EXPECT_THAT(mistake({.u_min = -kInfinity, .u_max = kNan}), HasSubstr("u_min is -inf"));
  EXPECT_THAT(mistake({.u_min = 0.0, .u_max = kNan}), HasSubstr("u_max is nan"));
}

TEST(Pid, EqualsThePositionFormWhileItDoesNotSaturate) {
  std::mt19937_64 random(4711);
  std::uniform_real_distribution<double> errors(-1.0, 1.0);
  Pid pid = make({.kp = 3.0, .ki = 0.1, .kd = 5.0, .u_min = -1e6, .u_max = 1e6});
  const double first = errors(random);
  double last = first;
  double sum = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    const double error = i == 0 ? first : errors(random);
    sum += error;
    const double expected = 3.0 * (error - first) + 0.1 * sum + 5.0 * (error - last);
    ASSERT_NEAR(pid.step(error), expected, 1e-9);
    last = error;
  }
}

TEST(Pid, NoErrorLeadsOutOfTheLimits) {
  std::mt19937_64 random(815);
  std::uniform_real_distribution<double> exponent(-308.0, 308.0);
  Pid pid = make(kGains);
  for (int i = 0; i < 100'000; ++i) {
    const double output = pid.step((i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent(random)));
    ASSERT_TRUE(std::isnan(output) || std::abs(output) <= 12.0) << output;
    ASSERT_TRUE(std::isfinite(pid.state().output));
  }
}

}  // namespace
}  // namespace armature::control
