// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/stop_priority.hpp"

#include <chrono>
#include <csignal>
#include <functional>

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"

namespace armature::platform {
namespace {

bool is_urgent() {
  return ::sched_getscheduler(0) == SCHED_FIFO || ::getpriority(PRIO_PROCESS, 0) < 0;
}

bool comes_true(const std::function<bool()>& condition) {
  const base::Time end = monotonic_now() + std::chrono::seconds(20);
  while (!condition() && monotonic_now() < end) {
    sleep_until(monotonic_now() + std::chrono::milliseconds(1));
  }
  return condition();
}

/// Does it in a thread of its own, whose priority is nobody else's; the one that waits hears no
/// signals, as it would not wait for what it does with them.
void apart(const std::function<void()>& body) {
  ThreadRequest request;
  request.name = "stopper";
  request.prefault = false;
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  Thread(request, body).join();
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

/// Whether the system grants it to anybody.
bool grants_urgency() {
  bool granted = false;
  apart([&] {
    make_most_urgent(0);
    granted = is_urgent();
  });
  return granted;
}

TEST(StopPriority, IsGivenWhenASignalAsksForAStopAndNotBefore) {
  if (!grants_urgency()) GTEST_SKIP() << "the system grants no priority";
  apart([] {
    const StopSignal stop;
    const StopPriority priority(stop, monotonic_now() + std::chrono::hours(1));
    EXPECT_FALSE(is_urgent());
    ::kill(::getpid(), SIGTERM);
    EXPECT_TRUE(comes_true(is_urgent));
  });
}

TEST(StopPriority, TakesSignalsInPlaceOfItsThreadAlsoTheSecond) {
  apart([] {
    const StopSignal stop;
    const StopPriority priority(stop, monotonic_now() + std::chrono::hours(1));
    for (int i = 0; i < 3; ++i) {
      ::kill(::getpid(), SIGTERM);
      EXPECT_TRUE(comes_true([&] { return stop.received(); })) << i;
      stop.hear_next();
      EXPECT_FALSE(stop.received());
    }
  });
}

TEST(StopPriority, IsGivenWhenTheTimeIsUp) {
  if (!grants_urgency()) GTEST_SKIP() << "the system grants no priority";
  apart([] {
    const StopSignal stop;
    const StopPriority priority(stop, monotonic_now());
    EXPECT_TRUE(comes_true(is_urgent));
  });
}

TEST(Promptness, IsThatOfItsThreadAndOfThoseMadeMeanwhileAndEnds) {
  if (!grants_urgency()) GTEST_SKIP() << "the system grants no priority";
  apart([] {
    const auto niceness = [] { return ::getpriority(PRIO_PROCESS, 0); };
    const int before = niceness();
    {
      const Promptness promptness;
      EXPECT_LT(niceness(), before);
      EXPECT_EQ(::sched_getscheduler(0), SCHED_OTHER) << "behind all with a real-time priority";
      apart([&] { EXPECT_LT(niceness(), before); });
    }
    EXPECT_EQ(niceness(), before);
    apart([&] { EXPECT_EQ(niceness(), before); });
  });
}

TEST(StopPriority, IsNotGivenIfNobodyAsks) {
  apart([] {
    const StopSignal stop;
    { const StopPriority priority(stop, monotonic_now() + std::chrono::hours(1)); }
    EXPECT_FALSE(is_urgent());
  });
}

}  // namespace
}  // namespace armature::platform
