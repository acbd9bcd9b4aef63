// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/thread.hpp"

#include <cstdio>
#include <cstdlib>
#include <future>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace armature::platform {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Thread, RunsItsBodyAndJoins) {
  int ran = 0;
  {
    Thread thread({.name = "worker"}, [&] { ++ran; });
    EXPECT_TRUE(thread.grant().complete());
    EXPECT_EQ(thread.grant().scheduler, Scheduler::kOther);
  }
  EXPECT_EQ(ran, 1);
}

TEST(Thread, CarriesTheFirstFifteenLettersOfItsName) {
  char name[32] = "";
  Thread thread({.name = "controller_of_the_left_arm"},
                [&] { pthread_getname_np(pthread_self(), name, sizeof name); });
  thread.join();
  EXPECT_STREQ(name, "controller_of_t");
}

TEST(Thread, RunsOnTheCpusItAskedFor) {
  cpu_set_t allowed;
  sched_getaffinity(0, sizeof allowed, &allowed);
  int cpu = 0;
  while (!CPU_ISSET(static_cast<std::size_t>(cpu), &allowed)) ++cpu;
  int ran_on = -1;
  Thread thread({.name = "pinned", .cpus = {cpu}}, [&] { ran_on = sched_getcpu(); });
  thread.join();
  EXPECT_THAT(thread.grant().cpus, ElementsAre(cpu));
  EXPECT_TRUE(thread.grant().complete());
  EXPECT_EQ(ran_on, cpu);
}

TEST(Thread, ACpuThatIsNotThereIsRefusedByName) {
  for (const int missing : {1000, 5000, -1}) {
    const Thread thread({.name = "nowhere", .cpus = {missing}}, [] {});
    EXPECT_TRUE(thread.grant().cpus.empty());
    const std::string last = std::to_string(sysconf(_SC_NPROCESSORS_ONLN) - 1);
    EXPECT_THAT(thread.grant().refusals,
                ElementsAre("CPU " + std::to_string(missing) +
                            ": Invalid argument; this machine has CPUs 0.." + last));
  }
}

TEST(Thread, OneMissingCpuAmongOthersIsNotPassedOver) {
  const Thread thread({.name = "half", .cpus = {0, 1000}}, [] {});
  EXPECT_THAT(thread.grant().cpus, ElementsAre(0));
  EXPECT_THAT(thread.grant().refusals, ElementsAre(HasSubstr("CPU 1000: ")));
}

TEST(Thread, IsScheduledAsGranted) {
  int policy = -1;
  sched_param parameters{};
  Thread thread({.name = "fifo", .scheduler = Scheduler::kFifo, .priority = 42},
                [&] { pthread_getschedparam(pthread_self(), &policy, &parameters); });
  thread.join();
  if (!thread.grant().complete()) GTEST_SKIP() << thread.grant().refusals.front();
  EXPECT_EQ(thread.grant().scheduler, Scheduler::kFifo);
  EXPECT_EQ(thread.grant().priority, 42);
  EXPECT_EQ(policy, SCHED_FIFO);
  EXPECT_EQ(parameters.sched_priority, 42);
}

TEST(Thread, RunsWhenIdleFromThenOn) {
  bool done = false;
  int before = -1;
  int after = -1;
  Thread thread({.name = "idle"}, [&] {
    before = sched_getscheduler(0);
    done = run_when_idle();
    after = sched_getscheduler(0);
  });
  thread.join();
  EXPECT_TRUE(done);
  EXPECT_EQ(before, SCHED_OTHER);
  EXPECT_EQ(after, SCHED_IDLE);
}

TEST(Thread, GetsABudgetWhereTheSystemGivesOne) {
  int policy = -1;
  Thread thread({.name = "deadline",
                 .scheduler = Scheduler::kDeadline,
                 .runtime = std::chrono::microseconds(200),
                 .period = std::chrono::milliseconds(10)},
                [&] { policy = sched_getscheduler(0); });
  thread.join();
  if (!thread.grant().complete()) GTEST_SKIP() << thread.grant().refusals.front();
  EXPECT_EQ(thread.grant().scheduler, Scheduler::kDeadline);
  EXPECT_EQ(policy, 6 /* SCHED_DEADLINE */);
}

