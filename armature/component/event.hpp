// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/component/component.hpp"
#include "armature/component/entrance.hpp"
#include "armature/component/event_tap.hpp"
#include "armature/component/port.hpp"
#include "armature/component/requirement.hpp"
#include "armature/component/signature.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/types/type.hpp"

namespace armature::component {

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

/// Something that happens to a component and that others may react to.
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
  virtual void subscribe(EventHandlerBase& handler) = 0;
  virtual void unsubscribe_all() = 0;

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
  virtual std::unique_ptr<EventBase> twin(StandIn& owner) const = 0;
  /// Raises it with arguments that are where `arguments` says, as its signature describes them.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  virtual RaiseStatus raise_from(const void* const* arguments) noexcept = 0;

 protected:
  EventBase(Component& owner, std::string_view name, std::string_view doc,
            Signature signature) noexcept;

  void tell_listeners() {
    for (EventListener* listener : listeners_) listener->event_raised();
  }

  bool is_tapped() const { return first_tap_ != nullptr; }
  void tell_taps(const void* const* arguments) noexcept;

  void mark_twin(EventBase& twin) const { twin.signature_ = signature_; }

  void mark_occasional() { occasional_ = true; }

  std::uint64_t raised_ = 0;
  std::vector<EventHandlerBase*> subscribers_;

 private:
  bool occasional_ = false;
  Component& owner_;
  std::string_view name_;
  std::string_view doc_;
  Signature signature_;
  std::vector<EventListener*> listeners_;
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

/// A component's declared reaction to an event of one of its peers.
class EventHandlerBase : public Requirement {
 public:
  ~EventHandlerBase() override;

  const Signature& signature() const { return about().signature; }
  bool runs_in_raisers_thread() const { return about().in_raisers_thread; }
  const LeadsTo& effects() const { return about().leads_to; }
  std::size_t queue_capacity() const { return about().queue_capacity; }
  EventBase* source() const { return about().source; }
  bool bound() const override { return source() != nullptr; }
  std::string_view handler() const final { return name(); }
  const Entrance* outer() const final { return outer_; }
  /// Events that came while the queue was full.
  std::uint64_t dropped() const { return about().dropped.load(std::memory_order_relaxed); }

 protected:
  /// Description, counters and lists, apart from what a cycle touches.
  struct About : Requirement::About {
    About(std::string_view its_name, std::string_view its_doc, Signature its_signature);
    ~About() override;

    Signature signature;
    bool in_raisers_thread = false;
    LeadsTo leads_to;
    std::size_t queue_capacity = kDefaultEventQueue;
    EventBase* source = nullptr;
    std::atomic<std::uint64_t> dropped{0};
  };

  EventHandlerBase(Component& owner, std::unique_ptr<About> about) noexcept;

  using Requirement::apply;
  void apply(InRaisersThread) noexcept { about().in_raisers_thread = true; }
  void apply(const LeadsTo& effects) noexcept { about().leads_to = effects; }
  void apply(QueueSize queue) noexcept { about().queue_capacity = queue.capacity; }

  About& about() const { return static_cast<About&>(Requirement::about()); }
  void count_drop() { about().dropped.store(dropped() + 1, std::memory_order_relaxed); }

  const Entrance* outer_ = nullptr;
  bool inside_ = false;  ///< it runs
};

template <typename... Args>
class EventHandler;

/// Raised by its component only.
template <typename... Args>
class Event final : public EventBase {
  static_assert((std::is_trivially_copyable_v<Args> && ...),
                "events carry data of fixed size: numbers, FixedText, arrays; vectors go on ports");

 public:
  /// @param names  of the arguments, with units: `"position [rad]"`
  Event(Component* owner, std::string_view name, std::string_view doc,
        std::initializer_list<std::string_view> names = {}) noexcept;
  Event(Component* owner, std::string_view name, std::string_view doc, Occasional,
        std::initializer_list<std::string_view> names = {}) noexcept
      : Event(owner, name, doc, names) {
    mark_occasional();
  }
  ~Event() override;

  /// Tells all subscribers: those in this thread run now, the others are queued.
  /// @return kQueueFull if at least one subscriber could not be told
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  RaiseStatus raise(const Args&... arguments) noexcept {
    ++raised_;
    RaiseStatus status =
        subscribers_.empty() ? RaiseStatus::kNobodyListens : RaiseStatus::kDelivered;
    tell_listeners();
    for (const std::unique_ptr<Queue>& queue : queues_) {
      if (!enqueue(*queue, arguments...)) status = RaiseStatus::kQueueFull;
    }
    if (!queues_.empty()) rt::flush_outbox();  // who is told of an event is woken at once
    for (EventHandler<Args...>* handler : direct_) {
      owner().call_out(handler->owner(), [&] { handler->handle(owner().context(), arguments...); });
    }
    if (is_tapped()) [[unlikely]] {
      const std::array<const void*, sizeof...(Args)> places{&arguments...};
      tell_taps(places.data());
    }
    return status;
  }

  void subscribe(EventHandlerBase& base) override;
  void unsubscribe_all() override;
  std::unique_ptr<EventBase> twin(StandIn& owner) const override;
  RaiseStatus raise_from(const void* const* arguments) noexcept override;

 private:
  struct Queue;
  /// The queue of `handler`'s thread.
  Queue& queue_to(EventHandlerBase& handler);
  bool enqueue(Queue& queue, const Args&... arguments);

  std::vector<EventHandler<Args...>*> direct_;
  std::vector<std::unique_ptr<Queue>> queues_;
};

/// Runs a member function when a peer raises the event of the same name and arguments: at once if
/// both share a thread, else in the handler's own thread, once for each event, in their order.
template <typename... Args>
class EventHandler final : public EventHandlerBase {
 public:
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
  ~EventHandler() override;

  // --- for the event that is subscribed to -----------------------------------------------------
  void bind(Event<Args...>& event) { about().source = &event; }
  void unbind() { about().source = nullptr; }
  /// For a component that calls out (see Component::call_out).
  void handle(ExecutionContext& where, const Args&... arguments) noexcept {
    handle_(*this, where, arguments...);
  }
  using EventHandlerBase::count_drop;

 private:
  using Handle = void (*)(EventHandler&, ExecutionContext&, const Args&...) noexcept;

  EventHandler(Component& owner, std::string_view name, std::string_view doc, Handle call) noexcept;
  EventHandler(Component& owner, std::string_view name, std::string_view doc,
               void (*function)(void* self, const Args&...), void* self) noexcept;

  struct About final : EventHandlerBase::About {
    using EventHandlerBase::About::About;
    ~About() override;
    void (*function)(void* self, const Args&...) = nullptr;
    void* self = nullptr;
  };
  About& about() const { return static_cast<About&>(EventHandlerBase::about()); }

  template <typename Code>
  void handle_with(ExecutionContext& where, Code&& code) noexcept {
    Component& component = owner();
    const bool own_thread = &where == &component.context();
    if (own_thread ? !component.admits() : component.state() != State::kRunning) return;
    if (inside_) [[unlikely]]
      return refuse(where);
    inside_ = true;
    component.enter_handler(where, *this, outer_, code);
    inside_ = false;
  }

  Handle handle_;
};

// Compiled once, in the library.
extern template class Event<>;
extern template class EventHandler<>;

}  // namespace armature::component

#include "armature/component/internal/event_definitions.hpp"
