// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/dispatcher.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <tuple>
#include <utility>

#include "armature/ride/internal/node/serving.hpp"
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

/// The other end of a link, for an operation that asks what it may do to further components.
class SenderAt final : public Sender {
 public:
  SenderAt(const AccessControl& access, Link& link) : access_(access), link_(link) {}

  bool allows(std::string_view component, Access access) const override {
    return access_.allows({link_.scheme, link_.identity(), component, access});
  }
  std::string refusal(std::string_view component, Access access) const override {
    return not_allowed({link_.scheme, link_.identity(), component, access});
  }
  Origin origin() const override {
    const auto identity = link_.identity();
    const AccessQuestion question{link_.scheme, identity, {}, Access::kCommand};
    return {link_.weak_from_this(), link_.connection_number(), who(question)};
  }

 private:
  const AccessControl& access_;
  Link& link_;
};

}  // namespace

void Dispatcher::dispatch(Link& link, const Message& message) {
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

void Dispatcher::take_control(Link& link, const Message& message) {
  Decoder from(message.body);
  Control control;
  if (!from.take(control) || !from.ended()) {
    return link.refuse(Code::kMalformed, message, "the body is not that of a CONTROL message");
  }
  switch (control.code) {
    case Code::kHello:
      if (link.peer != nullptr) return link.peer->take_hello(control.text);
      if (!std::exchange(link.greeted, true)) {
        link.send_control(
            0, {Code::kHello, 0, 0, 0, core_.options.name + " armature/" ARMATURE_VERSION});
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
  core_.journal.tell(leaves ? rt::LogLevel::kInfo : rt::LogLevel::kWarning, "{} says: {} {}: {}",
                     link.other_end(), name_of(control.code),
                     static_cast<std::uint32_t>(control.code), control.text);
}

void Dispatcher::execute(Link& link, const Message& message, bool is_request) {
  Holding holding(link.memory);
  Decoder parameters(message.body, &holding);
  Call call{message, 0, 0, is_request};
  if (!parameters.take(call.operation) || (is_request && !parameters.take(call.call))) {
    return link.refuse(Code::kMalformed, message, "no operation in its body");
  }
  if (message.header.identifier == kDirectory) return directory_.execute(link, call, parameters);
  const Hosted* const hosted = services_.find(message.header.identifier);
  if (hosted == nullptr) {
    return link.refuse(Code::kNoSuchComponent, message, "no component has this identifier");
  }
  if (access_.asks()) {
    const auto refusal = refusal_of_operation(link, *hosted, call.operation, link.identity());
    if (refusal) return link.refuse(refusal->code, message, refusal->text);
  }
  if (is_request &&
      link.kept_replies.load(std::memory_order_relaxed) >= core_.options.limits.pending_replies) {
    return link.refuse(Code::kBusy, message, "too many requests wait for an answer");
  }
  run_service(link, *hosted, call, parameters, holding);
}

/// What a refusal would cost to gather first: nothing is kept for who may not, or asks what is not
/// there.
std::optional<Refusal> Dispatcher::refusal_of(const Link& link, const Message& first,
                                              const std::string& identity) const {
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
  const auto no_change = services_.hold_still();
  const Hosted* const hosted = services_.find(first.header.identifier);
  if (hosted == nullptr) {
    return Refusal{Code::kNoSuchComponent, "no component has this identifier"};
  }
  const Declaration* const declaration = find_declaration(hosted->interface(), operation);
  if (declaration == nullptr || declaration->is_event()) {
    return Refusal{Code::kNoSuchOperation,
                   "'" + hosted->name + "' has no operation of this number"};
  }
  return refusal_of_operation(link, *hosted, operation, identity);
}

void Dispatcher::run_service(Link& link, const Hosted& hosted, const Call& call,
                             Decoder& parameters, Holding& holding) {
  const Message& message = call.message;
  const Priority priority{static_cast<std::uint8_t>(message.header.priority)};
  const Serving serving(core_.options.serving, priority);
  const SenderAt sender(access_, link);
  Reply reply(call.is_request ? &link : nullptr, call.call, priority, call.operation,
              hosted.identifier, &sender, &holding, &parameters);
  try {
    const Executed executed =
        ServiceAccess::execute(*hosted.service, call.operation, parameters, reply);
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
    if (!reply.settled()) fail(link, hosted, call, failure.what());
  }
}

/// Who has sent a command gets no answer: whoever listens to the component is told.
void Dispatcher::fail(Link& link, const Hosted& hosted, const Call& call, std::string_view what) {
  const Message& message = call.message;
  if (call.is_request) return link.refuse(Code::kFailed, message, what);
  Counters::increase(core_.counters.commands_failed);
  const Declaration* const declaration = find_declaration(hosted.interface(), call.operation);
  const Failed failed{
      std::string(declaration != nullptr ? operation_name(declaration->canonical) : "?"),
      std::string(what)};
  core_.journal.tell(rt::LogLevel::kWarning, "the command '{}' of '{}' failed: {}",
                     failed.operation, hosted.name, failed.text);
  const auto members = std::tie(failed);
  hosted.publisher().publish(kFailedDeclaration.number(), Fields(members),
                             {static_cast<std::uint8_t>(message.header.priority)});
}

/// What is no operation is refused as such, by who is to execute it.
std::optional<Refusal> Dispatcher::refusal_of_operation(const Link& link, const Hosted& hosted,
                                                        Number operation,
                                                        const std::string& identity) const {
  const Declaration* const declaration = find_declaration(hosted.interface(), operation);
  if (declaration == nullptr) return std::nullopt;
  const AccessQuestion question{link.scheme, identity, hosted.name, declaration->access};
  if (access_.allows(question)) return std::nullopt;
  return Refusal{Code::kNotAllowed, not_allowed(question)};
}

}  // namespace armature::ride::internal
