// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>

#include "armature/rt/atomics.hpp"

namespace armature::rt {

/// Says whether an entry of a pool is in use.
template <typename Atomics = StdAtomics>
class BasicInUse {
 public:
  bool get() const { return in_use_.load(std::memory_order_acquire); }
  /// @thread the pool's
  void take() { in_use_.store(true, std::memory_order_relaxed); }
  /// Whoever takes the entry again sees all that was done with it before.
  /// @thread the one that the entry was sent to
  void give_back() { in_use_.store(false, std::memory_order_release); }

 private:
  typename Atomics::template Atomic<bool> in_use_{false};
};
using InUse = BasicInUse<>;

/// Entries that one thread claims and sends to another, which gives them back in their order.
///
/// Specification: an entry that was claimed is not claimed again before it was given back. `claim`
/// finds one unless as many are in use as there are, or one was left to be given back in between.
///
/// @tparam Entry  has a member `in_use`
template <typename Entry>
class EntryPool {
 public:
  /// @param capacity  at least 1
  explicit EntryPool(std::size_t capacity)
      : capacity_(std::max<std::size_t>(capacity, 1)),
        entries_(std::make_unique<Entry[]>(capacity_)) {}

  Entry* begin() { return entries_.get(); }
  Entry* end() { return entries_.get() + capacity_; }

  /// An entry that is not in use, nullptr if there is none. The first is taken whenever it is free,
  /// so that what is handled in time stays in one place; the others in turn, since they are given
  /// back in their order.
  /// @rt nonblocking, no allocation
  /// @thread one only
  Entry* claim() {
    std::size_t found = 0;
    if (entries_[0].in_use.get()) {
      found = next_;
      if (capacity_ == 1 || entries_[found].in_use.get()) return nullptr;
      if (++next_ == capacity_) next_ = 1;
    }
    entries_[found].in_use.take();
    return &entries_[found];
  }

 private:
  std::size_t capacity_;
  std::unique_ptr<Entry[]> entries_;
  std::size_t next_ = 1;
};

}  // namespace armature::rt
