// SPDX-License-Identifier: Apache-2.0
// Of NodeState: what a message does.
#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "armature/ride/internal/node_state.hpp"
#include "armature/ride/internal/peer_state.hpp"
#include "armature/ride/internal/publisher.hpp"

namespace armature::ride::internal {
namespace {

/// `setVelocity` of `void setVelocity(float,float)`.
std::string_view operation_name(std::string_view canonical) {
  const std::size_t end = canonical.find_last_of('(') == std::string_view::npos
                              ? canonical.size()
                              : canonical.find('(', 0);
  const std::size_t begin = canonical.rfind(' ', end);
  return begin == std::string_view::npos ? canonical.substr(0, end)
                                         : canonical.substr(begin + 1, end - begin - 1);
}

const Declaration* find_declaration(const Interface& interface, Number number) {
  const auto found = std::ranges::find_if(
      interface.declarations,
      [&](const Declaration& declaration) { return declaration.number() == number; });
  return found == interface.declarations.end() ? nullptr : &*found;
}

std::string what_is_malformed(const Decoder& parameters) {
  if (parameters.problem().empty()) {
    return "its parameters are not those of the operation, or out of range";
  }
  return parameters.problem();
}

}  // namespace

void NodeState::refused(const Link& link, Code code, const Message& message,
                        std::string_view text) {
  counters_.refusals.fetch_add(1, std::memory_order_relaxed);
  journal_.tell(rt::LogLevel::kWarning, "{} was refused a {}: {} ({})", link.end_locked(),
                name_of(message.header.type), name_of(code), text);
}

void NodeState::dispatch(Link& link, const Message& message) {
  constexpr std::uint32_t kMostUrgent = 255;
  if (message.header.priority > kMostUrgent) {
    return link.refuse(Code::kMalformed, message, "a priority above 255");
  }
  switch (message.header.type) {
    case Type::kCommand:
      return execute(link, message, false);
    case Type::kRequest:
      return execute(link, message, true);
    case Type::kReply:
      return;  // Too late: whoever has asked has given up.
    case Type::kEvent:
      if (link.peer != nullptr) return link.peer->take_event(message);
      return link.refuse(Code::kNoSuchComponent, message, "it has no subscriber");
    case Type::kControl:
      return take_control(link, message);
  }
  link.refuse(Code::kMalformed, message, "unknown type of message");
}

void NodeState::take_control(Link& link, const Message& message) {
  Decoder from(message.body);
  Control control;
  if (!from.take(control) || !from.ended()) {
    return link.refuse(Code::kMalformed, message, "the body is not that of a CONTROL message");
  }
  switch (control.code) {
    case Code::kHello:
      if (link.peer != nullptr) return link.peer->take_hello(control.text);
      if (!std::exchange(link.greeted, true)) {
        link.send_control(0,
                          {Code::kHello, 0, 0, 0, options_.name + " armature/" ARMATURE_VERSION});
      }
      return;
    case Code::kPing:
      link.send_control(0, {Code::kPong, 0, 0, 0, control.text});
      return;
    case Code::kPong:
      return;
    default:
      break;
  }
  const bool leaves = control.code == Code::kShuttingDown;
  journal_.tell(leaves ? rt::LogLevel::kInfo : rt::LogLevel::kWarning, "{} says: {} {}: {}",
                link.other_end(), name_of(control.code), static_cast<std::uint32_t>(control.code),
                control.text);
}

NodeState::Hosted* NodeState::find_hosted(std::uint32_t identifier) {
  if (identifier == 0 || identifier > hosted_.size()) return nullptr;
  Hosted& hosted = hosted_[identifier - 1];
  return hosted.service != nullptr ? &hosted : nullptr;
}

void NodeState::execute(Link& link, const Message& message, bool is_request) {
  Holding holding(link.memory);
  Decoder parameters(message.body, &holding);
  Number operation = 0;
  std::uint32_t call = 0;
  if (!parameters.take(operation) || (is_request && !parameters.take(call))) {
    return link.refuse(Code::kMalformed, message, "no operation in its body");
  }
  if (message.header.identifier == kDirectory) {
    return execute_directory(link, message, operation, call, is_request, parameters);
  }
  Hosted* const hosted = find_hosted(message.header.identifier);
  if (hosted == nullptr) {
    return link.refuse(Code::kNoSuchComponent, message, "no component has this identifier");
  }
  if (options_.allows) {
    const auto refusal = refusal_of_operation(link, *hosted, operation, link.identity());
    if (refusal) return link.refuse(refusal->code, message, refusal->text);
  }
  if (is_request &&
      link.kept_replies.load(std::memory_order_relaxed) >= options_.limits.pending_replies) {
    return link.refuse(Code::kBusy, message, "too many requests wait for an answer");
  }
  run_service(link, message, *hosted, operation, call, is_request, parameters, holding);
}

/// What a refusal would cost to gather first: nothing is kept for who may not, or asks what is not
/// there.
std::optional<Refusal> NodeState::refusal_of(const Link& link, const Message& first,
                                             const std::string& identity) {
  const Type type = first.header.type;
  const bool is_operation = type == Type::kCommand || type == Type::kRequest;
  if (type == Type::kEvent && link.peer != nullptr) return std::nullopt;
  if (type == Type::kEvent) return Refusal{Code::kNoSuchComponent, "it has no subscriber"};
  if (type == Type::kControl) return Refusal{Code::kTooLarge, "CONTROL must be a single message"};
  if (!is_operation) return Refusal{Code::kMalformed, "unknown type of message"};
  Decoder from(first.body);
  Number operation = 0;
  if (!from.take(operation)) return Refusal{Code::kMalformed, "no operation in its body"};
  if (first.header.identifier == kDirectory) {
    return Refusal{Code::kTooLarge, "a request to the directory must be a single message"};
  }
  const std::lock_guard lock(hosted_mutex_);
  const Hosted* const hosted = find_hosted(first.header.identifier);
  if (hosted == nullptr) {
    return Refusal{Code::kNoSuchComponent, "no component has this identifier"};
  }
  const Declaration* const declaration = find_declaration(hosted->service->interface(), operation);
  if (declaration == nullptr || declaration->is_event()) {
    return Refusal{Code::kNoSuchOperation,
                   "'" + hosted->name + "' has no operation of this number"};
  }
  return refusal_of_operation(link, *hosted, operation, identity);
}

/// The other end of a link, for an operation that asks what it may do to further components.
class NodeState::SenderAt final : public Sender {
 public:
  SenderAt(const NodeState& node, Link& link) : node_(node), link_(link) {}

