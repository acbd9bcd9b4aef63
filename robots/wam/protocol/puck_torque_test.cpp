// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/protocol/puck_torque.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"

namespace armature::wam {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::Le;

std::vector<int> frames(PuckTorque& torque, int count) {
  std::vector<int> sent;
  for (int i = 0; i < count; ++i) sent.push_back(torque.next());
  return sent;
}

TEST(PuckTorque, TheFirstIsRoundedDown) {
  for (const double units : {3.9, -3.1, 0.4, -0.4}) {
    PuckTorque torque;
    torque.set(units);
    EXPECT_EQ(torque.next(), std::floor(units)) << units;
  }
}

TEST(PuckTorque, WhatIsLeftIsAddedToTheNext) {
  PuckTorque torque;
  torque.set(2.25);
  EXPECT_THAT(frames(torque, 8), ElementsAre(2, 2, 2, 3, 2, 2, 2, 3));
  PuckTorque negative;
  negative.set(-2.25);
  EXPECT_THAT(frames(negative, 8), ElementsAre(-3, -2, -2, -2, -3, -2, -2, -2));
}

TEST(PuckTorque, TheMeanIsWhatWasWantedAlsoWhileItChanges) {
  PuckTorque torque;
  double wanted = 0.0, sent = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double units = 100.0 * std::sin(0.01 * i);
    torque.set(units);
    wanted += units;
    sent += torque.next();
    EXPECT_LT(std::abs(wanted - sent), 1.0 + 1e-9) << "after " << i;
  }
}

TEST(PuckTorque, IsNeverMoreThanAUnitOffNorBeyondAWholeNumber) {
  PuckTorque torque;
  torque.set(7.7);
  EXPECT_THAT(frames(torque, 100), Each(AllOf(Ge(7), Le(8))));
  torque.set(4860.0);
  EXPECT_THAT(frames(torque, 100), Each(4860));
  torque.set(-4860.0);
  EXPECT_THAT(frames(torque, 100), Each(-4860));
}

TEST(PuckTorque, FastItStepsByNoMoreThanAUnitBeyondWhatWasWantedAndKeepsTheMean) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> units(-1000.0, 1000.0);
  PuckTorque torque;
  double wanted_before = 0.0, sent_before = 0.0, owed = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    double wanted = units(random);
    if (std::abs(wanted - wanted_before) < 4.0) wanted += 8.0;
    torque.set(wanted);
    const double sent = torque.next();
    const double step = (sent - sent_before) - (wanted - wanted_before);
    ASSERT_LE(std::abs(step), 1.0 + 1e-9) << "from " << wanted_before << " to " << wanted;
    owed += wanted - sent;
    wanted_before = wanted;
    sent_before = sent;
  }
  EXPECT_LT(std::abs(owed), 100.0) << "of 50 000 that rounding down would leave";
}

TEST(PuckTorque, WhatIsOwedIsBounded) {
  PuckTorque torque;
  for (int i = 0; i < 10'000; ++i) {
    torque.set(i % 2 == 0 ? 100.99 : 50.98);  // the one never lets it up, the other lets it stay
    torque.next();
  }
  torque.set(10.5);
  int up = 0;
  for (int i = 0; i < 100; ++i) up += torque.next() - 10;
  EXPECT_LE(up, 50 + 9);
}

TEST(PuckTorque, NothingIsNothing) {
  PuckTorque torque;
  torque.set(0.75);
  frames(torque, 3);
  torque.set(0.0);
  EXPECT_THAT(frames(torque, 10), Each(0));
}

TEST(PuckTorque, IsRealTime) {
  PuckTorque torque;
  int sum = 0;
  testing::RealtimeGuard guard;
  EXPECT_EQ(guard.watch([&] {
    for (int i = 0; i < 100; ++i) {
      torque.set(0.3 * i);
      sum += torque.next();
    }
  }),
            0u)
      << guard.report();
  EXPECT_NEAR(sum, 0.3 * 99 * 50, 1.0);
}

}  // namespace
}  // namespace armature::wam