TEST(Thread, APriorityOutOfRangeIsRefusedWithTheRange) {
  for (const int priority : {0, 100}) {
    const Thread thread({.name = "fifo", .scheduler = Scheduler::kFifo, .priority = priority},
                        [] {});
    EXPECT_EQ(thread.grant().scheduler, Scheduler::kOther);
    EXPECT_THAT(thread.grant().refusals,
                ElementsAre("SCHED_FIFO priority " + std::to_string(priority) +
                            ": Invalid argument; priorities are 1..99"));
  }
}

TEST(Thread, ABudgetLargerThanThePeriodIsRefused) {
  const Thread thread({.name = "deadline",
                       .scheduler = Scheduler::kDeadline,
                       .runtime = std::chrono::milliseconds(2),
                       .period = std::chrono::milliseconds(1)},
                      [] {});
  EXPECT_EQ(thread.grant().scheduler, Scheduler::kOther);
  EXPECT_THAT(thread.grant().refusals, ElementsAre(HasSubstr("SCHED_DEADLINE: ")));
}

/// Ends the process with status 0 and the refusal on stderr if SCHED_FIFO was refused.
[[noreturn]] void ask_without_permission() {
  const rlimit nothing{0, 0};
  ::setrlimit(RLIMIT_RTPRIO, &nothing);
  if (::getuid() == 0 && ::setuid(65534) != 0) std::_Exit(2);
  Thread thread({.name = "fifo", .scheduler = Scheduler::kFifo, .priority = 10}, [] {});
  thread.join();
  if (thread.grant().complete()) std::_Exit(1);
  std::fprintf(stderr, "%s\n", thread.grant().refusals.front().c_str());
  std::_Exit(0);
}

TEST(ThreadDeathTest, ARefusalSaysHowToGetThePermission) {
  EXPECT_EXIT(ask_without_permission(), ::testing::ExitedWithCode(0),
              "SCHED_FIFO priority 10: Operation not permitted; run as root, or allow rtprio in "
              "/etc/security/limits.conf, or give the program CAP_SYS_NICE");
}

TEST(Thread, JoinWithinGivesUpOnABodyThatDoesNotEnd) {
  std::promise<void> release;
  Thread thread({.name = "slow"}, [&] { release.get_future().wait(); });
  EXPECT_FALSE(thread.join_within(std::chrono::milliseconds(1)));
  EXPECT_FALSE(thread.join_within(base::Duration::zero()));
  release.set_value();
  EXPECT_TRUE(thread.join_within(std::chrono::hours(1)));
  EXPECT_TRUE(thread.join_within(base::Duration::zero()));
}

TEST(Thread, AnAbandonedThreadKeepsWhatItCaptured) {
  auto release = std::make_shared<std::promise<void>>();
  std::promise<int> ended;
  auto captured = std::make_shared<int>(42);
  const std::weak_ptr<int> alive = captured;
  {
    Thread thread({.name = "hung"}, [release, captured, &ended] {
      release->get_future().wait();
      ended.set_value(*captured);
    });
    captured.reset();
    thread.abandon();
  }
  EXPECT_FALSE(alive.expired());
  release->set_value();
  EXPECT_EQ(ended.get_future().get(), 42);
}

TEST(Thread, LargeThreadLocalVariablesLeaveRoomForTheRestOfTheStack) {
  // They lie on the thread's stack; touching all that was asked for would go beyond its end.
  alignas(8) thread_local char large[256 * 1024];  // aligned: see tests/link
  char* in_thread = nullptr;
  Thread thread({.name = "laden"}, [&] {
    large[0] = 1;
    in_thread = large;
  });
  thread.join();
  EXPECT_NE(in_thread, large);
}

TEST(Thread, AStackOfTheRequestedSizeCanBeUsed) {
  bool touched = false;
  Thread thread({.name = "deep", .stack_bytes = 4u << 20}, [&] {
    prefault_stack(2u << 20);
    touched = true;
  });
  thread.join();
  EXPECT_TRUE(touched);
}

}  // namespace
}  // namespace armature::platform
