// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/periodic_schedule.hpp"

#include <random>

#include <gtest/gtest.h>

namespace armature::exec {
namespace {

using namespace std::chrono_literals;

constexpr base::Time kStart = base::time_from_ns(1'000'000'007);

TEST(PeriodicSchedule, NothingIsDueBeforeTheFirstPeriodIsOver) {
  PeriodicSchedule schedule(1ms, false);
  schedule.begin(kStart);
  EXPECT_EQ(schedule.settle(kStart + 999'999ns).run, 0u);
  EXPECT_EQ(schedule.settle(kStart + 1ms).run, 1u);
  EXPECT_EQ(schedule.settle(kStart + 1ms).run, 0u);
}

TEST(PeriodicSchedule, SkipsAllButOneOfTheCyclesWhoseTimeHasPassed) {
  PeriodicSchedule schedule(1ms, false);
  schedule.begin(kStart);
  const auto due = schedule.settle(kStart + 4ms + 300us);
  EXPECT_EQ(due.run, 1u);
  EXPECT_EQ(due.skipped, 3u);
  EXPECT_EQ(due.lateness, 3ms + 300us);
  EXPECT_EQ(schedule.next(), kStart + 5ms);
}

TEST(PeriodicSchedule, RunsThemAllIfItIsToCatchUp) {
  PeriodicSchedule schedule(1ms, true);
  schedule.begin(kStart);
  const auto due = schedule.settle(kStart + 4ms + 300us);
  EXPECT_EQ(due.run, 4u);
  EXPECT_EQ(due.skipped, 0u);
}

TEST(PeriodicSchedule, CountsLateWakeUpsInARowAndForgetsThemAfterOneInTime) {
  PeriodicSchedule schedule(1ms, false);
  schedule.begin(kStart);
  schedule.settle(kStart + 2ms);
  schedule.settle(kStart + 4ms);
  EXPECT_EQ(schedule.late_in_a_row(), 2);
  schedule.settle(kStart + 5ms + 900us);
  EXPECT_EQ(schedule.late_in_a_row(), 0);
}

TEST(PeriodicSchedule, ElapsedTimeByPeriodIsCyclesRunPlusCyclesSkippedExactly) {
  std::mt19937_64 random(20);
  for (const bool catch_up : {false, true}) {
    for (const base::Duration period : {base::Duration(1ms), base::Duration(333'333ns)}) {
      PeriodicSchedule schedule(period, catch_up);
      schedule.begin(kStart);
      base::Time now = kStart;
      for (int i = 0; i < 100'000; ++i) {
        const auto most = i % 100 == 0 ? 20 * period.count() : 2 * period.count();
        now += base::Duration(std::uniform_int_distribution<std::int64_t>(0, most)(random));
        schedule.settle(now);
        const auto due = static_cast<std::uint64_t>((now - kStart) / period);
        ASSERT_EQ(schedule.cycles_run() + schedule.cycles_skipped(), due);
      }
      EXPECT_EQ(schedule.cycles_skipped() == 0, catch_up);
    }
  }
}

}  // namespace
}  // namespace armature::exec
