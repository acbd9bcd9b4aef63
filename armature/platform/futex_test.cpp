// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/futex.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "armature/platform/clock.hpp"

namespace armature::platform {
namespace {

TEST(Futex, DoesNotSleepOnAWordThatHasChanged) {
  std::atomic<std::uint32_t> word{1};
  futex_wait(word, 0);
  EXPECT_TRUE(futex_wait_until(word, 0, monotonic_now() + std::chrono::hours(1)));
}

TEST(Futex, SaysWhenTheTimeRanOut) {
  std::atomic<std::uint32_t> word{0};
  EXPECT_FALSE(futex_wait_until(word, 0, base::Time{}));
  const base::Time deadline = monotonic_now() + std::chrono::milliseconds(2);
  while (futex_wait_until(word, 0, deadline)) {
  }
  EXPECT_GE(monotonic_now(), deadline);
}

TEST(Futex, WakesASleeper) {
  std::atomic<std::uint32_t> word{0};
  std::thread sleeper([&] {
    while (word == 0) futex_wait(word, 0);
  });
  word = 1;
  futex_wake_one(word);
  sleeper.join();
}

}  // namespace
}  // namespace armature::platform
