// SPDX-License-Identifier: Apache-2.0
#include "armature/base/time.hpp"

#include <gtest/gtest.h>

#include "armature/base/seconds.hpp"

namespace armature::base {
namespace {

using namespace std::chrono_literals;

TEST(Time, CountsNanosecondsSinceTheClockStarted) {
  EXPECT_EQ(to_ns(time_from_ns(1'500)), 1'500);
  EXPECT_EQ(to_ns(Time{}), 0);
}

TEST(Time, DifferencesAreDurations) {
  const Time start = time_from_ns(2'000'000);
  EXPECT_EQ(start + 1ms - start, Duration{1'000'000});
  EXPECT_LT(start, start + 1ns);
}

TEST(Time, LaterIsAtMostTheEndOfTime) {
  const Time start = time_from_ns(2'000'000);
  EXPECT_EQ(later(start, 1ms), start + 1ms);
  EXPECT_EQ(later(start, -1ms), start - 1ms);
  EXPECT_EQ(later(start, Duration::max()), Time::max());
  EXPECT_EQ(later(Time{}, Duration::max()), Time::max());
  EXPECT_EQ(later(Time::max(), 1ns), Time::max());
}

TEST(Seconds, AreTheNearestNanosecondsAndBack) {
  EXPECT_EQ(from_seconds(0.0003), Duration(300'000));
  EXPECT_EQ(from_seconds(1.1), Duration(1'100'000'000));
  EXPECT_EQ(from_seconds(-0.25), Duration(-250'000'000));
  EXPECT_EQ(to_seconds(Duration(1'500'000'000)), 1.5);
}

}  // namespace
}  // namespace armature::base
