// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "armature/rt/atomics.hpp"

namespace armature::rt {

/// The newest value from one writer thread to one reader thread.
///
/// Specification: `fetch` moves the reader to the last value whose `write` had finished, or leaves
/// it where it is if there was none since; the reader never sees a value torn, nor an older one
/// after a newer one. Both sides finish in a bounded number of steps whatever the other does.
///
/// Three slots: one is the writer's, one the reader's, one lies in the middle; each side swaps its
/// own with the middle one in a single atomic exchange.
template <typename T, typename Atomics = StdAtomics>
class Latest {
 public:
  /// @param initial  what the reader sees before the first write; gives vectors their size
  explicit Latest(const T& initial) : slots_{initial, initial, initial} {}

  /// @rt nonblocking; allocates only if assigning a T of this shape does
  /// @thread the writer only
  void write(const T& value) {
    slots_[back_] = value;
    back_ = middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) &
            kIndex;
  }

  /// Moves on to the newest value; false if nothing was written since the last call.
  /// @rt nonblocking, no allocation
  /// @thread the reader only
  bool fetch() {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// The value that the last `fetch` moved to.
  /// @thread the reader only
  const T& value() const { return slots_[front_]; }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;

  // Close together: writer and reader take turns far more often than they meet, and each cache line
  // that changes hands costs more than the copy.
  typename Atomics::template Atomic<std::uint8_t> middle_{std::uint8_t{1}};
  std::uint8_t back_ = 0;
  std::uint8_t front_ = 2;
  std::array<T, 3> slots_;
};

}  // namespace armature::rt
