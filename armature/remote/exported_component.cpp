// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/exported_component.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <tuple>
#include <utility>

#include "armature/component/interface.hpp"
#include "armature/platform/clock.hpp"
#include "armature/remote/value_codec.hpp"

namespace armature::remote {
namespace {

/// So little progress is not told.
constexpr double kLeastProgress = 0.01;

}  // namespace

ExportedComponent::ExportedComponent(const InterfaceNumbers& numbers,
                                     component::Component& component,
                                     exec::Application& application, ControlQueue& queue,
                                     WriteInput write, Tell tell)
    : Service(numbers.interface()),
      numbers_(numbers),
      component_(component),
      application_(application),
      queue_(queue),
      write_(std::move(write)),
      tell_(std::move(tell)) {
  const RunInThread run = [&application](component::Component& owner, std::function<void()> work) {
    return application.run_in_thread_of(owner, std::move(work));
  };
  const component::Interface& interface = component::interface_of(component);
  for (const NumberedMember& member : numbers.members()) {
    if (member.kind == NumberedMember::Kind::kEvent) {
      events_.emplace_back(
          new Event{member.number, member.index, EventFeed(*interface.events[member.index], run)});
    } else if (member.kind == NumberedMember::Kind::kOutput) {
      outputs_.emplace_back(
          new Output{member.number, member.index, PortFeed(*interface.outputs[member.index], run)});
    }
  }
}

ExportedComponent::~ExportedComponent() = default;

// --- what peers ask for, as it arrives -----------------------------------------------------------

std::vector<const types::Type*> ExportedComponent::parameters_of(
    const NumberedMember& member) const {
  std::vector<const types::Type*> types;
  const component::Interface& interface = component::interface_of(component_);
  if (member.kind == NumberedMember::Kind::kInput)
    types.push_back(&interface.inputs[member.index]->type());
  if (member.kind == NumberedMember::Kind::kOperation ||
      member.kind == NumberedMember::Kind::kCommand) {
    for (const auto& argument : interface.operations[member.index]->signature().arguments) {
      types.push_back(argument.type);
    }
  }
  return types;
}

ride::Executed ExportedComponent::execute(ride::Number number, ride::Decoder& parameters,
                                          ride::Reply& reply) {
  const NumberedMember* const member = numbers_.find(number);
  const bool is_event = member != nullptr && (member->kind == NumberedMember::Kind::kEvent ||
                                              member->kind == NumberedMember::Kind::kOutput ||
                                              member->kind == NumberedMember::Kind::kProgress);
  if (member == nullptr || is_event) return ride::Executed::kNoSuchOperation;
  const auto request = std::make_shared<Request>(Request{*member, {}, {}, reply.origin()});
  for (const types::Type* const type : parameters_of(*member)) {
    types::Value value(*type);
    Incoming place{type, value.data()};
    if (!parameters.take(place)) {
      throw ride::Malformed("parameter " + std::to_string(request->arguments.size() + 1) +
                            " is not of the type " + type->name);
    }
    request->arguments.push_back(std::move(value));
  }
  if (!parameters.ended()) return ride::Executed::kMalformed;
  if (!queue_.has_room()) return ride::Executed::kBusy;
  request->reply = reply.keep();
  // If it was closed meanwhile, the reply that is let go of is the answer.
  static_cast<void>(queue_.post([this, request] {
    try {
      perform(*request);
    } catch (const std::bad_alloc&) {
      request->reply.fail("not enough memory for it");
    }
  }));
  return ride::Executed::kDone;
}

// --- by the controlling thread -------------------------------------------------------------------

void ExportedComponent::perform(Request& request) {
  switch (request.member.kind) {
    case NumberedMember::Kind::kOperation:
      return call(request);
    case NumberedMember::Kind::kCommand:
      return begin(request);
    case NumberedMember::Kind::kInput:
      return write(request);
    case NumberedMember::Kind::kCancel:
      for (UnderWay& command : under_way_) {
        if (command.index == request.member.index) command.command.handle().cancel();
      }
      return request.reply.done();
    default:
      return;
  }
}

void ExportedComponent::call(Request& request) {
  const auto& operation = *component::interface_of(component_).operations[request.member.index];
  const auto answer = application_.call(component_.name(), operation.name(),
                                        std::move(request.arguments), exec::Caller::kRemote);
  if (!answer) return fail(request.reply, operation.name(), answer.error());
  const std::optional<types::Value>& result = answer.value();
  if (!result) return request.reply.done();
  request.reply.put(Outgoing{&result->type(), result->data()});
}

void ExportedComponent::begin(Request& request) {
  const auto& operation = *component::interface_of(component_).operations[request.member.index];
  if (request.origin.lost()) {
    return fail(request.reply, operation.name(), "the client that asked for it has gone");
  }
  auto begun = application_.begin(component_.name(), operation.name(), std::move(request.arguments),
                                  exec::Caller::kRemote);
  if (!begun) return fail(request.reply, operation.name(), begun.error());
  under_way_.push_back({request.member.index,
                        {std::move(begun).value(), std::move(request.origin)},
                        std::move(request.reply)});
}

void ExportedComponent::write(Request& request) {
  component::InputPortBase& input =
      *component::interface_of(component_).inputs[request.member.index];
  const base::Result<void> written = write_(input, request.arguments.front());
  if (written) return request.reply.done();
  fail(request.reply, input.name(), written.error());
}

/// Who has sent a command without asking for an answer is told by the event that says so.
void ExportedComponent::fail(ride::PendingReply& reply, std::string_view member,
                             std::string_view problem) {
  if (reply) return reply.fail(problem);
  const std::tuple failed{ride::Failed{std::string(member), std::string(problem)}};
  publish(ride::kFailedDeclaration.number(), ride::Fields(failed), {});
}

std::uint64_t ExportedComponent::serve() {
  if (const std::uint64_t changes = subscription_changes(); changes != changes_seen_) {
    changes_seen_ = changes;
    open_and_close_feeds();
  }
  if (!any_open_ && under_way_.empty()) return 0;  // most of an application's, most of the time
  follow_commands();
  std::uint64_t dropped = 0;
  for (const auto& event : events_) {
    if (!event->feed.attached()) continue;
    const component::Signature& signature =
        component::interface_of(component_).events[event->index]->signature();
    event->feed.take([&](const void* const* arguments) {
      const std::tuple members{OutgoingArguments{&signature, arguments}};
      publish(event->number, ride::Fields(members), {});
    });
    dropped += event->feed.take_dropped();
  }
  for (const auto& output : outputs_) {
    if (!output->feed.attached()) continue;
    const types::Type& type = component::interface_of(component_).outputs[output->index]->type();
    output->feed.take([&](const component::TappedSample& sample, const void* value) {
      publish_sample(output->number, sample.sequence, sample.time, type, value);
    });
    dropped += output->feed.take_dropped();
  }
  return dropped;
}

void ExportedComponent::publish_sample(ride::Number number, std::uint64_t sequence, base::Time time,
                                       const types::Type& type, const void* value) {
  const std::tuple members{sequence, static_cast<std::int64_t>(time.time_since_epoch().count()),
                           Outgoing{&type, value}};
  publish(number, ride::Fields(members), {});
}

/// Who comes to a port that was written before gets what it holds.
void ExportedComponent::open_and_close_feeds() {
  any_open_ = false;
  for (const auto& event : events_) {
    if (has_subscribers(event->number)) {
      event->feed.open();
      any_open_ = true;
    } else {
      event->feed.close();
    }
  }
  for (const auto& output : outputs_) {
    if (!has_subscribers(output->number)) {
      output->feed.close();
      continue;
    }
    output->feed.open();
    any_open_ = true;
    const PortFeed::Present* const present = output->feed.present();
    if (present == nullptr || present->sequence == 0) continue;
    publish_sample(output->number, present->sequence, present->time, present->value.type(),
                   present->value.data());
  }
}

void ExportedComponent::follow_commands() {
  const base::Time now = platform::monotonic_now();
  for (UnderWay& one : under_way_) {
    const auto& operation = *component::interface_of(component_).operations[one.index];
    one.command.cancel_if_lost(component_.name() + "." + std::string(operation.name()), now, tell_);
  }
  std::erase_if(under_way_, [this](UnderWay& command) { return follow(command); });
}

/// @return true if it has ended
bool ExportedComponent::follow(UnderWay& command) {
  const component::CommandHandle& handle = command.command.handle();
  if (!handle.ended()) {
    const double progress = handle.progress();
    if (std::abs(progress - command.told) >= kLeastProgress) {
      command.told = progress;
      publish(numbers_.number(NumberedMember::Kind::kProgress, command.index),
              ride::Fields(std::tuple(progress)), {});
    }
    return false;
  }
  const component::CommandStage stage = handle.stage();
  if (stage == component::CommandStage::kDone) {
    command.reply.done();
    return true;
  }
  std::string problem(component::name_of(stage));
  if (!handle.reason().empty()) problem += ": " + std::string(handle.reason());
  fail(command.reply, component::interface_of(component_).operations[command.index]->name(),
       problem);
  return true;
}

}  // namespace armature::remote
