// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "armature/ride/internal/assembler.hpp"

namespace armature::ride::internal {

class Link;

/// What one connection has sent and was not dispatched yet: most urgent first, first come first
/// served within one priority. It keeps their bytes, and its memory for the next ones.
/// @thread one at a time
class Waiting {
 public:
  /// @param share  of which it takes its memory; none: without bound
  explicit Waiting(Link* whose, MemoryShare* share = nullptr) : link(whose), bytes_(share) {}
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

  bool empty() const { return lanes_.empty(); }
  /// True if it has sent a single small message since it was empty.
  bool is_single() const { return kept_.size() == 1 && wholes_.empty() && bytes_.size() <= kSmall; }
  /// True if it has sent a body that takes long to look at.
  bool has_large() const {
    return std::ranges::any_of(wholes_, [](const Body& body) { return body.size() >= kLarge; });
  }
  /// Priority of the most urgent; there is one.
  std::uint32_t urgency() const { return lanes_.front().priority; }

  void push(const Message& message) {
    popped_ = nullptr;
    if (empty()) settle();
    const auto at = static_cast<std::uint32_t>(kept_.size());
    if (message.whole != nullptr) {
      wholes_.push_back(std::move(*message.whole));
      kept_.push_back({message.header, wholes_.size() - 1, message.body.size(), kNone, true});
    } else {
      bytes_.append(message.body);
      kept_.push_back(
          {message.header, bytes_.size() - message.body.size(), message.body.size(), kNone, false});
    }
    Lane& lane = lane_of(std::min(message.header.priority, kMostUrgent));
    (lane.first == kNone ? lane.first : kept_[lane.last].next) = at;
    lane.last = at;
  }

  /// Forgets what was dispatched, and gives back what it took.
  void settle() {
    popped_ = nullptr;
    if (!empty()) return;
    kept_.clear();
    wholes_.clear();
    bytes_.clear();
    bytes_.shrink(kMostKept);
  }

  /// The most urgent. Its body lies here until the next `push` or `settle`.
  Message pop() {
    Lane& lane = lanes_.front();
    const Kept& kept = kept_[lane.first];
    lane.first = kept.next;
    if (lane.first == kNone) lanes_.erase(lanes_.begin());
    popped_ = kept.is_whole ? &wholes_[kept.begin] : nullptr;
    if (kept.is_whole) return {kept.header, popped_->bytes()};
    return {kept.header, bytes_.bytes().subspan(kept.begin, kept.size)};
  }

  /// Gives the memory of the one that was popped last back before its time, if it is worth it.
  void let_go_of_popped() {
    if (popped_ != nullptr) *popped_ = Body();
    popped_ = nullptr;
  }

  Link* const link;

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::uint32_t kMostUrgent = 255;
  static constexpr std::size_t kSmall = 1024;
  static constexpr std::size_t kLarge = 256 * 1024;
  static constexpr std::size_t kMostKept = 64 * 1024;  ///< what a large message took is given back

  struct Kept {
    Header header;
    std::size_t begin;  ///< in `bytes_`, or which of `wholes_`
    std::size_t size;
    std::uint32_t next;
    bool is_whole;
  };
  /// The messages of one priority.
  struct Lane {
    std::uint32_t priority;
    std::uint32_t first = kNone;
    std::uint32_t last = kNone;
  };

  Lane& lane_of(std::uint32_t priority) {
    const auto at =
        std::ranges::find_if(lanes_, [&](const Lane& lane) { return lane.priority <= priority; });
    if (at != lanes_.end() && at->priority == priority) return *at;
    return *lanes_.insert(at, Lane{.priority = priority});
  }

  std::vector<Kept> kept_;
  Body bytes_;
  std::vector<Body> wholes_;  ///< those that came in several messages
  Body* popped_ = nullptr;    ///< of these
  std::vector<Lane> lanes_;   ///< most urgent first, none of them empty
};

}  // namespace armature::ride::internal
