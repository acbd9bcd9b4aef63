// SPDX-License-Identifier: Apache-2.0
#include "armature/component/events/event.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "armature/component/events/event_tap.hpp"
#include "armature/component/host.hpp"
#include "armature/component/internal/arguments.hpp"
#include "armature/component/lanes.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/component/untyped.hpp"
#include "armature/rt/entry_pool.hpp"

namespace armature::component {

struct EventHandlerBase::About final : Requirement::About {
  About(std::string_view its_name, std::string_view its_doc, Signature its_signature)
      : Requirement::About(its_name, its_doc), signature(std::move(its_signature)) {}

  Signature signature;
  bool in_raisers_thread = false;
  LeadsTo leads_to;
  std::size_t queue_capacity = kDefaultEventQueue;
  EventBase* source = nullptr;
  std::atomic<std::uint64_t> dropped{0};
  FreeFunction function;
};

EventHandlerBase::EventHandlerBase(Component& owner, std::string_view name, std::string_view doc,
                                   Signature signature) noexcept
    : Requirement(owner, std::make_unique<About>(name, doc, std::move(signature))) {
  Host::declare(owner).handlers.push_back(this);
}

EventHandlerBase::~EventHandlerBase() = default;

EventHandlerBase::About& EventHandlerBase::about() const {
  return static_cast<About&>(Requirement::about());
}

const Signature& EventHandlerBase::signature() const { return about().signature; }

bool EventHandlerBase::runs_in_raisers_thread() const { return about().in_raisers_thread; }

const LeadsTo& EventHandlerBase::effects() const { return about().leads_to; }

std::size_t EventHandlerBase::queue_capacity() const { return about().queue_capacity; }

EventBase* EventHandlerBase::source() const { return about().source; }

std::uint64_t EventHandlerBase::dropped() const {
  return about().dropped.load(std::memory_order_relaxed);
}

void EventHandlerBase::apply(InRaisersThread) noexcept { about().in_raisers_thread = true; }

void EventHandlerBase::apply(const LeadsTo& effects) noexcept { about().leads_to = effects; }

void EventHandlerBase::apply(QueueSize queue) noexcept { about().queue_capacity = queue.capacity; }

void EventHandlerBase::set_free_function(FreeFunction function) noexcept {
  about().function = function;
}

FreeFunction EventHandlerBase::free_function() const noexcept { return about().function; }

/// Events on their way to handlers of another thread. Each is one message, however many handlers
/// the thread has, so that it has its place among all others that the raiser sent there.
struct EventBase::Queue {
  struct Entry final : rt::Message {
    Entry() : rt::Message(&Entry::deliver) {}
    static void deliver(rt::Message& message) {
      auto& entry = static_cast<Entry&>(message);
      Queue& queue = *entry.queue;
      queue.handled.assign(entry.arguments.places());
      entry.in_use.give_back();
      queue.run_handlers();
    }
    Queue* queue = nullptr;
    internal::Arguments arguments;
    rt::InUse in_use;
  };

  Queue(ExecutionContext& thread, const Signature& signature, std::size_t size)
      : where(thread), handled(signature), entries(size) {
    for (Entry& entry : entries) {
      entry.queue = this;
      entry.arguments = internal::Arguments(signature);
    }
  }

  void run_handlers() {
    for (EventHandlerBase* handler : handlers) {
      Host::run_handler(handler->owner(), where,
                        [this, handler] { handler->handle_from(where, handled.places()); });
    }
  }

  bool push(const void* const* arguments) {
    Entry* const entry = entries.claim();
    if (entry == nullptr) {
      for (EventHandlerBase* handler : handlers) {
        handler->about().dropped.store(handler->dropped() + 1, std::memory_order_relaxed);
      }
      return false;
    }
    entry->arguments.assign(arguments);
    where.post_soon(*entry);
    return true;
  }

  ExecutionContext& where;
  std::vector<EventHandlerBase*> handlers;
  internal::Arguments handled;  ///< by the handlers' thread
  rt::EntryPool<Entry> entries;
};

EventBase::EventBase(Component& owner, std::string_view name, std::string_view doc,
                     Signature signature) noexcept
    : owner_(owner), name_(name), doc_(doc), signature_(std::move(signature)) {
  Host::declare(owner).events.push_back(this);
}

EventBase::~EventBase() = default;

void EventBase::subscribe(EventHandlerBase& handler) {
  subscribers_.push_back(&handler);
  handler.about().source = this;
  const bool same_thread = &Host::context(owner()) == &Host::context(handler.owner());
  const bool direct = same_thread || handler.runs_in_raisers_thread();
  auto* const untyped = dynamic_cast<UntypedEventHandler*>(&handler);
  if (direct && untyped != nullptr) return untyped->listen(*this);
  (direct ? direct_ : queue_to(handler).handlers).push_back(&handler);
}

/// Handlers of one thread share a queue, but each has as many entries as it declared, and their
/// order stays: so only with those before it that declared the same.
EventBase::Queue& EventBase::queue_to(EventHandlerBase& handler) {
  ExecutionContext& where = Host::context(handler.owner());
  const auto last = std::find_if(queues_.rbegin(), queues_.rend(),
                                 [&](const auto& queue) { return &queue->where == &where; });
  const bool alike = last != queues_.rend() &&
                     (*last)->handlers.front()->queue_capacity() == handler.queue_capacity();
  if (alike) return **last;
  return *queues_.emplace_back(
      std::make_unique<Queue>(where, signature_, handler.queue_capacity()));
}

void EventBase::unsubscribe_all() {
  for (EventHandlerBase* handler : subscribers_) {
    handler->about().source = nullptr;
    auto* const untyped = dynamic_cast<UntypedEventHandler*>(handler);
    if (untyped != nullptr) untyped->listen_no_more(*this);
  }
  subscribers_.clear();
  direct_.clear();
  queues_.clear();
}

RaiseStatus EventBase::enqueue(const void* const* arguments) noexcept {
  RaiseStatus status = RaiseStatus::kDelivered;
  for (const std::unique_ptr<Queue>& queue : queues_) {
    if (!queue->push(arguments)) status = RaiseStatus::kQueueFull;
  }
  rt::flush_outbox();  // who is told of an event is woken at once
  return status;
}

RaiseStatus EventBase::raise_from(const void* const* arguments) noexcept {
  const RaiseStatus status = begin_raise(arguments);
  for (EventHandlerBase* handler : direct_) {
    Host::call_out(owner(), handler->owner(),
                   [&] { handler->handle_from(Host::context(owner()), arguments); });
  }
  if (is_tapped()) tell_taps(arguments);
  return status;
}

/// What stands for an event of a component that lives elsewhere.
class EventBase::Twin final : public EventBase {
 public:
  Twin(StandIn& owner, const EventBase& original)
      : EventBase(owner, original.name(), original.doc(), original.signature()) {}
};

std::unique_ptr<EventBase> EventBase::twin(StandIn& owner) const {
  return std::make_unique<Twin>(owner, *this);
}

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

}  // namespace armature::component
