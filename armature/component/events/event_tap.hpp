// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::component {

/// Sees every time that an event is raised, whatever its arguments are; for what is no component,
/// such as a script. It is told after the subscribers.
class EventTap {
 public:
  EventTap() = default;
  EventTap(const EventTap&) = delete;
  EventTap& operator=(const EventTap&) = delete;
  virtual ~EventTap() = default;

  /// @param arguments  where they are, as the event's signature describes them
  /// @rt nonblocking, no allocation
  /// @thread the raiser's
  virtual void event_raised(const void* const* arguments) noexcept = 0;

 private:
  friend class EventBase;
  EventTap* next_ = nullptr;
};

}  // namespace armature::component
