// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "armature/ride/body.hpp"
#include "armature/ride/memory_share.hpp"
#include "armature/ride/wire.hpp"

namespace armature::ride::internal {

class Link;

/// One subscription at the side that publishes: the events that the connection could not take yet.
/// When it is full the oldest goes. Guarded by the link's lock.
class EventQueue {
 public:
  /// @throws std::bad_alloc  the subscriber has no memory left for it
  EventQueue(std::shared_ptr<Link> subscriber, const std::shared_ptr<MemoryShare>& share,
             std::uint32_t chosen, Number number, std::uint32_t publisher, std::size_t capacity)
      : link(std::move(subscriber)),
        subscription(chosen),
        event(number),
        component(publisher),
        place_(share) {
    place_.take(sizeof(EventQueue) + capacity * sizeof(Body) + kElsewhere);
    events_.reserve(capacity);
    while (events_.size() < capacity) events_.emplace_back(share.get());
  }

  bool empty() const { return count_ == 0; }
  /// @return false if the oldest was lost for it, or there is no memory for it
  bool push(std::span<const std::byte> message) {
    const bool full = count_ == events_.size();
    if (full) pop();
    Body& place = events_[(first_ + count_) % events_.size()];
    place.clear();
    try {
      place.append(message);
    } catch (const std::bad_alloc&) {
      return false;
    }
    ++count_;
    return !full;
  }
  std::span<const std::byte> front() const { return events_[first_].bytes(); }
  /// Priority of the oldest; -1 if there is none.
  int urgency() const {
    return empty() ? -1 : static_cast<int>(load<std::uint32_t>(front().data() + 4));
  }
  void pop() {
    events_[first_].clear();
    events_[first_].shrink(kMostKept);
    first_ = (first_ + 1) % events_.size();
    --count_;
  }

  std::shared_ptr<Link> link;
  const std::uint32_t subscription;
  const Number event;
  const std::uint32_t component;

 private:
  static constexpr std::size_t kElsewhere = 4096;  ///< lists; so that each is counted
  static constexpr std::size_t kMostKept = 1024;   ///< what a large event took is given back

  Holding place_;
  std::vector<Body> events_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace armature::ride::internal
