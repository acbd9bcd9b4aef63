// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/alarms.hpp"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "armature/platform/clock.hpp"

namespace armature::rt {
namespace {

base::Time at(int nanoseconds) { return base::Time(base::Duration(nanoseconds)); }

TEST(Alarms, OnlyTheOneWhoseTimeHasComeIsWoken) {
  Alarms alarms;
  Wakeup first;
  Wakeup second;
  alarms.set(alarms.add(first), at(10));
  alarms.set(alarms.add(second), at(20));
  EXPECT_EQ(alarms.ring(at(9)), at(10));
  EXPECT_FALSE(first.try_wait());
  EXPECT_EQ(alarms.ring(at(10)), at(20));
  EXPECT_TRUE(first.try_wait());
  EXPECT_FALSE(second.try_wait());
}

TEST(Alarms, ATimeRingsOnce) {
  Alarms alarms;
  Wakeup sleeper;
  alarms.set(alarms.add(sleeper), at(10));
  EXPECT_EQ(alarms.ring(at(11)), base::Time::max());
  EXPECT_TRUE(sleeper.try_wait());
  EXPECT_EQ(alarms.ring(at(12)), base::Time::max());
  EXPECT_FALSE(sleeper.try_wait());
}

TEST(Alarms, WhatIsPutOffDoesNotWakeTheWatch) {
  Alarms alarms;
  Wakeup sleeper;
  const std::size_t number = alarms.add(sleeper);
  alarms.set(number, at(10));
  EXPECT_TRUE(alarms.wait_until(at(0))) << "the first time is earlier than none";
  alarms.set(number, at(20));
  EXPECT_FALSE(alarms.wait_until(at(0)));
  EXPECT_EQ(alarms.ring(at(10)), at(20));
  EXPECT_FALSE(sleeper.try_wait());
  alarms.set(number, at(15));
  EXPECT_TRUE(alarms.wait_until(at(0)));
}

TEST(Alarms, SleepersAreWokenByTheClockAgainAndAgain) {
  Alarms alarms;
  Wakeup sleeper;
  const std::size_t number = alarms.add(sleeper);
  std::atomic<bool> ended{false};
  std::thread watch([&] {
    while (!ended) alarms.wait_until(alarms.ring(platform::monotonic_now()));
  });
  for (int i = 0; i < 20; ++i) {
    const base::Time due = platform::monotonic_now() + std::chrono::microseconds(200);
    alarms.set(number, due);
    sleeper.wait();
    EXPECT_GE(platform::monotonic_now(), due);
  }
  ended = true;
  alarms.wake_watch();
  watch.join();
}

}  // namespace
}  // namespace armature::rt
