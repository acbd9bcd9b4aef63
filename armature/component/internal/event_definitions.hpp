// SPDX-License-Identifier: Apache-2.0
#pragma once

// What of events and their handlers is not in their header: nothing of this is needed when an event
// is raised in the thread of its handlers.

#include <memory>
#include <string_view>
#include <tuple>

#include "armature/component/event.hpp"
#include "armature/rt/entry_pool.hpp"

namespace armature::component {

template <typename... Args>
Event<Args...>::Event(Component* owner, std::string_view name, std::string_view doc,
                      std::initializer_list<std::string_view> names) noexcept
    : EventBase(*owner, name, doc, Signature::of<void, Args...>(names)) {}

template <typename... Args>
Event<Args...>::~Event() = default;

template <typename... Args>
void Event<Args...>::subscribe(EventHandlerBase& base) {
  auto& handler = static_cast<EventHandler<Args...>&>(base);
  subscribers_.push_back(&base);
  const bool same_thread = &owner().context() == &base.owner().context();
  const bool direct = same_thread || base.runs_in_raisers_thread();
  (direct ? direct_ : queued_).push_back(&handler);
  handler.bind(*this, !direct);
}

template <typename... Args>
void Event<Args...>::unsubscribe_all() {
  for (EventHandlerBase* base : subscribers_) {
    static_cast<EventHandler<Args...>*>(base)->unbind();
  }
  subscribers_.clear();
  direct_.clear();
  queued_.clear();
}

/// Events on their way to another thread. Each is a message, so that it has its place among all
/// others that the raiser sent there.
template <typename... Args>
struct EventHandler<Args...>::Queue {
  struct Entry final : rt::Message {
    Entry() : rt::Message(&Entry::deliver) {}
    static void deliver(rt::Message& message) {
      auto& entry = static_cast<Entry&>(message);
      EventHandler& handler = *entry.handler;
      const std::tuple<Args...> event = entry.event;
      entry.in_use.give_back();
      Component& component = handler.owner();
      component.run_handler(component.context(), [&] {
        std::apply(
            [&](const Args&... arguments) { handler.handle(component.context(), arguments...); },
            event);
      });
    }
    EventHandler* handler = nullptr;
    std::tuple<Args...> event{};
    rt::InUse in_use;
  };

  Queue(EventHandler& handler, std::size_t size) : entries(size) {
    for (Entry& entry : entries) entry.handler = &handler;
  }

  rt::EntryPool<Entry> entries;
};

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

template <typename... Args>
void EventHandler<Args...>::bind(Event<Args...>& event, bool queued) {
  about().source = &event;
  if (queued) about().queue = std::make_unique<Queue>(*this, queue_capacity());
}
template <typename... Args>
void EventHandler<Args...>::unbind() {
  about().source = nullptr;
  about().queue.reset();
}

template <typename... Args>
bool EventHandler<Args...>::enqueue(const Args&... arguments) {
  auto* const entry = about().queue->entries.claim();
  if (entry == nullptr) {
    count_drop();
    return false;
  }
  entry->event = std::tuple<Args...>(arguments...);
  owner().context().post_soon(*entry);
  return true;
}

}  // namespace armature::component
