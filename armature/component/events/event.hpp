// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/component/component.hpp"
#include "armature/component/internal/inside.hpp"
#include "armature/component/operations/requirement.hpp"
#include "armature/component/operations/signature.hpp"
#include "armature/component/ports/port.hpp"

namespace armature::component {

class EventTap;
class StandIn;

class EventHandlerBase;

/// What became of an event that was raised.
enum class RaiseStatus : std::uint8_t { kDelivered, kNobodyListens, kQueueFull };

/// What a component itself does at once when it raises one of its events.
class EventListener {
 public:
  virtual void event_raised() = 0;

 protected:
  ~EventListener() = default;
};

/// Option of an event: it is raised when there is a reason, not in each cycle of its component, so
/// who handles it is not run with that component's period.
struct Occasional {};
inline constexpr Occasional occasional{};

/// Something that happens to a component and that others may react to: the runtime's side of it.
class EventBase {
 public:
  EventBase(const EventBase&) = delete;
  EventBase& operator=(const EventBase&) = delete;
  virtual ~EventBase();

  std::string_view name() const { return name_; }
  std::string_view doc() const { return doc_; }
  const Signature& signature() const { return signature_; }
  Component& owner() const { return owner_; }
  std::uint64_t raised() const { return raised_; }
  bool is_occasional() const { return occasional_; }
  const std::vector<EventHandlerBase*>& subscribers() const { return subscribers_; }

  /// Subscribes `handler`, which has the same signature, for the threads that both components are
  /// assigned to. Handlers are told in the order of their subscription, but those in other threads
  /// first: they are to know of the event before data that it causes reaches them.
  /// @thread configuration only
  void subscribe(EventHandlerBase& handler);
  void unsubscribe_all();

  /// `listener` belongs to the same component and is told before the subscribers.
  void add_listener(EventListener& listener) { listeners_.push_back(&listener); }

  /// `tap` is told until it is removed; also while the application runs.
  /// @rt nonblocking, no allocation, O(taps)
  /// @thread the component's own
  void add_tap(EventTap& tap);
  void remove_tap(EventTap& tap);

  /// An event of the same name and arguments, which `owner` raises by `raise_from`; it keeps the
  /// names of this one, which outlives it.
  /// @thread configuration only
  std::unique_ptr<EventBase> twin(StandIn& owner) const;
  /// Raises it with arguments that are where `arguments` says, as its signature describes them.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  RaiseStatus raise_from(const void* const* arguments) noexcept;

 protected:
  EventBase(Component& owner, std::string_view name, std::string_view doc,
            Signature signature) noexcept;

  void mark_occasional() { occasional_ = true; }

  /// Counts, and tells who is to know before the handlers of this thread.
  /// @param arguments  where they are
  RaiseStatus begin_raise(const void* const* arguments) noexcept {
    ++raised_;
    for (EventListener* listener : listeners_) listener->event_raised();
    if (!queues_.empty()) return enqueue(arguments);
    return subscribers_.empty() ? RaiseStatus::kNobodyListens : RaiseStatus::kDelivered;
  }
  bool is_tapped() const { return first_tap_ != nullptr; }
  void tell_taps(const void* const* arguments) noexcept;

  std::vector<EventHandlerBase*> direct_;  ///< those that run where it is raised

 private:
  class Twin;
  struct Queue;

  /// The queue of `handler`'s thread.
  Queue& queue_to(EventHandlerBase& handler);
  RaiseStatus enqueue(const void* const* arguments) noexcept;

  bool occasional_ = false;
  std::uint64_t raised_ = 0;
  Component& owner_;
  std::string_view name_;
  std::string_view doc_;
  Signature signature_;
  std::vector<EventHandlerBase*> subscribers_;
  std::vector<EventListener*> listeners_;
  std::vector<std::unique_ptr<Queue>> queues_;
  EventTap* first_tap_ = nullptr;
};

/// Option of an event handler: it runs in the thread of whoever raises the event, at once, even if
/// its component has another thread; the author makes sure that this is safe.
struct InRaisersThread {};
inline constexpr InRaisersThread in_raisers_thread{};

/// Option of an event handler: how many events may wait for it if it runs in another thread.
struct QueueSize {
  std::size_t capacity;
};
inline QueueSize queue(std::size_t capacity) { return {capacity}; }
inline constexpr std::size_t kDefaultEventQueue = 16;

/// A component's declared reaction to an event of one of its peers: the runtime's side of it.
class EventHandlerBase : public Requirement {
 public:
  ~EventHandlerBase() override;

  const Signature& signature() const;
  bool runs_in_raisers_thread() const;
  const LeadsTo& effects() const;
  std::size_t queue_capacity() const;
  EventBase* source() const;
  bool bound() const override { return source() != nullptr; }
  std::string_view handler() const final { return name(); }
  const Entrance* outer() const final { return outer_; }
  /// Events that came while the queue was full.
  std::uint64_t dropped() const;

  /// Handles an event whose arguments are where `arguments` says.
  /// @thread the component's own, or that of the one who raises it
  virtual void handle_from(ExecutionContext& where, const void* const* arguments) noexcept = 0;

 protected:
  EventHandlerBase(Component& owner, std::string_view name, std::string_view doc,
                   Signature signature) noexcept;

