// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/clock.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::platform {
namespace {

TEST(Clock, NeverGoesBack) {
  base::Time last = monotonic_now();
  for (int i = 0; i < 100000; ++i) {
    const base::Time now = monotonic_now();
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST(Clock, HasAResolution) {
  EXPECT_GT(clock_resolution(), base::Duration::zero());
  EXPECT_LE(clock_resolution(), std::chrono::milliseconds(10));
}

TEST(Clock, SleepsUntilTheDeadlineAndNotLess) {
  const base::Time deadline = monotonic_now() + std::chrono::milliseconds(2);
  sleep_until(deadline);
  EXPECT_GE(monotonic_now(), deadline);
}

TEST(Clock, ADeadlineInThePastReturns) {
  sleep_until(monotonic_now() - std::chrono::hours(1));
  sleep_until(base::Time{});
}

TEST(Clock, TicksGoOnAndHaveAPeriod) {
  const std::uint64_t before = ticks();
  sleep_until(monotonic_now() + std::chrono::milliseconds(1));
  EXPECT_GT(ticks(), before);
  EXPECT_GT(tick_period_ns(), 0.0);
  EXPECT_EQ(tick_period_ns(), tick_period_ns());
}

TEST(Clock, WritesTheWallClockAsText) {
  EXPECT_THAT(
      std::string(wall_clock_text().text),
      ::testing::MatchesRegex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}\\.[0-9]{6}"));
}

}  // namespace
}  // namespace armature::platform
