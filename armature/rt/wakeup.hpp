// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/base/time.hpp"
#include "armature/platform/futex.hpp"
#include "armature/rt/atomics.hpp"
#include "armature/rt/outbox.hpp"

namespace armature::rt {

/// Sleeping and waking by the kernel; the model checker has its own. A thread that is about to
/// sleep first sends others what it has for them.
struct FutexParker {
  using Atomics = StdAtomics;
  static void wait(std::atomic<std::uint32_t>& word, std::uint32_t expected) {
    flush_outbox();
    platform::futex_wait(word, expected);
  }
  /// False once `deadline` has passed.
  static bool wait_until(std::atomic<std::uint32_t>& word, std::uint32_t expected,
                         base::Time deadline) {
    flush_outbox();
    return platform::futex_wait_until(word, expected, deadline);
  }
  static void wake_one(std::atomic<std::uint32_t>& word) { platform::futex_wake_one(word); }
};

/// Wakes one sleeping thread; any number may notify.
///
/// Specification: a `wait` that starts after, or sleeps during, a `notify` returns, and sees all
/// that was written before that `notify`. Several notifications before a `wait` count as one.
///
/// All changes of the state are read-modify-write operations on one word, so there is one order of
/// them that all threads agree on, and none is lost between "look" and "sleep".
template <typename Parker>
class BasicWakeup {
 public:
  /// @rt nonblocking; a system call only if the thread sleeps
  void notify() {
    if (state_.exchange(kNotified, std::memory_order_acq_rel) == kAsleep) {
      Parker::wake_one(state_);
    }
  }

  /// Sleeps until notified.
  /// @thread the owner only
  void wait() {
    std::uint32_t seen = kNotified;
    if (take(seen)) return;
    seen = kIdle;
    if (!state_.compare_exchange_strong(seen, kAsleep, std::memory_order_acq_rel,
                                        std::memory_order_acquire)) {
      state_.exchange(kIdle, std::memory_order_acq_rel);
      return;
    }
    do {
      Parker::wait(state_, kAsleep);
      seen = kNotified;
    } while (!take(seen));
  }

  /// Sleeps until notified or until `deadline`; false if the time ran out.
  /// @thread the owner only
  bool wait_until(base::Time deadline) {
    std::uint32_t seen = kNotified;
    if (take(seen)) return true;
    seen = kIdle;
    if (!state_.compare_exchange_strong(seen, kAsleep, std::memory_order_acq_rel,
                                        std::memory_order_acquire)) {
      state_.exchange(kIdle, std::memory_order_acq_rel);
      return true;
    }
    while (Parker::wait_until(state_, kAsleep, deadline)) {
      seen = kNotified;
      if (take(seen)) return true;
    }
    // Time is up; a notification that came in the meantime is taken along.
    return state_.exchange(kIdle, std::memory_order_acq_rel) == kNotified;
  }

  /// Takes a pending notification without sleeping; false if there is none.
  /// @rt nonblocking
  bool try_wait() {
    std::uint32_t seen = kNotified;
    return take(seen);
  }

 private:
  static constexpr std::uint32_t kIdle = 0;
  static constexpr std::uint32_t kNotified = 1;
  static constexpr std::uint32_t kAsleep = 2;

  bool take(std::uint32_t& seen) {
    return state_.compare_exchange_strong(seen, kIdle, std::memory_order_acq_rel,
                                          std::memory_order_acquire);
  }

  typename Parker::Atomics::template Atomic<std::uint32_t> state_{kIdle};
};

}  // namespace armature::rt