  bool allows(std::string_view component, Access access) const override {
    return node_.is_allowed({link_.scheme, link_.identity(), component, access});
  }
  std::string refusal(std::string_view component, Access access) const override {
    return node_.not_allowed({link_.scheme, link_.identity(), component, access});
  }
  Origin origin() const override {
    const auto identity = link_.identity();
    const AccessQuestion question{link_.scheme, identity, {}, Access::kCommand};
    return {link_.weak_from_this(), link_.connection_number(), who(question)};
  }

 private:
  const NodeState& node_;
  Link& link_;
};

void NodeState::run_service(Link& link, const Message& message, Hosted& hosted, Number operation,
                            std::uint32_t call, bool is_request, Decoder& parameters,
                            Holding& holding) {
  const Priority priority{static_cast<std::uint8_t>(message.header.priority)};
  const SenderAt sender(*this, link);
  Reply reply(is_request ? &link : nullptr, call, priority, operation, hosted.identifier, &sender,
              &holding, &parameters);
  try {
    const Executed executed = ServiceAccess::execute(*hosted.service, operation, parameters, reply);
    if (reply.settled()) return;
    switch (executed) {
      case Executed::kDone:
        return reply.done();
      case Executed::kNoSuchOperation:
        return link.refuse(Code::kNoSuchOperation, message,
                           "'" + hosted.name + "' has no operation of this number");
      case Executed::kMalformed:
        return link.refuse(Code::kMalformed, message, what_is_malformed(parameters));
      case Executed::kBusy:
        return link.refuse(Code::kBusy, message, "'" + hosted.name + "' has too much to do");
    }
  } catch (const NotAllowed& refusal) {
    if (!reply.settled()) link.refuse(Code::kNotAllowed, message, refusal.what());
  } catch (const Malformed& refusal) {
    if (!reply.settled()) link.refuse(Code::kMalformed, message, refusal.what());
  } catch (const std::bad_alloc&) {
    if (!reply.settled()) link.refuse(Code::kBusy, message, "not enough memory for it");
  } catch (const std::exception& failure) {
    if (!reply.settled()) fail(link, message, hosted, operation, failure.what());
  }
}

/// Who has sent a command gets no answer: whoever listens to the component is told.
void NodeState::fail(Link& link, const Message& message, Hosted& hosted, Number operation,
                     std::string_view what) {
  if (message.header.type == Type::kRequest) return link.refuse(Code::kFailed, message, what);
  counters_.commands_failed.fetch_add(1, std::memory_order_relaxed);
  const Declaration* const declaration = find_declaration(hosted.service->interface(), operation);
  const Failed failed{
      std::string(declaration != nullptr ? operation_name(declaration->canonical) : "?"),
      std::string(what)};
  journal_.tell(rt::LogLevel::kWarning, "the command '{}' of '{}' failed: {}", failed.operation,
                hosted.name, failed.text);
  const auto members = std::tie(failed);
  ServiceAccess::publisher(*hosted.service)
      .publish(kFailedDeclaration.number(), Fields(members),
               {static_cast<std::uint8_t>(message.header.priority)});
}

/// What is no operation is refused as such, by who is to execute it.
std::optional<Refusal> NodeState::refusal_of_operation(const Link& link, const Hosted& hosted,
                                                       Number operation,
                                                       const std::string& identity) const {
  const Declaration* const declaration = find_declaration(hosted.service->interface(), operation);
  if (declaration == nullptr) return std::nullopt;
  const AccessQuestion question{link.scheme, identity, hosted.name, declaration->access};
  if (is_allowed(question)) return std::nullopt;
  return Refusal{Code::kNotAllowed, not_allowed(question)};
}

/// `operator@tls may not command 'Vision'`.
std::string NodeState::not_allowed(const AccessQuestion& question) const {
  return who(question) + " may not " + std::string(name_of(question.access)) + " '" +
         std::string(question.component) + "'";
}

bool NodeState::is_allowed(const AccessQuestion& question) const {
  return !options_.allows || options_.allows(question);
}

ComponentEntry NodeState::entry_of(const Hosted& hosted) const {
  return {static_cast<std::int32_t>(hosted.identifier), hosted.name,
          std::string(hosted.service->interface().name), hosted.digest};
}

void NodeState::execute_directory(Link& link, const Message& message, Number operation,
                                  std::uint32_t call, bool is_request, Decoder& parameters) {
  const auto answer = [&](const auto& result) {
    const auto fields = std::tie(result);
    if (!is_request) return;
    link.send({static_cast<std::uint8_t>(message.header.priority)}, Type::kReply, Recipient(call),
              {}, Fields(fields), Link::Flush::kNow);
  };
  const auto take = [&](auto&... values) {
    const bool taken = (parameters.take(values) && ...) && parameters.ended();
    if (!taken)
      link.refuse(Code::kMalformed, message, "the parameters do not fit the directory's operation");
    return taken;
  };
  std::int32_t component = 0;
  std::int32_t subscription = 0;
  Number event = 0;
  std::string name;
  switch (operation) {
    case kFind: {
      if (!take(name)) return;
      const auto found = std::ranges::find_if(hosted_, [&](const Hosted& hosted) {
        return hosted.service != nullptr && hosted.name == name;
      });
      return answer(found != hosted_.end() ? entry_of(*found) : ComponentEntry{});
    }
    case kList: {
      if (!take()) return;
      std::vector<ComponentEntry> all;
      for (const Hosted& hosted : hosted_) {
        if (hosted.service != nullptr) all.push_back(entry_of(hosted));
      }
      return answer(all);
    }
    case kSubscribe:
      if (!take(component, event, subscription)) return;
      return answer(subscribe(link, component, event, subscription));
    case kUnsubscribe:
      if (!take(subscription)) return;
      return answer(unsubscribe(link, subscription));
    default:
      link.refuse(Code::kNoSuchOperation, message, "the directory has no such operation");
  }
}

std::int32_t NodeState::subscribe(Link& link, std::int32_t component, Number event,
                                  std::int32_t subscription) {
  const auto refusal = [](Code code) { return static_cast<std::int32_t>(code); };
  const auto identifier = static_cast<std::uint32_t>(component);
  const auto chosen = static_cast<std::uint32_t>(subscription);
  Hosted* const hosted = find_hosted(identifier);
  if (hosted == nullptr) return refusal(Code::kNoSuchComponent);
  Publisher& publisher = ServiceAccess::publisher(*hosted->service);
  if (!publisher.has_event(event)) return refusal(Code::kNoSuchOperation);
  const std::string identity = link.identity();
  const AccessQuestion question{link.scheme, identity, hosted->name, Access::kRead};
  if (!is_allowed(question)) {
    return refuse_subscription(link, Code::kNotAllowed, not_allowed(question));
  }
  bool too_many = false;
  std::shared_ptr<EventQueue> queue;
  try {
    queue = std::make_shared<EventQueue>(link.shared_from_this(), link.memory, chosen, event,
                                         identifier, options_.limits.events_per_subscription);
  } catch (const std::bad_alloc&) {
    return refuse_subscription(link, Code::kBusy, "not enough memory for it");
  }
  {
    const std::lock_guard lock(link.mutex());
    // It may have gone with this message still here: nobody would ever end the subscription.
    if (!link.open()) return refusal(Code::kShuttingDown);
    const bool taken = std::ranges::any_of(
        link.event_queues, [&](const auto& other) { return other->subscription == chosen; });
    if (taken) return refusal(Code::kMalformed);
    const auto same = std::ranges::count_if(link.event_queues, [&](const auto& other) {
      return other->component == identifier && other->event == event;
    });
    too_many = static_cast<std::size_t>(same) >= options_.limits.subscriptions_to_an_event ||
               link.event_queues.size() >= options_.limits.subscriptions;
    if (!too_many) link.event_queues.push_back(queue);
  }
  if (too_many)
    return refuse_subscription(link, Code::kBusy, "it has reached its limit of subscriptions");
  publisher.add(std::move(queue));
  return 0;
}

std::int32_t NodeState::refuse_subscription(const Link& link, Code code, std::string_view why) {
  counters_.refusals.fetch_add(1, std::memory_order_relaxed);
  journal_.tell(rt::LogLevel::kWarning, "{} was refused a subscription: {} ({})", link.other_end(),
                name_of(code), why);
  return static_cast<std::int32_t>(code);
}

std::int32_t NodeState::unsubscribe(Link& link, std::int32_t subscription) {
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
  if (Hosted* const hosted = find_hosted(queue->component); hosted != nullptr) {
    ServiceAccess::publisher(*hosted->service).remove(link, chosen);
  }
  return 0;
}

}  // namespace armature::ride::internal
