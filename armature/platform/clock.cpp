// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/clock.hpp"

#include <cerrno>
#include <cstdio>
#include <ctime>

namespace armature::platform {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

timespec to_timespec(base::Time time) {
  const std::int64_t ns = base::to_ns(time);
  return {.tv_sec = static_cast<time_t>(ns / kNsPerSecond),
          .tv_nsec = static_cast<long>(ns % kNsPerSecond)};
}

double measure_tick_period_ns() {
  const base::Time begin = monotonic_now();
  const std::uint64_t first = ticks();
  sleep_until(begin + std::chrono::milliseconds(10));
  const base::Duration elapsed = monotonic_now() - begin;
  const std::uint64_t counted = ticks() - first;
  return static_cast<double>(elapsed.count()) / static_cast<double>(counted);
}

}  // namespace

base::Time monotonic_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return base::time_from_ns(now.tv_sec * kNsPerSecond + now.tv_nsec);
}

base::Duration clock_resolution() {
  timespec step{};
  clock_getres(CLOCK_MONOTONIC, &step);
  return base::Duration(step.tv_sec * kNsPerSecond + step.tv_nsec);
}

void sleep_until(base::Time deadline) {
  const timespec until = to_timespec(deadline);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

double tick_period_ns() {
  static const double period_ns = measure_tick_period_ns();
  return period_ns;
}

WallClockText wall_clock_text() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  tm parts{};
  gmtime_r(&now.tv_sec, &parts);
  WallClockText result{};
  const std::size_t used = strftime(result.text, sizeof result.text, "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(result.text + used, sizeof result.text - used, ".%06ld", now.tv_nsec / 1000);
  return result;
}

}  // namespace armature::platform
