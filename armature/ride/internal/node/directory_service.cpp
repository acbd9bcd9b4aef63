// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/directory_service.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <tuple>
#include <utility>

namespace armature::ride::internal {

void DirectoryService::execute(Link& link, const Question& question, Decoder& parameters) const {
  const auto answer = [&](const auto& result) {
    const auto fields = std::tie(result);
    if (!question.is_request) return;
    link.send({static_cast<std::uint8_t>(question.message.header.priority)}, Type::kReply,
              Recipient(question.call), {}, Fields(fields), Link::Flush::kNow);
  };
  const auto take = [&](auto&... values) {
    const bool taken = (parameters.take(values) && ...) && parameters.ended();
    if (!taken) {
      link.refuse(Code::kMalformed, question.message,
                  "the parameters do not fit the directory's operation");
    }
    return taken;
  };
  Wish wish;
  std::string name;
  switch (question.operation) {
    case kFind: {
      if (!take(name)) return;
      const Hosted* const found = services_.find(name);
      return answer(found != nullptr ? found->entry() : ComponentEntry{});
    }
    case kList:
      if (take()) answer(services_.entries());
      return;
    case kSubscribe:
      if (!take(wish.component, wish.event, wish.subscription)) return;
      return answer(subscribe(link, wish));
    case kUnsubscribe:
      if (!take(wish.subscription)) return;
      return answer(unsubscribe(link, wish.subscription));
    default:
      link.refuse(Code::kNoSuchOperation, question.message, "the directory has no such operation");
  }
}

/// @return 0, or the code of why not
std::int32_t DirectoryService::subscribe(Link& link, const Wish& wish) const {
  const Hosted* const hosted = services_.find(static_cast<std::uint32_t>(wish.component));
  if (hosted == nullptr) return static_cast<std::int32_t>(Code::kNoSuchComponent);
  if (!hosted->publisher().has_event(wish.event)) {
    return static_cast<std::int32_t>(Code::kNoSuchOperation);
  }
  const std::string identity = link.identity();
  const AccessQuestion question{link.scheme, identity, hosted->name, Access::kRead};
  if (!access_.allows(question)) return refuse(link, Code::kNotAllowed, not_allowed(question));
  return subscribe(link, *hosted, wish.event, static_cast<std::uint32_t>(wish.subscription));
}

std::int32_t DirectoryService::subscribe(Link& link, const Hosted& hosted, Number event,
                                         std::uint32_t subscription) const {
  std::shared_ptr<EventQueue> queue;
  try {
    queue = std::make_shared<EventQueue>(link.shared_from_this(), link.memory, subscription, event,
                                         hosted.identifier,
                                         core_.options.limits.events_per_subscription);
  } catch (const std::bad_alloc&) {
    return refuse(link, Code::kBusy, "not enough memory for it");
  }
  const Code refusal = add_queue(link, queue);
  if (refusal == Code::kBusy)
    return refuse(link, refusal, "it has reached its limit of subscriptions");
  if (refusal == Code::kNone) hosted.publisher().add(std::move(queue));
  return static_cast<std::int32_t>(refusal);
}

Code DirectoryService::add_queue(Link& link, std::shared_ptr<EventQueue> queue) const {
  const std::lock_guard lock(link.mutex());
  // It may have gone with this message still here: nobody would ever end the subscription.
  if (!link.open()) return Code::kShuttingDown;
  const bool taken = std::ranges::any_of(link.event_queues, [&](const auto& other) {
    return other->subscription == queue->subscription;
  });
  if (taken) return Code::kMalformed;
  const auto same = std::ranges::count_if(link.event_queues, [&](const auto& other) {
    return other->component == queue->component && other->event == queue->event;
  });
  const Limits& limits = core_.options.limits;
  if (static_cast<std::size_t>(same) >= limits.subscriptions_to_an_event) return Code::kBusy;
  if (link.event_queues.size() >= limits.subscriptions) return Code::kBusy;
  link.event_queues.push_back(std::move(queue));
  return Code::kNone;
}

std::int32_t DirectoryService::refuse(const Link& link, Code code, std::string_view why) const {
  Counters::increase(core_.counters.refusals);
  core_.journal.tell(rt::LogLevel::kWarning, "{} was refused a subscription: {} ({})",
                     link.other_end(), name_of(code), why);
  return static_cast<std::int32_t>(code);
}

std::int32_t DirectoryService::unsubscribe(Link& link, std::int32_t subscription) const {
  const auto chosen = static_cast<std::uint32_t>(subscription);
  std::shared_ptr<EventQueue> queue;
  {
    const std::lock_guard lock(link.mutex());
    const auto at = std::ranges::find_if(
        link.event_queues, [&](const auto& other) { return other->subscription == chosen; });
    if (at == link.event_queues.end()) return static_cast<std::int32_t>(Code::kNoSuchComponent);
    queue = std::move(*at);
    link.event_queues.erase(at);
  }
  if (const Hosted* const hosted = services_.find(queue->component)) {
    hosted->publisher().remove(link, chosen);
  }
  return 0;
}

}  // namespace armature::ride::internal
