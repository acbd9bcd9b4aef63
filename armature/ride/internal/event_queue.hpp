// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "armature/ride/body.hpp"
#include "armature/ride/wire.hpp"

namespace armature::ride::internal {

class Link;

/// One subscription at the side that publishes: the events that the connection could not take yet.
/// When it is full the oldest goes. Guarded by the link's lock.
class EventQueue {
 public:
  EventQueue(std::shared_ptr<Link> subscriber, std::uint32_t chosen, Number number,
             std::uint32_t publisher, std::size_t capacity)
      : link(std::move(subscriber)),
        subscription(chosen),
        event(number),
        component(publisher),
        events_(capacity) {}

  bool empty() const { return count_ == 0; }
  /// @return false if the oldest was lost for it
  bool push(std::span<const std::byte> message) {
    const bool full = count_ == events_.size();
    if (full) pop();
    Body& place = events_[(first_ + count_++) % events_.size()];
    place.clear();
    place.append(message);
    return !full;
  }
  std::span<const std::byte> front() const { return events_[first_].bytes(); }
  void pop() {
    first_ = (first_ + 1) % events_.size();
    --count_;
  }

  std::shared_ptr<Link> link;
  const std::uint32_t subscription;
  const Number event;
  const std::uint32_t component;

 private:
  std::vector<Body> events_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace armature::ride::internal
