// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "armature/ride/interface.hpp"
#include "armature/ride/internal/event_queue.hpp"

namespace armature::ride::internal {

/// Who has subscribed to the events of a service.
class Publisher {
 public:
  explicit Publisher(const Interface& interface) : interface_(interface) {}

  /// Encodes once and sends to each subscriber.
  /// @thread any
  void publish(Number event, const Fields& members, Priority priority);

  /// False if the interface has no such event.
  bool has_event(Number event) const;
  void add(std::shared_ptr<EventQueue> subscriber);
  /// @return false if there is none
  bool remove(const Link& link, std::uint32_t subscription);
  void remove(const Link& link);
  void remove_all();
  std::size_t count() const;
  bool has_subscribers(Number event) const;
  /// Counts how often a subscriber came or went.
  std::uint64_t changes() const { return changes_.load(std::memory_order_acquire); }

 private:
  std::span<const std::byte> encode(Number event, const Fields& members, Priority priority);
  template <typename Is>
  std::size_t remove_if(Is is);

  const Interface& interface_;
  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<EventQueue>> subscribers_;
  std::atomic<std::uint64_t> changes_{0};
  Body message_;
};

}  // namespace armature::ride::internal
