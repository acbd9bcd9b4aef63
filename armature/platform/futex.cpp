// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/futex.hpp"

#include <cerrno>
#include <ctime>

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "armature/base/realtime.hpp"

namespace armature::platform {

namespace {

// What takes a timespec with 64 bits of seconds has a name of its own on 32-bit machines.
#ifdef SYS_futex_time64
constexpr long kFutex = SYS_futex_time64;
#else
constexpr long kFutex = SYS_futex;
#endif

}  // namespace

static_assert(sizeof(timespec) == 16, "the kernel takes seconds of 64 bits");
static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t),
              "the kernel reads the atomic as a plain 32-bit word");

void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected) {
  syscall(kFutex, &word, FUTEX_WAIT_PRIVATE, expected, nullptr, nullptr, 0);
}

bool futex_wait_until(std::atomic<std::uint32_t>& word, std::uint32_t expected,
                      base::Time deadline) {
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  const std::int64_t ns = base::to_ns(deadline);
  const timespec until{.tv_sec = static_cast<time_t>(ns / kNsPerSecond),
                       .tv_nsec = static_cast<long>(ns % kNsPerSecond)};
  const long result = syscall(kFutex, &word, FUTEX_WAIT_BITSET_PRIVATE, expected, &until, nullptr,
                              FUTEX_BITSET_MATCH_ANY);
  return result == 0 || errno != ETIMEDOUT;
}

void futex_wake_one(std::atomic<std::uint32_t>& word) {
  const base::SanitizerPermit does_not_wait;
  syscall(kFutex, &word, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

}  // namespace armature::platform