  using Requirement::apply;
  void apply(InRaisersThread) noexcept;
  void apply(const LeadsTo& effects) noexcept;
  void apply(QueueSize queue) noexcept;

  /// What it runs if that is no member function.
  void set_free_function(FreeFunction function) noexcept;
  FreeFunction free_function() const noexcept;

  template <typename Code>
  void handle_with(ExecutionContext& where, Code&& code) noexcept {
    Component& component = owner();
    const bool own_thread = &where == &internal::Inside::context(component);
    if (own_thread ? !internal::Inside::admits(component) : component.state() != State::kRunning)
      return;
    if (inside_) [[unlikely]]
      return refuse(where);
    inside_ = true;
    internal::Inside::enter_handler(component, where, *this, outer_, code);
    inside_ = false;
  }

 private:
  friend class EventBase;
  struct About;
  About& about() const;

  const Entrance* outer_ = nullptr;
  bool inside_ = false;  ///< it runs
};

template <typename... Args>
class EventHandler;

/// Raised by its component only.
template <typename... Args>
class Event final : private EventBase {
  static_assert((std::is_trivially_copyable_v<Args> && ...),
                "events carry data of fixed size: numbers, FixedText, arrays; vectors go on ports");

 public:
  /// @param names  of the arguments, with units: `"position [rad]"`
  Event(Component* owner, std::string_view name, std::string_view doc,
        std::initializer_list<std::string_view> names = {}) noexcept
      : EventBase(*owner, name, doc, Signature::of<void, Args...>(names)) {}
  Event(Component* owner, std::string_view name, std::string_view doc, Occasional,
        std::initializer_list<std::string_view> names = {}) noexcept
      : Event(owner, name, doc, names) {
    mark_occasional();
  }

  /// Tells all subscribers: those in this thread run now, the others are queued.
  /// @return kQueueFull if at least one subscriber could not be told
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  RaiseStatus raise(const Args&... arguments) noexcept {
    const std::array<const void*, sizeof...(Args)> places{&arguments...};
    const RaiseStatus status = begin_raise(places.data());
    for (EventHandlerBase* base : direct_) {
      auto& handler = static_cast<EventHandler<Args...>&>(*base);
      internal::Inside::call_out(owner(), handler.owner(), [&] {
        handler.handle(internal::Inside::context(owner()), arguments...);
      });
    }
    if (is_tapped()) [[unlikely]]
      tell_taps(places.data());
    return status;
  }

 private:
  using RuntimeFace = EventBase;
  friend class internal::Inside;
};

/// Runs a member function when a peer raises the event of the same name and arguments: at once if
/// both share a thread, else in the handler's own thread, once for each event, in their order.
template <typename... Args>
class EventHandler final : private EventHandlerBase {
 public:
  using EventHandlerBase::bound;

  /// Options: from(property or name), optional, in_raisers_thread, queue(n).
  template <auto Function, typename... Options>
  EventHandler(Component* owner, std::string_view name, Serve<Function>, std::string_view doc,
               Options... options) noexcept
      : EventHandler(
            *owner, name, doc,
            [](EventHandler& handler, ExecutionContext& where, const Args&... arguments) noexcept {
              handler.handle_with(where, [&] {
                using Owner = internal::OwnerOf<Function>;
                static_assert(std::is_invocable_v<decltype(Function), Owner&, const Args&...>,
                              "the member function does not take the arguments of the event");
                (static_cast<Owner&>(handler.owner()).*Function)(arguments...);
              });
            }) {
    (apply(options), ...);
  }

  /// For handlers that are not a member function: `function` is given `self`.
  template <typename... Options>
  EventHandler(Component* owner, std::string_view name,
               void (*function)(void* self, const Args&...), void* self, std::string_view doc,
               Options... options) noexcept
      : EventHandler(*owner, name, doc, function, self) {
    (apply(options), ...);
  }

 private:
  using RuntimeFace = EventHandlerBase;
  friend class internal::Inside;
  friend class Event<Args...>;

  /// For a component that calls out (see internal::Inside::call_out).
  void handle(ExecutionContext& where, const Args&... arguments) noexcept {
    handle_(*this, where, arguments...);
  }

  using Handle = void (*)(EventHandler&, ExecutionContext&, const Args&...) noexcept;
  using Function = void (*)(void* self, const Args&...);

  EventHandler(Component& owner, std::string_view name, std::string_view doc, Handle call) noexcept
      : EventHandlerBase(owner, name, doc, Signature::of<void, Args...>({})), handle_(call) {}
  EventHandler(Component& owner, std::string_view name, std::string_view doc, Function function,
               void* self) noexcept
      : EventHandler(
            owner, name, doc,
            [](EventHandler& handler, ExecutionContext& where, const Args&... arguments) noexcept {
              handler.handle_with(where, [&] {
                const FreeFunction free = handler.free_function();
                free.as<Function>()(free.self, arguments...);
              });
            }) {
    set_free_function(FreeFunction::of(function, self));
  }

  void handle_from(ExecutionContext& where,
                   [[maybe_unused]] const void* const* arguments) noexcept override {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      handle(where, *static_cast<const Args*>(arguments[I])...);
    }
    (std::index_sequence_for<Args...>{});
  }

  Handle handle_;
};

// Compiled once, in the library.
extern template class Event<>;
extern template class EventHandler<>;

}  // namespace armature::component
