// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/rt/atomics.hpp"

namespace armature::rt {

/// What a real-time thread does something behind without ever waiting: it finds the lock free, or
/// does without. Only others may try again.
///
/// Specification: between a `try_lock` that succeeded and the `unlock` after it no other succeeds,
/// and whoever succeeds next sees all that was done before that `unlock`.
template <typename Atomics>
class BasicTryLock {
 public:
  /// @rt nonblocking, no allocation
  /// @thread any
  bool try_lock() noexcept {
    std::uint32_t free = 0;
    return taken_.compare_exchange_strong(free, 1, std::memory_order_acquire,
                                          std::memory_order_relaxed);
  }
  /// @rt nonblocking, no allocation
  /// @thread the one that has it
  void unlock() noexcept { taken_.store(0, std::memory_order_release); }

 private:
  typename Atomics::template Atomic<std::uint32_t> taken_{0};
};

using TryLock = BasicTryLock<StdAtomics>;

}  // namespace armature::rt
