// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "armature/ride/internal/assembler.hpp"

namespace armature::ride::internal {

class Link;

/// Messages that were received and not yet dispatched: most urgent first, first come first served
/// within one priority. It keeps their bytes and its memory.
/// @thread one at a time
class Pending {
 public:
  struct Entry {
    Link* link;
    Message message;
  };

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  /// True if no more should be received before some of it is dispatched.
  bool full() const { return bytes_.size() >= kMostBytes || entries_.size() >= kMostEntries; }

  void push(Link& link, const Message& message) {
    const auto at = static_cast<std::uint32_t>(entries_.size());
    const std::size_t level = level_of(message.header);
    entries_.push_back({&link, message.header, bytes_.size(), message.body.size(), kNone});
    bytes_.append(message.body);
    Queue& queue = queues_[level];
    (queue.first == kNone ? queue.first : entries_[queue.last].next) = at;
    queue.last = at;
    levels_[level / 64] |= std::uint64_t{1} << (level % 64);
    ++count_;
  }

  /// The most urgent; there is one. Its body lies here until the next `push`, or `settle`.
  Entry pop() {
    const std::size_t level = highest_level();
    Queue& queue = queues_[level];
    const Kept& kept = entries_[queue.first];
    queue.first = kept.next;
    if (queue.first == kNone) levels_[level / 64] &= ~(std::uint64_t{1} << (level % 64));
    --count_;
    return {kept.link, {kept.header, bytes_.bytes().subspan(kept.begin, kept.size)}};
  }

  /// Makes room once everything was dispatched.
  void settle() {
    if (count_ != 0) return;
    entries_.clear();
    bytes_.clear();
    bytes_.shrink(2 * kMostBytes);
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::size_t kMostBytes = 1024 * 1024;
  static constexpr std::size_t kMostEntries = 64 * 1024;
  static constexpr std::size_t kLevels = 256;

  struct Kept {
    Link* link;
    Header header;
    std::size_t begin;
    std::size_t size;
    std::uint32_t next;
  };
  struct Queue {
    std::uint32_t first = kNone;
    std::uint32_t last = kNone;
  };

  static std::size_t level_of(const Header& header) {
    return header.priority < kLevels ? header.priority : kLevels - 1;
  }

  std::size_t highest_level() const {
    for (std::size_t word = levels_.size(); word-- > 0;) {
      if (levels_[word] != 0)
        return 64 * word + 63 - static_cast<std::size_t>(std::countl_zero(levels_[word]));
    }
    return 0;
  }

  std::vector<Kept> entries_;
  Body bytes_;
  std::array<Queue, kLevels> queues_{};
  std::array<std::uint64_t, kLevels / 64> levels_{};
  std::size_t count_ = 0;
};

}  // namespace armature::ride::internal
