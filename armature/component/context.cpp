// SPDX-License-Identifier: Apache-2.0
#include "armature/component/context.hpp"

#include <utility>

#include "armature/component/lanes.hpp"

namespace armature::component {

struct ExecutionContext::Mail {
  rt::Inbox inbox;
  rt::Inbox next_cycle;
  rt::Wakeup wakeup;
  rt::Outbox outbox;
};

ExecutionContext::ExecutionContext(std::string context_name)
    : mail_(std::make_unique<Mail>()),
      name(std::move(context_name)),
      inbox(mail_->inbox),
      next_cycle(mail_->next_cycle),
      wakeup(mail_->wakeup),
      outbox(mail_->outbox) {
  limit_depth(kLeastDepthLimit);
}

ExecutionContext::~ExecutionContext() = default;

LaneTo::LaneTo(rt::Outbox& writers_outbox, ExecutionContext& reading)
    : outbox(writers_outbox), reader(reading), lane(reading.inbox) {}

LaneTo& ExecutionContext::lane_to(ExecutionContext& reader) {
  for (const std::unique_ptr<LaneTo>& lane : lanes) {
    if (&lane->reader == &reader) return *lane;
  }
  return *lanes.emplace_back(std::make_unique<LaneTo>(outbox, reader));
}

void ExecutionContext::post(rt::Message& message) {
  rt::send_gathered();
  inbox.push(message);
  wake();
}

void ExecutionContext::raise(rt::Signal& signal) {
  rt::send_gathered();
  if (signal.raise(inbox)) wake();
}

void ExecutionContext::post_soon(rt::Message& message) {
  rt::send_gathered();
  inbox.push(message);
  wake_soon();
}

void ExecutionContext::raise_soon(rt::Signal& signal) {
  rt::send_gathered();
  if (signal.raise(inbox)) wake_soon();
}

void ExecutionContext::flush() {
  if (outbox.any()) outbox.flush();
}

void ExecutionContext::wake() {
  if (wakes_on_messages.load(std::memory_order_relaxed)) wakeup.notify();
}

void ExecutionContext::wake_soon() {
  if (wakes_on_messages.load(std::memory_order_relaxed)) rt::notify_soon(wakeup);
}

void ExecutionContext::limit_depth(int limit) {
  hooks = std::make_unique<HookEntrance[]>(static_cast<std::size_t>(limit));
  next_hook = hooks.get();
  end_of_hooks = hooks.get() + limit;
}

}  // namespace armature::component
