// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/event_command.hpp"

#include <utility>

#include "armature/component/host.hpp"
#include "armature/types/elements.hpp"

namespace armature::exec {

using component::CommandStage;
using component::Outcome;
using component::Reason;

namespace {

/// nullptr: a constant, which was made as the parameter takes it.
const types::Type* offered_type(const CommandParameter& parameter,
                                const component::EventBase& event) {
  if (parameter.from == CommandParameter::From::kPort) return &parameter.port->type();
  if (parameter.from == CommandParameter::From::kConstant) return nullptr;
  return event.signature().arguments[parameter.member].type;
}

}  // namespace

EventCommand::EventCommand(std::string name, const component::EventBase& event,
                           const component::CommandBase& command,
                           std::vector<CommandParameter> parameters, base::Duration max_age)
    : Component(std::move(name)),
      on_(
          *this, kOn, "what commands", event,
          [](void* self, const void* const* members) {
            static_cast<EventCommand*>(self)->give(members);
          },
          this),
      do_(
          *this, kDo, "what is commanded", command, kMost,
          [](void* self, CommandStage stage, std::string_view reason) {
            static_cast<EventCommand*>(self)->ended(stage, reason);
          },
          this),
      parameters_(std::move(parameters)),
      max_age_(max_age),
      places_(parameters_.size()) {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const types::Type& wanted = *command.signature().arguments[i].type;
    const types::Type* const offered = offered_type(parameters_[i], event);
    const bool same = offered == nullptr || types::same_type(*offered, wanted);
    conversions_.push_back({same ? nullptr : offered, types::Value(wanted)});
  }
  for (const CommandParameter& parameter : parameters_) {
    auto& input = inputs_.emplace_back();
    if (parameter.from != CommandParameter::From::kPort) continue;
    input = std::make_unique<component::UntypedInputPort>(
        *this, parameter.input, "a parameter of the command", *parameter.port);
  }
}

Outcome EventCommand::on_start() {
  do_.resume();
  last_why_ = {};
  return component::accepted();
}

bool EventCommand::takes(const types::Type& parameter, const types::Type& offered) {
  const bool floating =
      parameter.kind == types::Kind::kFloat || parameter.kind == types::Kind::kDouble;
  return types::same_type(parameter, offered) || (floating && types::is_number(offered));
}

const void* EventCommand::as_taken(std::size_t index, const void* from) {
  auto& [type, value] = conversions_[index];
  if (type == nullptr) return from;
  types::convert_number(*type, from, value.type(), value.data());
  return value.data();
}

/// Vectors have their sizes by now.
Outcome EventCommand::on_activate() {
  std::vector<types::Value> members;
  for (const auto& argument : on_.signature().arguments) members.emplace_back(*argument.type);
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const CommandParameter& parameter = parameters_[i];
    switch (parameter.from) {
      case CommandParameter::From::kMember:
        places_[i] = as_taken(i, members[parameter.member].data());
        break;
      case CommandParameter::From::kPort:
        places_[i] = as_taken(i, inputs_[i]->current());
        break;
      case CommandParameter::From::kConstant:
        places_[i] = parameter.constant->data();
        break;
    }
  }
  do_.prepare(places_.data());
  return component::accepted();
}

/// More than any series of states needs, without time passing.
bool EventCommand::runs_in_circles() {
  constexpr std::size_t kLongestSeries = 256;
  given_then_ = given_at_ == time() ? given_then_ + 1 : 1;
  given_at_ = time();
  return given_then_ > kLongestSeries;
}

void EventCommand::give(const void* const* members) {
  if (runs_in_circles()) return fault("its event and its command set each other off without end");
  if (do_.rests()) return refuse("the application is about to stop");
  const Reason missing = collect(members);
  if (!missing.empty()) return refuse(missing);
  if (do_.send(places_.data()) != component::CallStatus::kPending) {
    return refuse("too many of its commands are under way");
  }
  given_.assign(given_ + 1);
}

void EventCommand::refuse(std::string_view reason) {
  refused_.assign(refused_ + 1);
  refusal_.why = reason;
  if (std::exchange(refusal_.on_its_way, true)) return;
  component::Host::context(*this).post(refusal_);
}

void EventCommand::Refusal::deliver(rt::Message& message) {
  auto& refusal = static_cast<Refusal&>(message);
  EventCommand& owner = refusal.owner;
  refusal.on_its_way = false;
  if (owner.state() != component::State::kRunning) return;
  component::Host::run_handler(owner, component::Host::context(owner),
                               [&] { owner.fail(refusal.why); });
}

Reason EventCommand::collect(const void* const* members) {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const CommandParameter& parameter = parameters_[i];
    if (parameter.from == CommandParameter::From::kMember) {
      places_[i] = as_taken(i, members[parameter.member]);
    }
    if (parameter.from != CommandParameter::From::kPort) continue;
    const auto read = inputs_[i]->read();
    Reason why(parameter.input);
    if (read.status < component::ReadStatus::kOld) return why.append(" was never written");
    if (max_age_ > base::Duration::zero() && time() - read.time > max_age_) {
      return why.append(" is too old");
    }
    places_[i] = as_taken(i, read.value);
  }
  return {};
}

void EventCommand::ended(CommandStage stage, std::string_view reason) {
  if (state() != component::State::kRunning) return;  // nobody waits for it any more
  if (stage == CommandStage::kDone) {
    last_why_ = {};
    done_.raise();
    return;
  }
  component::Attribute<std::int64_t>& counted =
      stage == CommandStage::kRefused ? refused_ : failures_;
  counted.assign(counted + 1);
  fail(reason);
}

void EventCommand::fail(std::string_view reason) {
  const Why why(reason);
  if (why.view() != last_why_.view()) log_warning("{}", reason);
  last_why_ = why;
  failed_.raise(why);
}

ComponentEntry event_command_entry(std::string name, const component::EventBase& event,
                                   const component::CommandBase& command,
                                   std::vector<CommandParameter> parameters, base::Duration max_age,
                                   const base::Location& event_where,
                                   const base::Location& command_where) {
  const std::string raiser = event.owner().name();
  const std::string server = command.owner().name();
  ComponentEntry entry;
  entry.component = std::make_unique<EventCommand>(std::move(name), event, command,
                                                   std::move(parameters), max_age);
  entry.model = "EventCommand";
  entry.peers = {{raiser, event_where}};
  if (server != raiser) entry.peers.push_back({server, command_where});
  entry.bindings = {
      {std::string(EventCommand::kOn), raiser, std::string(event.name()), event_where},
      {std::string(EventCommand::kDo), server, std::string(command.name()), command_where}};
  return entry;
}

}  // namespace armature::exec
