// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "armature/rt/atomics.hpp"
#include "armature/rt/latest.hpp"

namespace armature::rt {

/// As Latest, for values that are usually read before the next is written: then neither side needs
/// a locked instruction, which would wait for everything before it to reach the other CPU.
///
/// Specification: `fetch` gives the last value whose `write` had finished, or nullptr if there is
/// none since; never one torn, nor an older one after a newer one. Both sides finish in a bounded
/// number of steps whatever the other does.
///
/// A slot takes the value if the one before it was read; else the cell takes it.
///
/// @tparam T  small, with a member `sequence`, which the writer counts up from 1
template <typename T, typename Atomics = StdAtomics>
class QuickLatest {
 public:
  explicit QuickLatest(const T& initial) : received_(initial), cell_(initial), slot_(initial) {}

  /// @rt nonblocking, no allocation
  /// @thread the writer only
  void write(const T& value) {
    if (full_.load(std::memory_order_acquire)) {
      cell_.write(value);
    } else {
      slot_ = value;
      full_.store(true, std::memory_order_release);
    }
  }

  /// The newest value, valid until the next call; nullptr if nothing was written since the last.
  /// @rt nonblocking, no allocation
  /// @thread the reader only
  const T* fetch() {
    const T* found = nullptr;
    if (full_.load(std::memory_order_acquire)) {
      received_ = slot_;
      full_.store(false, std::memory_order_release);
      found = newer(received_, found);
    }
    return cell_.fetch() ? newer(cell_.value(), found) : found;
  }

 private:
  /// `value` if it is newer than all that the reader was given.
  const T* newer(const T& value, const T* otherwise) {
    if (value.sequence <= newest_) return otherwise;
    newest_ = value.sequence;
    return &value;
  }

  std::uint64_t newest_ = 0;
  T received_;
  Latest<T, Atomics> cell_;
  alignas(kCacheLine) typename Atomics::template Atomic<bool> full_{false};
  typename Atomics::template Plain<T> slot_;
};

}  // namespace armature::rt
