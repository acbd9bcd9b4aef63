// SPDX-License-Identifier: Apache-2.0
#include "armature/component/event.hpp"

#include <utility>

namespace armature::component {

EventBase::EventBase(Component& owner, std::string_view name, std::string_view doc,
                     Signature signature) noexcept
    : owner_(owner), name_(name), doc_(doc), signature_(std::move(signature)) {
  owner.declare().events.push_back(this);
}

EventBase::~EventBase() = default;

void EventBase::add_tap(EventTap& tap) {
  EventTap** end = &first_tap_;
  while (*end != nullptr) end = &(*end)->next_;
  *end = &tap;
  tap.next_ = nullptr;
}

void EventBase::remove_tap(EventTap& tap) {
  for (EventTap** place = &first_tap_; *place != nullptr; place = &(*place)->next_) {
    if (*place != &tap) continue;
    *place = tap.next_;
    return;
  }
}

void EventBase::tell_taps(const void* const* arguments) noexcept {
  for (EventTap* tap = first_tap_; tap != nullptr; tap = tap->next_) tap->event_raised(arguments);
}

EventHandlerBase::About::About(std::string_view its_name, std::string_view its_doc,
                               Signature its_signature)
    : Requirement::About(its_name, its_doc), signature(std::move(its_signature)) {}

EventHandlerBase::About::~About() = default;

EventHandlerBase::EventHandlerBase(Component& owner, std::unique_ptr<About> about) noexcept
    : Requirement(owner, std::move(about)) {
  owner.declare().handlers.push_back(this);
}

EventHandlerBase::~EventHandlerBase() = default;

}  // namespace armature::component
