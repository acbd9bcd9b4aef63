// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/owed_wakeups.hpp"

#include <array>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::rt {
namespace {

TEST(OwedWakeups, AThreadWithoutAnAccountNotifiesAtOnce) {
  Wakeup wakeup;
  notify_soon(wakeup);
  EXPECT_TRUE(wakeup.try_wait());
}

TEST(OwedWakeups, AreNotifiedOnceWhenPaid) {
  OwedWakeups owed;
  const OwedWakeups::Account account(owed);
  Wakeup first;
  Wakeup second;
  for (int i = 0; i < 3; ++i) {
    notify_soon(first);
    notify_soon(second);
  }
  EXPECT_TRUE(owed.any());
  EXPECT_FALSE(first.try_wait());
  owed.pay();
  EXPECT_FALSE(owed.any());
  EXPECT_TRUE(first.try_wait());
  EXPECT_TRUE(second.try_wait());
  owed.pay();
  EXPECT_FALSE(first.try_wait());
}

TEST(OwedWakeups, AllArePaidWhenThereIsNoRoomForAnother) {
  OwedWakeups owed;
  const OwedWakeups::Account account(owed);
  std::array<Wakeup, OwedWakeups::kMost + 1> wakeups;
  for (Wakeup& each : wakeups) notify_soon(each);
  for (std::size_t i = 0; i < OwedWakeups::kMost; ++i) EXPECT_TRUE(wakeups[i].try_wait()) << i;
  EXPECT_FALSE(wakeups.back().try_wait());
  owed.pay();
  EXPECT_TRUE(wakeups.back().try_wait());
}

TEST(OwedWakeups, ArePaidWhenTheAccountEnds) {
  OwedWakeups owed;
  Wakeup wakeup;
  {
    const OwedWakeups::Account account(owed);
    notify_soon(wakeup);
  }
  EXPECT_TRUE(wakeup.try_wait());
}

TEST(OwedWakeups, ArePaidBeforeTheThreadSleeps) {
  OwedWakeups owed;
  const OwedWakeups::Account account(owed);
  Wakeup question;
  Wakeup answer;
  std::thread other([&] {
    question.wait();
    answer.notify();
  });
  notify_soon(question);
  EXPECT_TRUE(answer.wait_until(platform::monotonic_now() + std::chrono::seconds(20)));
  other.join();
}

TEST(OwedWakeups, ArePaidBeforeTheThreadMayBlock) {
  OwedWakeups owed;
  const OwedWakeups::Account account(owed);
  Wakeup wakeup;
  notify_soon(wakeup);
  const PermitScope permitted;
  EXPECT_TRUE(wakeup.try_wait());
}

}  // namespace
}  // namespace armature::rt
