// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/stop_signal.hpp"

#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"

namespace armature::platform {
namespace {

/// Under nohup these tests would wait in vain for what it ignores.
[[maybe_unused]] const auto kHeeded = std::signal(SIGHUP, SIG_DFL);

base::Time in_an_hour() { return monotonic_now() + std::chrono::hours(1); }

TEST(StopSignal, WaitsUntilTheDeadlineIfNothingComes) {
  const StopSignal stop;
  const base::Time deadline = monotonic_now() + std::chrono::milliseconds(2);
  EXPECT_FALSE(stop.wait_until(deadline));
  EXPECT_GE(monotonic_now(), deadline);
  EXPECT_FALSE(stop.wait_until(base::Time{}));
  EXPECT_FALSE(stop.received());
}

TEST(StopSignal, TheFirstSignalSetsTheFlagAndEndsTheWait) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const StopSignal stop;
    EXPECT_FALSE(stop.received());
    std::raise(signal);
    EXPECT_TRUE(stop.received());
    EXPECT_TRUE(stop.wait_until(in_an_hour()));
  }
}

TEST(StopSignal, ASignalWhileWaitingEndsTheWait) {
  const StopSignal stop;
  std::thread sender([] { ::kill(::getpid(), SIGTERM); });
  EXPECT_TRUE(stop.wait_until(in_an_hour()));
  sender.join();
}

TEST(StopSignalDeathTest, TheSecondSignalEndsTheProcess) {
  EXPECT_EXIT(
      {
        const StopSignal stop;
        std::raise(SIGTERM);
        std::raise(SIGINT);
      },
      ::testing::ExitedWithCode(130), "");
}

TEST(StopSignal, ATerminalThatGoesAwayAsksTwiceAndIsNoSecondSignal) {
  const StopSignal stop;
  std::raise(SIGHUP);
  std::raise(SIGHUP);
  EXPECT_TRUE(stop.received());
  stop.hear_next();
  std::raise(SIGHUP);
  EXPECT_FALSE(stop.received());
  std::raise(SIGTERM);
  EXPECT_TRUE(stop.received());
}

TEST(StopSignal, ATerminalThatGoesAwayIsNoAnswerToWhatIsAskedAtTheStop) {
  const StopSignal stop;
  std::raise(SIGTERM);
  stop.hear_next();
  std::raise(SIGHUP);
  EXPECT_FALSE(stop.received());
  std::raise(SIGINT);
  EXPECT_TRUE(stop.received());
}

TEST(StopSignal, ATerminalThatGoesAwayIsIgnoredIfItWasBefore) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  const StopSignal stop;
  std::raise(SIGHUP);
  EXPECT_FALSE(stop.received());
  std::signal(SIGHUP, before);
}

volatile std::sig_atomic_t handled_by_the_program = 0;

TEST(StopSignal, GivesTheSignalsBackInTheEnd) {
  const auto before = std::signal(SIGINT, [](int) { handled_by_the_program = 1; });
  { const StopSignal stop; }
  std::raise(SIGINT);
  EXPECT_EQ(handled_by_the_program, 1);
  std::signal(SIGINT, before);
}

}  // namespace
}  // namespace armature::platform
