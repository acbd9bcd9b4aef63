// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "armature/rt/atomics.hpp"
#include "armature/rt/when_full.hpp"

namespace armature::rt {

/// A first-in first-out queue of fixed capacity from one writer thread to one reader thread.
///
/// Specification: values come out whole, in the order in which they went in, each at most once;
/// what is missing was refused or dropped, and `push` said so. `push` finishes in a bounded number
/// of steps; `pop` starts again only if the writer overwrote the entry it was about to take.
///
/// The values lie in `capacity + 2` slots, one of them the writer's and one the reader's; an entry
/// holds a slot's index, its turn, and whether it is filled. Both sides trade slots with an entry
/// by one atomic operation, so neither ever touches a slot that the other one uses.
template <typename T, typename Atomics = StdAtomics>
class Ring {
 public:
  /// @param capacity  at least 1
  /// @param sample    gives every slot its shape, so that pushing a value of it never allocates
  Ring(std::size_t capacity, WhenFull when_full, const T& sample)
      : when_full_(when_full),
        slots_(capacity + 2, Slot{sample}),
        entries_(capacity),
        writers_slot_(static_cast<std::uint32_t>(capacity)),
        readers_slot_(static_cast<std::uint32_t>(capacity + 1)) {
    for (std::size_t i = 0; i < capacity; ++i) {
      entries_[i].word.store(pack(static_cast<std::uint32_t>(i), 0, false),
                             std::memory_order_relaxed);
    }
  }

  std::size_t capacity() const { return entries_.size(); }

  /// @rt nonblocking, wait-free; allocates only if assigning a T of this shape does
  /// @thread the writer only
  PushResult push(const T& value) {
    auto& entry = entries_[write_index_].word;
    const bool full = filled(entry.load(std::memory_order_relaxed));
    if (full && when_full_ == WhenFull::kDropNewest) return PushResult::kRefused;
    slots_[writers_slot_].value = value;
    const std::uint64_t old =
        entry.exchange(pack(writers_slot_, write_turn_, true), std::memory_order_acq_rel);
    writers_slot_ = slot_of(old);
    advance(write_index_, write_turn_);
    return filled(old) ? PushResult::kDroppedOldest : PushResult::kTaken;
  }

  /// The oldest value, or nullptr if the queue is empty; valid until the next `pop`.
  /// @rt nonblocking, no allocation
  /// @thread the reader only
  const T* pop() {
    while (true) {
      auto& entry = entries_[read_index_].word;
      std::uint64_t seen = entry.load(std::memory_order_acquire);
      if (!filled(seen)) return nullptr;
      if (turn_of(seen) != read_turn_) {
        // The writer went round: what was here is dropped, and the oldest is one further.
        advance_to_oldest(turn_of(seen));
        continue;
      }
      const std::uint64_t emptied = pack(readers_slot_, read_turn_, false);
      if (!entry.compare_exchange_strong(seen, emptied, std::memory_order_acq_rel,
                                         std::memory_order_relaxed)) {
        continue;
      }
      readers_slot_ = slot_of(seen);
      advance(read_index_, read_turn_);
      return &slots_[readers_slot_].value;
    }
  }

 private:
  // A word holds: slot index (31 bits), filled (1 bit), turn (32 bits).
  static constexpr std::uint64_t pack(std::uint32_t slot, std::uint32_t turn, bool full) {
    return (static_cast<std::uint64_t>(turn) << 32) | (static_cast<std::uint64_t>(slot) << 1) |
           (full ? 1u : 0u);
  }
  static constexpr bool filled(std::uint64_t word) { return (word & 1u) != 0; }
  static constexpr std::uint32_t slot_of(std::uint64_t word) {
    return static_cast<std::uint32_t>(word & 0xffffffffu) >> 1;
  }
  static constexpr std::uint32_t turn_of(std::uint64_t word) {
    return static_cast<std::uint32_t>(word >> 32);
  }

  void advance(std::size_t& index, std::uint32_t& turn) const {
    if (++index < entries_.size()) return;
    index = 0;
    ++turn;
  }

  /// Entry `read_index_` was refilled in `turn`: everything of the turn before that lies at or
  /// before this index is gone.
  void advance_to_oldest(std::uint32_t turn) {
    read_turn_ = turn - 1;
    advance(read_index_, read_turn_);
  }

  struct alignas(alignof(T)) Slot {
    T value;
  };
  struct Entry {
    typename Atomics::template Atomic<std::uint64_t> word;
  };

  const WhenFull when_full_;
  std::vector<Slot> slots_;
  std::vector<Entry> entries_;
  alignas(kCacheLine) std::size_t write_index_ = 0;
  std::uint32_t write_turn_ = 1;
  std::uint32_t writers_slot_;
  alignas(kCacheLine) std::size_t read_index_ = 0;
  std::uint32_t read_turn_ = 1;
  std::uint32_t readers_slot_;
};

}  // namespace armature::rt
