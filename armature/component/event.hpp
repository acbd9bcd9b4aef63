// SPDX-License-Identifier: Apache-2.0
#pragma once

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
#include "armature/component/port.hpp"
#include "armature/component/requirement.hpp"
#include "armature/component/signature.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/ring.hpp"
#include "armature/types/type.hpp"

namespace armature::component {

class EventHandlerBase;

/// What a component itself does at once when it raises one of its events.
class EventListener {
 public:
  virtual void event_raised() = 0;

 protected:
  ~EventListener() = default;
};

/// Something that happens to a component and that others may react to.
class EventBase {
 public:
  EventBase(const EventBase&) = delete;
  EventBase& operator=(const EventBase&) = delete;
  virtual ~EventBase() = default;

  std::string_view name() const { return name_; }
  std::string_view doc() const { return doc_; }
  const Signature& signature() const { return signature_; }
  Component& owner() const { return owner_; }
  std::uint64_t raised() const { return raised_; }
  const std::vector<EventHandlerBase*>& subscribers() const { return subscribers_; }

  /// Subscribes `handler`, which has the same signature, for the threads that both components are
  /// assigned to. Handlers are told in the order of their subscription, but those in other threads
  /// first: they are to know of the event before data that it causes reaches them.
  /// @thread configuration only
  virtual void subscribe(EventHandlerBase& handler) = 0;
  virtual void unsubscribe_all() = 0;

  /// `listener` belongs to the same component and is told before the subscribers.
  void add_listener(EventListener& listener) { listeners_.push_back(&listener); }

 protected:
  EventBase(Component& owner, std::string_view name, std::string_view doc, Signature signature)
      : owner_(owner), name_(name), doc_(doc), signature_(std::move(signature)) {
    owner.declare().events.push_back(this);
  }

  void tell_listeners() {
    for (EventListener* listener : listeners_) listener->event_raised();
  }

  std::uint64_t raised_ = 0;
  std::vector<EventHandlerBase*> subscribers_;

 private:
  Component& owner_;
  std::string_view name_;
  std::string_view doc_;
  Signature signature_;
  std::vector<EventListener*> listeners_;
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
  const Signature& signature() const { return signature_; }
  bool runs_in_raisers_thread() const { return in_raisers_thread_; }
  const LeadsTo& effects() const { return leads_to_; }
  std::size_t queue_capacity() const { return queue_capacity_; }
  EventBase* source() const { return source_; }
  bool bound() const override { return source_ != nullptr; }
  /// Events that came while the queue was full.
  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 protected:
  EventHandlerBase(Component& owner, std::string_view name, std::string_view doc,
                   Signature signature)
      : Requirement(owner, name, doc), entrance_(owner, name), signature_(std::move(signature)) {
    owner.declare().handlers.push_back(this);
  }

  using Requirement::apply;
  void apply(InRaisersThread) { in_raisers_thread_ = true; }
  void apply(const LeadsTo& effects) { leads_to_ = effects; }
  void apply(QueueSize queue) { queue_capacity_ = queue.capacity; }

  void count_drop() { dropped_.store(dropped() + 1, std::memory_order_relaxed); }

  Entrance entrance_;
  EventBase* source_ = nullptr;

