// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/death_watch.hpp"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"
#include "armature/platform/internal/direct_calls.hpp"

namespace armature::platform {
namespace {

void name_nobody(Death& death) { std::strcpy(death.worker, "Somebody"); }

/// Says what it is told, as a test of another process's end reads it, and ends the process.
void tell_and_conclude(const Death& death) {
  const std::string text = std::string(death.worker) + ": " + death.what() +
                           (death.frame_count > 2 ? ", with its stack\n" : "\n");
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
  DeathWatch::conclude(death);
}

/// In a thread of its own.
void run_watched(const std::function<void()>& body) {
  const DeathWatch watch(name_nobody, tell_and_conclude);
  ThreadRequest request;
  request.name = "victim";
  request.prefault = false;
  Thread(request, body).join();
}

#ifdef __arm__
// Debian's C library for it has no tables by which a stack goes on beyond exit().
constexpr const char* kExit0 = "Somebody: exit\\(0\\)";
#else
constexpr const char* kExit0 = "Somebody: exit\\(0\\), with its stack";
#endif

TEST(DeathWatchDeathTest, CallingExitIsTakenForAFailureAlsoWith0) {
  EXPECT_EXIT(run_watched([] { std::exit(0); }), ::testing::ExitedWithCode(1), kExit0);
  EXPECT_EXIT(run_watched([] { std::exit(7); }), ::testing::ExitedWithCode(7), "exit\\(7\\)");
  EXPECT_EXIT(run_watched([] { std::quick_exit(0); }), ::testing::ExitedWithCode(1), "exit\\(0\\)");
}

TEST(DeathWatchDeathTest, AfterItsTimeExitIsWhatItAlwaysIs) {
  EXPECT_EXIT(
      {
        { const DeathWatch watch(name_nobody, tell_and_conclude); }
        std::exit(0);
      },
      ::testing::ExitedWithCode(0), "");
}

#ifndef ARMATURE_PLATFORM_SANITIZED

volatile bool without_end = true;
volatile std::uintptr_t nowhere = 0x10;

[[gnu::noinline]] int overflow(int depth) {
  volatile char room[1024];
  room[0] = static_cast<char>(depth);
  return without_end ? overflow(depth + 1) + room[0] : 0;
}

TEST(DeathWatchDeathTest, CrashesAreNamedAndEndTheProcessByTheirSignal) {
  EXPECT_EXIT(run_watched([] { *reinterpret_cast<volatile int*>(nowhere) = 1; }),
              ::testing::KilledBySignal(SIGSEGV),
              "Somebody: segmentation fault at address 0x10, with its stack");
  EXPECT_EXIT(run_watched([] { std::abort(); }), ::testing::KilledBySignal(SIGABRT),
              "Somebody: abort");
  EXPECT_EXIT(run_watched([] { overflow(0); }), ::testing::KilledBySignal(SIGSEGV),
              "Somebody: stack overflow");
}

TEST(DeathWatchDeathTest, ASecondCrashWaitsForTheEndOfTheFirst) {
  EXPECT_EXIT(
      {
        const DeathWatch watch(name_nobody, [](const Death& death) {
          std::thread([] { std::abort(); }).detach();
          platform::sleep_until(platform::monotonic_now() + std::chrono::milliseconds(50));
          tell_and_conclude(death);
        });
        ThreadRequest request;
        request.name = "victim";
        request.prefault = false;
        Thread(request, [] { std::raise(SIGSEGV); }).join();
      },
      ::testing::KilledBySignal(SIGSEGV), "segmentation fault");
}

#endif

TEST(DeathWatch, WithoutADeathNothingIsTold) {
  bool told = false;
  {
    const DeathWatch watch(name_nobody, [&](const Death&) { told = true; });
  }
  EXPECT_FALSE(told);
  EXPECT_EQ(DeathWatch::death(), nullptr);
}

}  // namespace
}  // namespace armature::platform
