// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/event_command.hpp"

#include <utility>

#include "armature/component/host.hpp"

namespace armature::exec {

using component::CommandStage;
using component::Outcome;
using component::Reason;

EventCommand::EventCommand(std::string name, const component::EventBase& event,
                           const component::CommandBase& command,
                           std::vector<component::CallParameter> parameters, base::Duration max_age)
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
      parameters_(*this, command.signature(), &on_.signature(), std::move(parameters)),
      max_age_(max_age) {}

Outcome EventCommand::on_start() {
  do_.resume();
  last_why_ = {};
  return component::accepted();
}

/// Vectors have their sizes by now.
Outcome EventCommand::on_activate() {
  parameters_.with_sample([this](const void* const* sample) { do_.prepare(sample); });
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
  const Reason missing = parameters_.collect(members, time(), max_age_);
  if (!missing.empty()) return refuse(missing);
  if (do_.send(parameters_.places()) != component::CallStatus::kPending) {
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
                                   std::vector<component::CallParameter> parameters,
                                   base::Duration max_age, const base::Location& event_where,
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
