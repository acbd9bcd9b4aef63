// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/gain_fade.hpp"

#include <chrono>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

using namespace std::chrono_literals;

constexpr Pid::Config kBefore{.kp = 10.0, .ki = 1.0, .kd = 0.0};
constexpr Pid::Config kAfter{.kp = 30.0, .ki = 0.0, .kd = 4.0};

base::Time at(base::Duration time) { return base::Time{} + time; }

TEST(GainFade, GoesEvenlyFromTheGainsBeforeToTheNewOnes) {
  GainFade fade;
  fade.be(kBefore);
  EXPECT_EQ(fade.step(kAfter, at(5s), 200ms).kp, 10.0);
  const Pid::Config halfway = fade.step(kAfter, at(5100ms), 200ms);
  EXPECT_DOUBLE_EQ(halfway.kp, 20.0);
  EXPECT_DOUBLE_EQ(halfway.ki, 0.5);
  EXPECT_DOUBLE_EQ(halfway.kd, 2.0);
  EXPECT_EQ(fade.step(kAfter, at(5200ms), 200ms).kd, 4.0);
  EXPECT_EQ(fade.step(kAfter, at(6s), 200ms).kd, 4.0);
}

TEST(GainFade, ThatIsChangedOnItsWayGoesOnFromWhereItIs) {
  GainFade fade;
  fade.be(kBefore);
  fade.step(kAfter, at(0s), 200ms);
  fade.step(kAfter, at(100ms), 200ms);
  EXPECT_DOUBLE_EQ(fade.step(kBefore, at(110ms), 200ms).kp, 20.0);
  EXPECT_DOUBLE_EQ(fade.step(kBefore, at(210ms), 200ms).kp, 15.0);
  EXPECT_DOUBLE_EQ(fade.step(kBefore, at(310ms), 200ms).kp, 10.0);
}

TEST(GainFade, WithoutATimeTheyAreNewAtOnce) {
  GainFade fade;
  fade.be(kBefore);
  EXPECT_EQ(fade.step(kAfter, at(1s), 0s).kp, 30.0);
}

}  // namespace
}  // namespace armature::control
