// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/publisher.hpp"

#include <algorithm>
#include <new>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/link.hpp"

namespace armature::ride::internal {

void Publisher::publish(Number event, const Fields& members, Priority priority) {
  const std::lock_guard lock(mutex_);
  bool encoded = false;
  base::Time now{};
  std::span<const std::byte> message;
  for (const auto& subscriber : subscribers_) {
    if (subscriber->event != event) continue;
    if (!encoded) {
      message = encode(event, members, priority);
      now = platform::monotonic_now();
      encoded = true;
    }
    if (message.empty()) {
      subscriber->link->lose_event(*subscriber);
    } else {
      subscriber->link->send_event(*subscriber, message, now);
    }
  }
}

/// Nothing if there is no memory for it.
std::span<const std::byte> Publisher::encode(Number event, const Fields& members,
                                             Priority priority) {
  message_.clear();
  try {
    message_.extend(Header::kSize);
    Encoder body(message_);
    body.put(event);
    members.put(body);
    finish_message(message_, 0, priority, Type::kEvent, 0);
  } catch (const std::bad_alloc&) {
    message_ = Body();
  }
  return message_.bytes();
}

bool Publisher::has_event(Number event) const {
  return event == kFailedDeclaration.number() ||
         std::ranges::any_of(interface_.declarations, [&](const Declaration& declaration) {
           return declaration.is_event() && declaration.number() == event;
         });
}

void Publisher::add(std::shared_ptr<EventQueue> subscriber) {
  const std::lock_guard lock(mutex_);
  subscribers_.push_back(std::move(subscriber));
  changes_.fetch_add(1, std::memory_order_release);
}

template <typename Is>
std::size_t Publisher::remove_if(Is is) {
  const std::lock_guard lock(mutex_);
  const std::size_t gone = std::erase_if(subscribers_, is);
  if (gone != 0) changes_.fetch_add(1, std::memory_order_release);
  return gone;
}

bool Publisher::remove(const Link& link, std::uint32_t subscription) {
  return remove_if([&](const auto& subscriber) {
           return subscriber->link.get() == &link && subscriber->subscription == subscription;
         }) != 0;
}

void Publisher::remove(const Link& link) {
  remove_if([&](const auto& subscriber) { return subscriber->link.get() == &link; });
}

void Publisher::remove_all() {
  remove_if([](const auto&) { return true; });
}

bool Publisher::has_subscribers(Number event) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(subscribers_,
                             [&](const auto& subscriber) { return subscriber->event == event; });
}

std::size_t Publisher::count() const {
  const std::lock_guard lock(mutex_);
  return subscribers_.size();
}

}  // namespace armature::ride::internal
