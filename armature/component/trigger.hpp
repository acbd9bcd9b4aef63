// SPDX-License-Identifier: Apache-2.0
#pragma once

// What makes state machines change their state, besides time and conditions.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "armature/component/events/event.hpp"
#include "armature/component/operations/operation.hpp"

namespace armature::component {

class StateMachine;

/// What became of a trigger. Ordered: everything from kTaken on is a success.
enum class TriggerStatus : std::uint8_t {
  kNotRunning,  ///< the component does not run
  kIgnored,     ///< the active states have no transition for it, or its guard did not allow it
  kQueueFull,   ///< raised by an action of the machine, and too many wait already
  kTaken,       ///< a transition was made
  kQueued,      ///< raised by an action of the machine, handled after the present transition
};

std::string_view name_of(TriggerStatus status);

/// Something that a state machine of the same component reacts to: `on(trigger, ...)`.
class Trigger {
 public:
  explicit Trigger(std::string_view name) : name_(name) {}
  Trigger(const Trigger&) = delete;
  Trigger& operator=(const Trigger&) = delete;

  std::string_view name() const { return name_; }

  /// Has it handled by the machine; if several machines react to it, by each, and the best of their
  /// answers is returned.
  /// @rt nonblocking, no allocation, as the machine's actions are
  /// @thread the component's own
  TriggerStatus raise();

 private:
  friend class StateMachine;
  struct Use {
    StateMachine* machine;
    std::size_t index;
  };

  std::string_view name_;
  std::vector<Use> uses_;
};

/// An operation of the component, `bool name()`, that is a trigger; it runs in the component's
/// thread and returns false if the machine ignored it.
class OperationTrigger final : public Trigger {
 public:
  OperationTrigger(Component* owner, std::string_view name, std::string_view doc);

 private:
  Operation<bool()> operation_;
};

/// An event of a peer that is a trigger.
template <typename... Args>
class EventTrigger final : public Trigger {
 public:
  /// Options: as those of an EventHandler.
  template <typename... Options>
  EventTrigger(Component* owner, std::string_view name, std::string_view doc, Options... options)
      : Trigger(name), handler_(owner, name, &EventTrigger::handle, this, doc, options...) {}

  /// What came with the event that was raised last, for guards and actions.
  const std::tuple<Args...>& arguments() const { return arguments_; }

 private:
  static void handle(void* self, const Args&... arguments) {
    auto& trigger = *static_cast<EventTrigger*>(self);
    trigger.arguments_ = std::tuple<const Args&...>(arguments...);
    trigger.raise();
  }

  EventHandler<Args...> handler_;
  std::tuple<Args...> arguments_{};
};

}  // namespace armature::component
