// SPDX-License-Identifier: Apache-2.0
#include "armature/control/low_pass.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::HasSubstr;

LowPass make(double omega, double period_s) {
  const auto made = LowPass::make({.omega = omega, .period_s = period_s});
  EXPECT_TRUE(made.ok()) << made.error();
  return made.value();
}

TEST(LowPass, TheStepResponseIsThatOfTheWamsVelocityFilter) {
  LowPass filter = make(180.0, 0.002);
  EXPECT_NEAR(filter.step(1.0), 0.264706, 5e-7);
  EXPECT_NEAR(filter.step(1.0), 0.459343, 5e-7);
  EXPECT_NEAR(filter.step(1.0), 0.602458, 5e-7);
}

TEST(LowPass, ComesToTheContinuousOneAsThePeriodShrinks) {
  LowPass filter = make(3.0, 1e-5);
  double y = 0.0;
  for (int i = 0; i < 100'000; ++i) y = filter.step(1.0);
  EXPECT_NEAR(y, 1.0 - std::exp(-3.0), 1e-4);
}

TEST(LowPass, StaysWhereItIsReset) {
  LowPass filter = make(10.0, 0.1);
  filter.reset_to(0.7);
  EXPECT_EQ(filter.step(0.7), 0.7);
}

TEST(LowPass, RefusesWhatCannotBeNamingIt) {
  const auto mistake = LowPass::make({.omega = -1.0, .period_s = 0.0}).error();
  EXPECT_THAT(mistake, HasSubstr("omega is -1"));
  EXPECT_THAT(mistake, HasSubstr("period_s is 0"));
}

}  // namespace
}  // namespace armature::control