 private:
  Signature signature_;
  bool in_raisers_thread_ = false;
  LeadsTo leads_to_;
  std::size_t queue_capacity_ = kDefaultEventQueue;
  std::atomic<std::uint64_t> dropped_{0};
};

enum class RaiseStatus : std::uint8_t { kDelivered, kNobodyListens, kQueueFull };

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
        std::initializer_list<std::string_view> names = {})
      : EventBase(*owner, name, doc, Signature::of<void, Args...>(names)) {}

  /// Tells all subscribers: those in this thread run now, the others are queued.
  /// @return kQueueFull if at least one subscriber could not be told
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  RaiseStatus raise(const Args&... arguments) {
    ++raised_;
    RaiseStatus status =
        subscribers_.empty() ? RaiseStatus::kNobodyListens : RaiseStatus::kDelivered;
    tell_listeners();
    for (EventHandler<Args...>* handler : queued_) {
      if (!handler->enqueue(arguments...)) status = RaiseStatus::kQueueFull;
    }
    for (EventHandler<Args...>* handler : direct_) handler->handle(owner().context(), arguments...);
    return status;
  }

  void subscribe(EventHandlerBase& base) override {
    auto& handler = static_cast<EventHandler<Args...>&>(base);
    subscribers_.push_back(&base);
    const bool same_thread = &owner().context() == &base.owner().context();
    const bool direct = same_thread || base.runs_in_raisers_thread();
    (direct ? direct_ : queued_).push_back(&handler);
    handler.bind(*this, !direct);
  }

  void unsubscribe_all() override {
    for (EventHandlerBase* base : subscribers_) {
      static_cast<EventHandler<Args...>*>(base)->unbind();
    }
    subscribers_.clear();
    direct_.clear();
    queued_.clear();
  }

 private:
  std::vector<EventHandler<Args...>*> direct_;
  std::vector<EventHandler<Args...>*> queued_;
};

/// Runs a member function when a peer raises the event of the same name and arguments: at once if
/// both share a thread, else in the handler's own thread, once for each event, in their order.
template <typename... Args>
class EventHandler final : public EventHandlerBase {
 public:
  /// Options: from(property or name), optional, in_raisers_thread, queue(n).
  template <auto Function, typename... Options>
  EventHandler(Component* owner, std::string_view name, Serve<Function>, std::string_view doc,
               Options... options)
      : EventHandler(
            owner, name,
            [](void* self, const Args&... arguments) {
              using Owner = internal::OwnerOf<Function>;
              static_assert(std::is_invocable_v<decltype(Function), Owner&, const Args&...>,
                            "the member function does not take the arguments of the event");
              (static_cast<Owner&>(*static_cast<Component*>(self)).*Function)(arguments...);
            },
            owner, doc, options...) {}

  /// For handlers that are not a member function: `function` is given `self`.
  template <typename... Options>
  EventHandler(Component* owner, std::string_view name,
               void (*function)(void* self, const Args&...), void* self, std::string_view doc,
               Options... options)
      : EventHandlerBase(*owner, name, doc, Signature::of<void, Args...>({})),
        function_(function),
        self_(self) {
    (apply(options), ...);
  }

  // --- for the event that is subscribed to -----------------------------------------------------
  void bind(Event<Args...>& event, bool queued) {
    source_ = &event;
    if (queued) queue_ = std::make_unique<Queue>(*this, queue_capacity());
  }
  void unbind() {
    source_ = nullptr;
    queue_.reset();
  }
  void handle(ExecutionContext& where, const Args&... arguments) {
    Component& component = owner();
    const bool own_thread = &where == &component.context();
    if (own_thread ? !component.admits() : component.state() != State::kRunning) return;
    entrance_.pass(where, [&] { component.run(where, [&] { function_(self_, arguments...); }); });
  }
  bool enqueue(const Args&... arguments) {
    if (queue_->events.push(std::tuple<Args...>(arguments...)) == rt::PushResult::kRefused) {
      count_drop();
      return false;
    }
    owner().context().raise(*queue_);
    return true;
  }

 private:
  struct Queue final : rt::Signal {
    Queue(EventHandler& handler, std::size_t capacity)
        : rt::Signal(&Queue::deliver),
          self(handler),
          events(capacity, rt::WhenFull::kRefuse, std::tuple<Args...>{}) {}
    static void deliver(rt::Message& message) {
      auto& queue = static_cast<Queue&>(message);
      queue.lower();
      while (const std::tuple<Args...>* event = queue.events.pop()) {
        std::apply(
            [&queue](const Args&... arguments) {
              queue.self.handle(queue.self.owner().context(), arguments...);
            },
            *event);
      }
    }
    EventHandler& self;
    rt::Ring<std::tuple<Args...>> events;
  };

  void (*function_)(void* self, const Args&...);
  void* self_;
  std::unique_ptr<Queue> queue_;
};

}  // namespace armature::component
