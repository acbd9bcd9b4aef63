// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/placeholder.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <tuple>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/component/host.hpp"
#include "armature/remote/value_codec.hpp"
#include "armature/rt/guard.hpp"

namespace armature::remote {
namespace {

using component::CallStatus;

/// So much may wait for the component's thread; beyond, the oldest is dropped.
constexpr std::size_t kMostArrivals = 1024;

/// So long a start waits for the other process; then it goes on without it.
constexpr base::Duration kStartPatience = std::chrono::seconds(2);

CallStatus status_of(ride::Code code) {
  switch (code) {
    case ride::Code::kNone:
      return CallStatus::kDone;
    case ride::Code::kNotConnected:
    case ride::Code::kConnectionLost:
    case ride::Code::kNoSuchComponent:
    case ride::Code::kShuttingDown:
      return CallStatus::kUnreachable;
    case ride::Code::kDeadline:
      return CallStatus::kTimeout;
    default:
      return CallStatus::kFailed;
  }
}

}  // namespace

Placeholder::Placeholder(std::string name, Original original, const std::string& peer_address,
                         std::function<ride::Peer&()> where)
    : StandIn(std::move(name)),
      prototype_(std::move(original.prototype)),
      numbers_(std::move(original.numbers)),
      remote_name_(std::move(original.name)),
      where_(std::move(where)) {
  address.assign(peer_address);
  make_twins();
}

Placeholder::~Placeholder() { let_go(); }

void Placeholder::make_twins() {
  const component::Interface& original = component::interface_of(*prototype_);
  for (const NumberedMember& member : numbers_->members()) {
    switch (member.kind) {
      case NumberedMember::Kind::kOutput:
        outputs_.push_back({original.outputs[member.index]->twin(*this), member.index});
        break;
      case NumberedMember::Kind::kInput:
        inputs_.push_back({original.inputs[member.index]->twin(*this), member.index});
        break;
      case NumberedMember::Kind::kEvent:
        events_.push_back({original.events[member.index]->twin(*this), member.index});
        break;
      case NumberedMember::Kind::kOperation:
      case NumberedMember::Kind::kCommand:
        add_operation(*original.operations[member.index], member);
        break;
      case NumberedMember::Kind::kCancel:
      case NumberedMember::Kind::kProgress:
        break;
    }
  }
}

void Placeholder::add_operation(const component::OperationBase& original,
                                const NumberedMember& member) {
  Operation& added = operations_.emplace_back();
  added.twin = original.twin(*this);
  added.index = member.index;
  const bool lasts = numbers_->member(NumberedMember::Kind::kCancel, member.index) != nullptr ||
                     numbers_->member(NumberedMember::Kind::kProgress, member.index) != nullptr;
  if (member.kind != NumberedMember::Kind::kCommand || lasts) return;
  added.several = std::make_unique<component::CommandsUnderWay>(
      static_cast<const component::CommandBase&>(*added.twin));
}

// --- life cycle ----------------------------------------------------------------------------------

component::Outcome Placeholder::on_start() {
  const rt::PermitScope permit;
  ride::Peer& peer = where_();
  {
    const std::lock_guard lock(mailbox_->mutex);
    mailbox_->owner = this;
  }
  link_ = std::make_unique<LinkTo>(peer, remote_name_, numbers_->interface());
  subscribe();
  const base::Result<void> reached = peer.wait_until_connected(kStartPatience);
  mailbox_->put({.kind = Arrival::Kind::kConnection, .text = reached ? "" : reached.error()});
  return component::accepted();
}

/// To what somebody uses here: what nobody does costs nothing there.
void Placeholder::subscribe() {
  for (const Output& output : outputs_) {
    const bool used = !output.port->readers().empty() || output.port->is_tapped();
    if (used) listen(NumberedMember::Kind::kOutput, output.index, Arrival::Kind::kSample);
  }
  for (const Event& event : events_) {
    if (event.twin->subscribers().empty()) continue;
    listen(NumberedMember::Kind::kEvent, event.index, Arrival::Kind::kEvent);
  }
  for (const Operation& operation : operations_) {
    if (!operation.twin->is_command()) continue;
    listen(NumberedMember::Kind::kProgress, operation.index, Arrival::Kind::kProgress);
  }
  subscriptions_.push_back(where_().on_change([mailbox = mailbox_](const ride::PeerChange& change) {
    mailbox->put({.kind = Arrival::Kind::kConnection, .text = change.text});
  }));
}

void Placeholder::listen(NumberedMember::Kind kind, std::size_t index, Arrival::Kind arrives_as) {
  const ride::Number number = numbers_->number(kind, index);
  if (number == 0) return;  // not every command has progress
  subscriptions_.push_back(
      link_->subscribe(number, [this, kind, index, arrives_as](ride::Decoder& members) {
        Arrival arrival{.kind = arrives_as, .index = index};
        arrival.misfit = !take(kind, index, members, arrival);
        const bool fits = !arrival.misfit;
        mailbox_->put(std::move(arrival));
        return fits;
      }));
}

bool Placeholder::take(NumberedMember::Kind kind, std::size_t index, ride::Decoder& members,
                       Arrival& arrival) const {
  const auto take_value = [&](const types::Type& type) {
    types::Value value(type);
    Incoming place{&type, value.data()};
    if (!members.take(place)) return false;
    arrival.values.push_back(std::move(value));
    return true;
  };
  const component::Interface& original = component::interface_of(*prototype_);
  bool good = true;
  if (kind == NumberedMember::Kind::kProgress) {
    good = members.take(arrival.progress);
  } else if (kind == NumberedMember::Kind::kOutput) {
    std::int64_t time = 0;  // of a clock that is not this machine's
    good = members.take(arrival.sequence) && members.take(time) &&
           take_value(original.outputs[index]->type());
  } else {
    const auto& arguments = original.events[index]->signature().arguments;
    good = std::ranges::all_of(arguments,
                               [&](const auto& argument) { return take_value(*argument.type); });
  }
  const std::vector<ValueRange>& ranges = numbers_->member(kind, index)->ranges;
  return good && members.ended() && std::ranges::all_of(ranges, [&](const ValueRange& range) {
           return range.holds(arrival.values[range.argument].data());
         });
}

void Placeholder::on_stop() { let_go(); }
void Placeholder::on_cleanup() { let_go(); }

/// From now on nothing of the other process comes here any more.
void Placeholder::let_go() {
  const rt::PermitScope permit;
  {
    const std::lock_guard lock(mailbox_->mutex);
    mailbox_->owner = nullptr;
    mailbox_->arrivals.clear();
  }
  subscriptions_.clear();
  link_.reset();
  connected.assign(false);
}

// --- what comes from the other process -----------------------------------------------------------

void Placeholder::Mailbox::put(Arrival arrival) {
  const std::lock_guard lock(mutex);
  if (owner == nullptr) return;
  if (arrivals.size() >= kMostArrivals) {
    const auto replaceable = std::ranges::find_if(arrivals, [](const Arrival& waiting) {
      return waiting.kind == Arrival::Kind::kSample || waiting.kind == Arrival::Kind::kEvent;
    });
    if (replaceable != arrivals.end()) arrivals.erase(replaceable);
    ++overflowed;
  }
  arrivals.push_back(std::move(arrival));
  component::Host::context(*owner).raise(owner->bell_);
}

void Placeholder::Bell::deliver(rt::Message& message) {
  auto& bell = static_cast<Bell&>(message);
  bell.lower();
  component::Host::run_handler(bell.self, component::Host::context(bell.self),
                               [&bell] { bell.self.look_at_arrivals(); });
}

void Placeholder::look_at_arrivals() {
  const rt::PermitScope permit;
  std::vector<Arrival> taken;
  std::uint64_t overflowed = 0;
  {
    const std::lock_guard lock(mailbox_->mutex);
    taken.swap(mailbox_->arrivals);
    overflowed = std::exchange(mailbox_->overflowed, 0);
  }
  if (overflowed != 0) count(missed, overflowed);
  for (Arrival& arrival : taken) handle(arrival);
}

void Placeholder::handle(Arrival& arrival) {
  switch (arrival.kind) {
    case Arrival::Kind::kConnection:
      return handle_connection(arrival.text);
    case Arrival::Kind::kSample:
      return handle_sample(arrival);
    case Arrival::Kind::kEvent: {
      const auto event = std::ranges::find(events_, arrival.index, &Event::index);
      if (arrival.misfit) return note_misfit(event->misfit, event->twin->name());
      std::vector<const void*> places;
      for (const types::Value& value : arrival.values) places.push_back(value.data());
      event->twin->raise_from(places.data());
      return;
    }
    case Arrival::Kind::kProgress:
    case Arrival::Kind::kEnded: {
      const auto operation = std::ranges::find(operations_, arrival.index, &Operation::index);
      auto& command = static_cast<component::CommandBase&>(*operation->twin);
      if (arrival.misfit) return count(missed);
      if (arrival.kind == Arrival::Kind::kProgress) return command.report(arrival.progress);
      return handle_end(*operation, arrival);
    }
  }
}

/// Nothing happens if it was cancelled here.
void Placeholder::handle_end(Operation& operation, const Arrival& arrival) {
  using component::CommandStage;
  if (operation.several != nullptr) {
    const CommandStage stage = arrival.good ? CommandStage::kDone : CommandStage::kFailed;
    return operation.several->end(arrival.run, stage, arrival.text);
  }
  if (arrival.run != operation.run) return;
  auto& command = static_cast<component::CommandBase&>(*operation.twin);
  if (arrival.good) return command.complete();
  command.fail(arrival.text);
}

/// The same sample comes again when others subscribe to the port.
void Placeholder::handle_sample(const Arrival& arrival) {
  Output& output = *std::ranges::find(outputs_, arrival.index, &Output::index);
  if (arrival.misfit) return note_misfit(output.misfit, output.port->name());
  if (arrival.sequence == output.sequence) return;
  const bool goes_on = output.sequence != 0 && arrival.sequence > output.sequence;
  if (goes_on) count(missed, arrival.sequence - output.sequence - 1);
  output.sequence = arrival.sequence;
  const component::WriteStatus written = output.port->write_from(arrival.values.front().data());
  if (written != component::WriteStatus::kWrongSize) return;
  if (!std::exchange(output.misfit, true)) {
    log_error(
        "'{}' has another size at {}: set the properties that shape it to the same values here",
        output.port->name(), address.get());
  }
  count(missed);
}

/// A text that is too long, a number that no enumerator has or that is out of its range.
void Placeholder::note_misfit(bool& told, std::string_view member) {
  count(missed);
  if (std::exchange(told, true)) return;
  log_error("'{}' at {} sends '{}' with a value that has no place here; it is left out",
            remote_name_, address.get(), member);
}

void Placeholder::handle_connection(const std::string& text) {
  const bool was_connected = connected.get();
  const bool reachable = link_ != nullptr && link_->peer().connected();
  connected.assign(reachable && link_->found());
  if (connected.get()) {
    if (was_connected) return;
    log_info("'{}' at {} is there", remote_name_, address.get());
    if (state() == component::State::kRunTimeError) static_cast<void>(recover());
    found.raise();
    return;
  }
  const std::string problem = reachable ? "no component of this name has the interface '" +
                                              std::string(numbers_->interface().name) + "'"
                                        : text;
  log_warning("'{}' at {} cannot be used: {}", remote_name_, address.get(), problem);
  error("'" + remote_name_ + "' at " + address.get() + " cannot be used: " + problem);
  if (!was_connected) return;
  count(losses);
  for (Output& output : outputs_) {
    output.sequence = 0;  // another life of it counts anew
    for (component::InputPortBase* const reader : output.port->readers()) reader->tell_lost();
  }
  lost.raise();
}

// --- what goes there -----------------------------------------------------------------------------

void Placeholder::pass_on(component::InputPortBase& input, const void* value) {
  const rt::PermitScope permit;
  const std::size_t index =
      std::ranges::find(inputs_, &input, [](const Input& each) { return each.port.get(); })->index;
  const std::tuple members{Outgoing{&input.type(), value}};
  const NumberedMember& there = *numbers_->member(NumberedMember::Kind::kInput, index);
  const bool sent = link_ != nullptr && link_->send(there.number, there.priority,
                                                    ride::Fields(members)) == ride::Sent::kYes;
  if (!sent) count(unsent);
}

Placeholder::Operation& Placeholder::operation_of(const component::OperationBase& twin) {
  return *std::ranges::find(operations_, &twin,
                            [](const Operation& operation) { return operation.twin.get(); });
}

component::CallStatus Placeholder::call(component::OperationBase& operation,
                                        const void* const* arguments, void* result) {
  const rt::PermitScope permit;
  if (link_ == nullptr) return CallStatus::kUnreachable;
  const component::Signature& signature = operation.signature();
  const std::tuple members{OutgoingArguments{&signature, arguments}};
  Incoming place{signature.result, result};
  std::string problem;
  const NumberedMember& there =
      *numbers_->member(NumberedMember::Kind::kOperation, operation_of(operation).index);
  const ride::CallOptions options{base::from_seconds(answer_limit.get()), there.priority};
  const ride::Code code =
      link_->call(there.number, operation.name(), options, ride::Fields(members),
                  result == nullptr ? ride::Place() : ride::Place(place), problem);
  if (code != ride::Code::kNone) log_warning("{}", problem);
  return status_of(code);
}

component::CommandsUnderWay* Placeholder::several(const component::CommandBase& command) {
  return operation_of(command).several.get();
}

component::Outcome Placeholder::begin(component::CommandBase& command,
                                      const void* const* arguments) {
  const rt::PermitScope permit;
  if (link_ == nullptr || !connected.get()) {
    return component::refused("'" + remote_name_ + "' lives at " + address.get() +
                              ", in another process, which cannot be reached");
  }
  Operation& operation = operation_of(command);
  const std::uint64_t run = operation.several ? operation.several->newest() : ++operation.run;
  const std::tuple members{OutgoingArguments{&command.signature(), arguments}};
  const NumberedMember& there = *numbers_->member(NumberedMember::Kind::kCommand, operation.index);
  link_->ask(there.number, there.priority, ride::Fields(members),
             [mailbox = mailbox_, index = operation.index, run](ride::Code code,
                                                                std::string_view text, auto) {
               Arrival arrival{.kind = Arrival::Kind::kEnded, .index = index};
               arrival.run = run;
               arrival.good = code == ride::Code::kNone;
               arrival.text = text;
               mailbox->put(std::move(arrival));
             });
  return component::accepted();
}

void Placeholder::cancel(component::CommandBase& command) {
  const rt::PermitScope permit;
  Operation& operation = operation_of(command);
  ++operation.run;
  const auto* const there = numbers_->member(NumberedMember::Kind::kCancel, operation.index);
  if (link_ == nullptr || there == nullptr) return;
  const std::tuple<> nothing;
  const auto sent = link_->send(there->number, there->priority, ride::Fields(nothing));
  if (sent != ride::Sent::kYes) count(unsent);
}

void Placeholder::count(component::Attribute<int>& counter, std::uint64_t more) {
  if (more == 0) return;
  const std::uint64_t room = static_cast<std::uint64_t>(std::numeric_limits<int>::max()) -
                             static_cast<std::uint64_t>(counter.get());
  counter.assign(counter.get() + static_cast<int>(std::min(more, room)));
}

}  // namespace armature::remote
