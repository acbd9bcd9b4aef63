// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/periodic_schedule.hpp"

#include <chrono>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace armature::exec {
namespace {

using namespace std::chrono_literals;

constexpr base::Time kStart = base::time_from_ns(123'456'789);

TEST(PeriodicSchedule, TheFirstCycleIsDueOnePeriodAfterTheStart) {
  PeriodicSchedule schedule(10ms, false);
  schedule.begin(kStart);
  EXPECT_EQ(schedule.next(), kStart + 10ms);
  EXPECT_EQ(schedule.settle(kStart).run, 0u);
  EXPECT_EQ(schedule.settle(kStart + 10ms - 1ns).run, 0u);
  const auto due = schedule.settle(kStart + 10ms);
  EXPECT_EQ(due.run, 1u);
  EXPECT_EQ(due.skipped, 0u);
  EXPECT_EQ(due.lateness, 0ns);
  EXPECT_EQ(schedule.next(), kStart + 20ms);
}

TEST(PeriodicSchedule, LatenessDoesNotAddUp) {
  PeriodicSchedule schedule(10ms, false);
  schedule.begin(kStart);
  for (int cycle = 1; cycle <= 1000; ++cycle) {
    EXPECT_EQ(schedule.settle(kStart + cycle * 10ms + 9ms).lateness, 9ms);
  }
  EXPECT_EQ(schedule.next(), kStart + 10'010ms);
  EXPECT_EQ(schedule.late_in_a_row(), 0);
}

TEST(PeriodicSchedule, SkippingRunsOneCycleForAllThatPassed) {
  PeriodicSchedule schedule(10ms, false);
  schedule.begin(kStart);
  const auto due = schedule.settle(kStart + 45ms);
  EXPECT_EQ(due.run, 1u);
  EXPECT_EQ(due.skipped, 3u);
  EXPECT_EQ(due.lateness, 35ms);
  EXPECT_EQ(schedule.next(), kStart + 50ms);
}

TEST(PeriodicSchedule, CatchingUpRunsAll) {
  PeriodicSchedule schedule(10ms, true);
  schedule.begin(kStart);
  const auto due = schedule.settle(kStart + 45ms);
  EXPECT_EQ(due.run, 4u);
  EXPECT_EQ(due.skipped, 0u);
  EXPECT_EQ(schedule.next(), kStart + 50ms);
}

TEST(PeriodicSchedule, LateWakeUpsInARowAreCountedUntilOneIsInTime) {
  PeriodicSchedule schedule(10ms, false);
  schedule.begin(kStart);
  schedule.settle(kStart + 20ms);
  EXPECT_EQ(schedule.late_in_a_row(), 1) << "late by exactly a period";
  schedule.settle(kStart + 55ms);
  EXPECT_EQ(schedule.late_in_a_row(), 2);
  schedule.settle(kStart + 69ms);
  EXPECT_EQ(schedule.late_in_a_row(), 0);
}

TEST(PeriodicSchedule, ANewBeginningForgetsEverything) {
  PeriodicSchedule schedule(10ms, false);
  schedule.begin(kStart);
  schedule.settle(kStart + 45ms);
  schedule.begin(kStart + 1s);
  EXPECT_EQ(schedule.cycles_run(), 0u);
  EXPECT_EQ(schedule.cycles_skipped(), 0u);
  EXPECT_EQ(schedule.late_in_a_row(), 0);
  EXPECT_EQ(schedule.next(), kStart + 1s + 10ms);
}

/// Wake-ups at random times: often early, mostly in time, sometimes very late.
base::Duration random_step(std::mt19937_64& random, base::Duration period) {
  const auto ns = static_cast<std::uint64_t>(period.count());
  switch (random() % 4) {
    case 0:
      return base::Duration(random() % (ns / 4 + 1));
    case 1:
      return base::Duration(random() % (50 * ns));
    default:
      return base::Duration(random() % (2 * ns));
  }
}

TEST(PeriodicSchedule, WhatPassedIsRunOrSkippedExactlyWheneverItWakes) {
  std::mt19937_64 random(4711);
  for (int round = 0; round < 200; ++round) {
    const base::Duration period(1 + random() % 1'000'000'007);
    const bool catch_up = round % 2 == 0;
    PeriodicSchedule schedule(period, catch_up);
    schedule.begin(kStart);
    base::Time now = kStart;
    std::uint64_t run = 0;
    std::uint64_t skipped = 0;
    for (int step = 0; step < 1000; ++step) {
      now += random_step(random, period);
      const auto due = schedule.settle(now);
      run += due.run;
      skipped += due.skipped;
      const auto passed = static_cast<std::uint64_t>((now - kStart) / period);
      ASSERT_EQ(run + skipped, passed);
      ASSERT_EQ(schedule.cycles_run(), run);
      ASSERT_EQ(schedule.cycles_skipped(), skipped);
      ASSERT_TRUE(!catch_up || skipped == 0);
      ASSERT_TRUE(catch_up || due.run <= 1);
      ASSERT_GT(schedule.next(), now);
      ASSERT_LE(schedule.next() - now, period);
      ASSERT_EQ((schedule.next() - kStart) % period, 0ns);
    }
  }
}

TEST(PeriodicSchedule, FollowsRecordedTimes) {
  PeriodicSchedule schedule(10ms, false);
  schedule.follow({kStart + 3ms, kStart + 4ms, kStart + 40ms});
  schedule.begin(kStart);
  EXPECT_EQ(schedule.settle(kStart + 2ms).run, 0u);
  EXPECT_EQ(schedule.next(), kStart + 3ms);
  for (const base::Duration time : {3ms, 4ms, 40ms}) {
    const auto due = schedule.settle(kStart + time);
    EXPECT_EQ(due.run, 1u);
    EXPECT_EQ(due.skipped, 0u) << "nobody was late";
    EXPECT_EQ(due.lateness, 0ms);
  }
  EXPECT_EQ(schedule.next(), base::Time::max());
  schedule.begin(kStart);
  EXPECT_EQ(schedule.next(), kStart + 3ms) << "and again";
}

TEST(PeriodicSchedule, YearsOfShortCyclesStayExact) {
  PeriodicSchedule schedule(1us, false);
  schedule.begin(kStart);
  const base::Duration years = std::chrono::hours(24 * 365 * 20);
  const auto due = schedule.settle(kStart + years);
  EXPECT_EQ(due.run + due.skipped, static_cast<std::uint64_t>(years / 1us));
}

}  // namespace
}  // namespace armature::exec
