// SPDX-License-Identifier: Apache-2.0
#pragma once

// What of events and their handlers is not in their header: nothing of this is needed when an event
// is raised in the thread of its handlers.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "armature/component/event.hpp"
#include "armature/rt/entry_pool.hpp"

namespace armature::component {

template <typename... Args>
Event<Args...>::Event(Component* owner, std::string_view name, std::string_view doc,
                      std::initializer_list<std::string_view> names) noexcept
    : EventBase(*owner, name, doc, Signature::of<void, Args...>(names)) {}

template <typename... Args>
Event<Args...>::~Event() = default;

/// Events on their way to handlers of another thread. Each is one message, however many handlers
/// the thread has, so that it has its place among all others that the raiser sent there.
template <typename... Args>
struct Event<Args...>::Queue {
  struct Entry final : rt::Message {
    Entry() : rt::Message(&Entry::deliver) {}
    static void deliver(rt::Message& message) {
      auto& entry = static_cast<Entry&>(message);
      const Queue& queue = *entry.queue;
      const std::tuple<Args...> event = entry.event;
      entry.in_use.give_back();
      for (EventHandler<Args...>* handler : queue.handlers) {
        handler->owner().run_handler(queue.where, [&] {
          std::apply([&](const Args&... arguments) { handler->handle(queue.where, arguments...); },
                     event);
        });
      }
    }
    const Queue* queue = nullptr;
    std::tuple<Args...> event{};
    rt::InUse in_use;
  };

  Queue(ExecutionContext& thread, std::size_t size) : where(thread), entries(size) {
    for (Entry& entry : entries) entry.queue = this;
  }

  ExecutionContext& where;
  std::vector<EventHandler<Args...>*> handlers;
  rt::EntryPool<Entry> entries;
};

template <typename... Args>
std::unique_ptr<EventBase> Event<Args...>::twin(StandIn& owner) const {
  auto made = std::make_unique<Event>(&owner, name(), doc());
  mark_twin(*made);
  return made;
}

template <typename... Args>
RaiseStatus Event<Args...>::raise_from([[maybe_unused]] const void* const* arguments) noexcept {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return raise(*static_cast<const Args*>(arguments[I])...);
  }
  (std::index_sequence_for<Args...>{});
}

template <typename... Args>
void Event<Args...>::subscribe(EventHandlerBase& base) {
  auto& handler = static_cast<EventHandler<Args...>&>(base);
  subscribers_.push_back(&base);
  handler.bind(*this);
  const bool same_thread = &owner().context() == &base.owner().context();
  const bool direct = same_thread || base.runs_in_raisers_thread();
  (direct ? direct_ : queue_to(base).handlers).push_back(&handler);
}

/// Handlers of one thread share a queue, but each has as many entries as it declared, and their
/// order stays: so only with those before it that declared the same.
template <typename... Args>
typename Event<Args...>::Queue& Event<Args...>::queue_to(EventHandlerBase& handler) {
  ExecutionContext& where = handler.owner().context();
  const auto last = std::find_if(queues_.rbegin(), queues_.rend(),
                                 [&](const auto& queue) { return &queue->where == &where; });
  const bool alike = last != queues_.rend() &&
                     (*last)->handlers.front()->queue_capacity() == handler.queue_capacity();
  if (alike) return **last;
  return *queues_.emplace_back(std::make_unique<Queue>(where, handler.queue_capacity()));
}

template <typename... Args>
void Event<Args...>::unsubscribe_all() {
  for (EventHandlerBase* base : subscribers_) {
    static_cast<EventHandler<Args...>*>(base)->unbind();
  }
  subscribers_.clear();
  direct_.clear();
  queues_.clear();
}

template <typename... Args>
bool Event<Args...>::enqueue(Queue& queue, const Args&... arguments) {
  auto* const entry = queue.entries.claim();
  if (entry == nullptr) {
    for (EventHandler<Args...>* handler : queue.handlers) handler->count_drop();
    return false;
  }
  entry->event = std::tuple<Args...>(arguments...);
  queue.where.post_soon(*entry);
  return true;
}

template <typename... Args>
EventHandler<Args...>::About::~About() = default;

template <typename... Args>
EventHandler<Args...>::EventHandler(Component& owner, std::string_view name, std::string_view doc,
                                    Handle call) noexcept
    : EventHandlerBase(owner, std::make_unique<About>(name, doc, Signature::of<void, Args...>({}))),
      handle_(call) {}

template <typename... Args>
EventHandler<Args...>::EventHandler(Component& owner, std::string_view name, std::string_view doc,
                                    void (*function)(void* self, const Args&...),
                                    void* self) noexcept
    : EventHandler(
          owner, name, doc,
          [](EventHandler& handler, ExecutionContext& where, const Args&... arguments) noexcept {
            const About& about = handler.about();
            handler.handle_with(where, [&] { about.function(about.self, arguments...); });
          }) {
  about().function = function;
  about().self = self;
}

template <typename... Args>
EventHandler<Args...>::~EventHandler() = default;

}  // namespace armature::component
