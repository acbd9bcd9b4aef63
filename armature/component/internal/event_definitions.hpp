// SPDX-License-Identifier: Apache-2.0
#pragma once

// What of events and their handlers is not in their header: nothing of this is needed when an event
// is raised in the thread of its handlers.

#include <memory>
#include <string_view>
#include <tuple>

#include "armature/component/event.hpp"
#include "armature/rt/ring.hpp"

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

template <typename... Args>
struct EventHandler<Args...>::Queue final : rt::Signal {
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
            Component& component = queue.self.owner();
            component.run(component.context(),
                          [&] { queue.self.handle(component.context(), arguments...); });
          },
          *event);
    }
  }
  EventHandler& self;
  rt::Ring<std::tuple<Args...>> events;
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
  Queue& queue = *about().queue;
  if (queue.events.push(std::tuple<Args...>(arguments...)) == rt::PushResult::kRefused) {
    count_drop();
    return false;
  }
  owner().context().raise(queue);
  return true;
}

}  // namespace armature::component
