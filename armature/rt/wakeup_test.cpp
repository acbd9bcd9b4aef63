// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/wakeup.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "armature/platform/clock.hpp"

namespace armature::rt {
namespace {

TEST(Wakeup, HasNothingPendingAtFirst) {
  Wakeup wakeup;
  EXPECT_FALSE(wakeup.try_wait());
}

TEST(Wakeup, ANotificationBeforeTheWaitEndsIt) {
  Wakeup wakeup;
  wakeup.notify();
  wakeup.wait();
  EXPECT_FALSE(wakeup.try_wait());
}

TEST(Wakeup, SeveralNotificationsCountAsOne) {
  Wakeup wakeup;
  for (int i = 0; i < 3; ++i) wakeup.notify();
  EXPECT_TRUE(wakeup.try_wait());
  EXPECT_FALSE(wakeup.try_wait());
}

TEST(Wakeup, ASleeperIsWoken) {
  Wakeup wakeup;
  Wakeup answer;
  std::thread sleeper([&] {
    wakeup.wait();
    answer.notify();
  });
  wakeup.notify();
  answer.wait();
  sleeper.join();
}

TEST(Wakeup, AWaitWithADeadlineEndsByItself) {
  Wakeup wakeup;
  const base::Time deadline = platform::monotonic_now() + std::chrono::milliseconds(2);
  EXPECT_FALSE(wakeup.wait_until(deadline));
  EXPECT_GE(platform::monotonic_now(), deadline);
  EXPECT_FALSE(wakeup.wait_until(base::Time{}));
}

TEST(Wakeup, APendingNotificationCountsEvenAfterTheDeadline) {
  Wakeup wakeup;
  wakeup.notify();
  EXPECT_TRUE(wakeup.wait_until(base::Time{}));
  EXPECT_FALSE(wakeup.wait_until(base::Time{}));
}

TEST(Wakeup, WorksAsBeforeAfterADeadlineHasPassed) {
  Wakeup wakeup;
  EXPECT_FALSE(wakeup.wait_until(base::Time{}));
  wakeup.notify();
  wakeup.wait();
  EXPECT_FALSE(wakeup.try_wait());
}

TEST(Wakeup, ANotificationEndsAWaitLongBeforeItsDeadline) {
  Wakeup wakeup;
  const base::Time deadline = platform::monotonic_now() + std::chrono::hours(1);
  std::thread notifier([&] { wakeup.notify(); });
  EXPECT_TRUE(wakeup.wait_until(deadline));
  notifier.join();
}

}  // namespace
}  // namespace armature::rt
