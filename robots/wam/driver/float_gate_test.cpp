// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/float_gate.hpp"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace armature::wam {
namespace {

using Vector = std::vector<double>;
using Verdict = FloatGate::Verdict;

class FloatGateTest : public ::testing::Test {
 protected:
  /// The first verdict in so many cycles of 2 ms, and after how many.
  Verdict step(int cycles, const Vector& velocities, const Vector& torques) {
    for (cycles_ = 1; cycles_ <= cycles; ++cycles_) {
      const Verdict verdict = gate.step(velocities, torques);
      if (verdict != Verdict::kNone) return verdict;
    }
    return Verdict::kNone;
  }

  FloatGate gate{{.max_load = {1.0, 0.5}, .period_s = 0.002}};
  int cycles_ = 0;
};

TEST_F(FloatGateTest, AnArmThatItsDescriptionHoldsMayFloatAfterASecondAtRest) {
  gate.begin();
  EXPECT_EQ(step(1000, {0.01, -0.01}, {0.9, -0.4}), Verdict::kMayFloat);
  EXPECT_EQ(cycles_, 500);
  EXPECT_EQ(step(1000, {0.0, 0.0}, {0.0, 0.0}), Verdict::kNone) << "once";
}

TEST_F(FloatGateTest, ALoadKeepsItHeldAndIsNamed) {
  gate.begin();
  EXPECT_EQ(step(1000, {0.0, 0.0}, {0.9, -0.6}), Verdict::kStays);
  EXPECT_EQ(gate.why().view(),
            "joint 2 needs -0.6 Nm beside the weight of its description, expected at most 0.5");
  EXPECT_EQ(step(1000, {0.0, 0.0}, {0.0, 0.0}), Verdict::kNone) << "until the next activation";
}

TEST_F(FloatGateTest, NoiseOfSingleCyclesIsNoLoad) {
  gate.begin();
  Verdict verdict = Verdict::kNone;
  for (int cycle = 0; verdict == Verdict::kNone && cycle < 1000; ++cycle) {
    verdict = gate.step(Vector{0.0, 0.0}, Vector{cycle % 2 == 0 ? 3.0 : -3.0, 0.0});
  }
  EXPECT_EQ(verdict, Verdict::kMayFloat);
}

TEST_F(FloatGateTest, AMotionBeginsTheSecondAnew) {
  gate.begin();
  EXPECT_EQ(step(499, {0.0, 0.0}, {0.0, 0.0}), Verdict::kNone);
  EXPECT_EQ(step(1, {0.2, 0.0}, {0.0, 0.0}), Verdict::kNone);
  EXPECT_EQ(step(499, {0.0, 0.0}, {0.0, 0.0}), Verdict::kNone);
  EXPECT_EQ(step(1, {0.0, 0.0}, {0.0, 0.0}), Verdict::kMayFloat);
}

TEST_F(FloatGateTest, WhatIsNoNumberDoesNotFloat) {
  gate.begin();
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(step(1000, {kNothing, 0.0}, {0.0, 0.0}), Verdict::kNone);
  EXPECT_EQ(step(1000, {0.0, 0.0}, {0.0, kNothing}), Verdict::kStays);
}

TEST_F(FloatGateTest, ClosedItDecidesNothing) {
  EXPECT_EQ(step(1000, {0.0, 0.0}, {0.0, 0.0}), Verdict::kNone) << "never begun";
  gate.begin();
  gate.close();
  EXPECT_EQ(step(1000, {0.0, 0.0}, {0.0, 0.0}), Verdict::kNone);
}

}  // namespace
}  // namespace armature::wam
