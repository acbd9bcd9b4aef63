// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/base/time.hpp"

namespace armature::platform {

/// Now on the monotonic clock; steps of the wall clock do not touch it.
/// @rt nonblocking, no allocation
base::Time monotonic_now();

/// The smallest step of the monotonic clock.
base::Duration clock_resolution();

/// Sleeps until `deadline` on the monotonic clock; a deadline in the past returns at once.
void sleep_until(base::Time deadline);

/// The processor's cycle counter: the cheapest way to measure a short time on one core.
/// @rt nonblocking, a few nanoseconds
#if defined(__x86_64__) || defined(__i386__)
inline std::uint64_t ticks() { return __builtin_ia32_rdtsc(); }
#elif defined(__aarch64__)
inline std::uint64_t ticks() {
  std::uint64_t value;
  asm volatile("mrs %0, cntvct_el0" : "=r"(value));
  return value;
}
#else
inline std::uint64_t ticks() { return static_cast<std::uint64_t>(base::to_ns(monotonic_now())); }
#endif

/// Nanoseconds of one tick; measured against the monotonic clock on first use (takes 10 ms then).
double tick_period_ns();

/// The wall clock as text `2026-11-21T10:20:30.123456`, for people only.
/// @param ns_since_epoch  wall-clock nanoseconds since 1970 (UTC)
struct WallClockText {
  char text[32];
};
WallClockText wall_clock_text();

}  // namespace armature::platform
