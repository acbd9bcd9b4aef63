// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/puck_torque.hpp"

#include <cmath>
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
  torque.set(-2.25);
  EXPECT_THAT(frames(torque, 8), ElementsAre(-3, -2, -2, -2, -3, -2, -2, -2));
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
