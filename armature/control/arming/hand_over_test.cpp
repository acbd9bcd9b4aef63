// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/hand_over.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using Pair = std::array<double, 2>;

Pair step(HandOver& over, Pair signals, base::Duration at, base::Duration time = 1s) {
  over.step(signals, base::Time{} + at, time);
  return signals;
}

TEST(HandOver, LeavesSignalsAsTheyAreUnlessSomethingIsTakenOver) {
  HandOver over(2);
  EXPECT_FALSE(over.active());
  EXPECT_EQ(step(over, {0.1, -0.2}, 5s), (Pair{0.1, -0.2}));
}

TEST(HandOver, TheFirstOutputIsThePresentOneToTheBit) {
  HandOver over(2);
  ASSERT_TRUE(over.begin(Pair{0.1, 1e16}));
  EXPECT_EQ(step(over, {-7.3, 0.3}, 5s), (Pair{0.1, 1e16}));
}

TEST(HandOver, TheDifferenceDiesAwaySmoothlyAndThenOutputsAreTheSignalsToTheBit) {
  HandOver over(2);
  ASSERT_TRUE(over.begin(Pair{4.0, 0.0}));
  step(over, {0.0, 0.0}, 5s);
  double before = 4.0;
  double steepest = 0.0;
  for (int k = 1; k < 100; ++k) {
    const double now = step(over, {0.0, 0.0}, 5s + k * 10ms)[0];
    EXPECT_LT(now, before);
    steepest = std::max(steepest, before - now);
    before = now;
  }
  EXPECT_NEAR(steepest, 1.5 * 4.0 * 0.01, 1e-4);
  EXPECT_LT(before, 0.002) << "it ends as gently as it begins";
  EXPECT_TRUE(over.active());
  EXPECT_EQ(step(over, {0.1, 0.2}, 6s), (Pair{0.1, 0.2}));
  EXPECT_FALSE(over.active());
}

TEST(HandOver, WhereItLearnsNoiseOfTheFirstSignalDiesAwayAtOnce) {
  HandOver over(2);
  ASSERT_TRUE(over.begin(Pair{4.0, 4.0}, 0.05));
  const auto noisy = [](int k) { return Pair{k % 2 == 0 ? 1.2 : 0.8, k == 0 ? 2.0 : 1.0}; };
  step(over, noisy(0), 0s);
  for (int k = 1; k < 25; ++k) step(over, noisy(k), k * 2ms);
  const Pair learnt = step(over, {1.0, 1.0}, 60ms);
  const double left = 1.0 - 0.06 * 0.06 * (3.0 - 0.12);
  EXPECT_NEAR(learnt[0], 1.0 + left * 3.0, 0.01);
  EXPECT_NEAR(learnt[1], 1.0 + left * 3.0, 1.0 / 25);
}

TEST(HandOver, NoiseOfThePresentOutputDiesAwayFirst) {
  HandOver over(2);
  ASSERT_TRUE(over.begin(Pair{5.0, 1.0}, 0.05, Pair{3.0, 1.0}));
  EXPECT_EQ(step(over, {0.0, 0.0}, 0ms), (Pair{5.0, 1.0})) << "no step";
  const Pair soon = step(over, {0.0, 0.0}, 25ms);
  EXPECT_GT(soon[0], 3.0);
  EXPECT_LT(soon[0], 4.2);
  const Pair then = step(over, {0.0, 0.0}, 50ms);
  EXPECT_NEAR(then[0], 3.0 * then[1], 1e-12) << "as one that began with the mean";
  EXPECT_FALSE(over.begin(Pair{5.0, 1.0}, 0.05, std::vector<double>{3.0}));
}

TEST(HandOver, SignalsThatChangeMeanwhileCount) {
  HandOver over(2);
  ASSERT_TRUE(over.begin(Pair{4.0, -4.0}));
  step(over, {1.0, 1.0}, 0s);
  const Pair half = step(over, {2.0, 3.0}, 500ms);
  EXPECT_DOUBLE_EQ(half[0], 2.0 + 0.5 * 3.0);
  EXPECT_DOUBLE_EQ(half[1], 3.0 - 0.5 * 5.0);
}

TEST(HandOver, WithoutATimeNothingIsTakenOver) {
  HandOver over(2);
  ASSERT_TRUE(over.begin(Pair{4.0, 4.0}));
  EXPECT_EQ(step(over, {1.0, 1.0}, 0s, 0s), (Pair{1.0, 1.0}));
  EXPECT_FALSE(over.active());
}

TEST(HandOver, AResetEndsIt) {
  HandOver over(2);
  ASSERT_TRUE(over.begin(Pair{4.0, 4.0}));
  step(over, {1.0, 1.0}, 0s);
  over.reset();
  EXPECT_EQ(step(over, {1.0, 1.0}, 10ms), (Pair{1.0, 1.0}));
}

TEST(HandOver, AnotherNumberOfSignalsIsNotTakenOver) {
  HandOver over(2);
  ASSERT_TRUE(over.begin(Pair{4.0, 4.0}));
  EXPECT_FALSE(over.begin(std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_FALSE(over.active()) << "what was taken over before ended too";
}

TEST(HandOver, ASignalThatIsNoNumberIsNotHidden) {
  HandOver over(2);
  ASSERT_TRUE(over.begin(Pair{4.0, std::numeric_limits<double>::quiet_NaN()}));
  const Pair first = step(over, {std::numeric_limits<double>::quiet_NaN(), 1.0}, 0s);
  EXPECT_TRUE(std::isnan(first[0]));
  EXPECT_EQ(first[1], 1.0) << "nor does one come of what was no number before";
  EXPECT_EQ(step(over, {1.0, 2.0}, 10ms), (Pair{1.0, 2.0}));
}

}  // namespace
}  // namespace armature::control
