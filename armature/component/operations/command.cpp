// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operations/command.hpp"

#include <charconv>
#include <string>

#include "armature/component/black_box.hpp"
#include "armature/component/host.hpp"
#include "armature/component/internal/sent_command.hpp"
#include "armature/component/internal/waiting_commands.hpp"
#include "armature/component/lanes.hpp"
#include "armature/component/operations/command_ticket.hpp"
#include "armature/component/operations/commands_under_way.hpp"
#include "armature/component/stand_in.hpp"

namespace armature::component {

namespace {

using Noted = BlackBox::Note::Kind;

Noted noted(CommandStage stage) {
  if (stage == CommandStage::kDone) return Noted::kDone;
  return stage == CommandStage::kFailed ? Noted::kFailed : Noted::kCancelled;
}

/// Where those of a twin are of which several may be under way; nullptr: one at a time.
CommandsUnderWay* several_of(const CommandBase& command) {
  if (!command.is_elsewhere()) return nullptr;
  return static_cast<StandIn&>(command.owner()).several(command);
}

/// Why a component that does not run begins none.
Outcome not_running(const Component& owner) {
  Reason why("the component is not running");
  if (!owner.reason().empty()) why.append(": ").append(owner.reason());
  return refused(why);
}

Outcome no_more_than_the_most() {
  char number[20];
  const char* const end =
      std::to_chars(number, number + sizeof number, CommandsUnderWay::kMost).ptr;
  Reason why;
  why.append({number, end});
  return refused(why.append(" of it are under way in another process, which is the most"));
}

Outcome refuse(const CommandBase& command, CommandTicket* ticket, const Outcome& refusal) {
  note(command.owner(), Noted::kRefused, command.name(), refusal.reason());
  if (ticket != nullptr) ticket->end(CommandStage::kRefused, refusal.reason());
  return refusal;
}

/// Has the stand-in begin one, whatever others are under way.
Outcome begin_another(CommandBase& command, CommandsUnderWay& all, CommandTicket* ticket,
                      const void* const* arguments) {
  Component& owner = command.owner();
  if (owner.state() != State::kRunning) return refuse(command, ticket, not_running(owner));
  if (all.full()) return refuse(command, ticket, no_more_than_the_most());
  note(owner, Noted::kBegun, command.name(), {});
  all.add(ticket);
  const std::uint64_t run = all.newest();
  Outcome outcome = accepted();
  const bool completed = Host::run(owner, Host::context(owner), [&] {
    outcome = static_cast<StandIn&>(owner).begin(command, arguments);
  });
  if (!completed) outcome = refused(owner.reason());
  if (!outcome) all.end(run, CommandStage::kRefused, outcome.reason());
  if (ticket != nullptr && all.has(run)) ticket->accept();
  return outcome;
}

}  // namespace

std::string_view name_of(CommandStage stage) {
  switch (stage) {
    case CommandStage::kFree:
      return "free";
    case CommandStage::kQueued:
      return "queued";
    case CommandStage::kWaiting:
      return "waiting";
    case CommandStage::kAccepted:
      return "under way";
    case CommandStage::kRefused:
      return "refused";
    case CommandStage::kDone:
      return "done";
    case CommandStage::kFailed:
      return "failed";
    case CommandStage::kCancelled:
      return "cancelled";
  }
  return "unknown";
}

void CommandTicket::request_cancel() {
  if (!ended() && want_cancel()) executor().post(cancellation_);
}

void CommandTicket::Cancellation::deliver(rt::Message& message) {
  CommandTicket& ticket = static_cast<Cancellation&>(message).ticket;
  ticket.cancel_now();
  ticket.release();
}

CommandBase::CommandBase(Component& owner, std::string_view name, std::string_view doc,
                         Signature signature, Begin begin) noexcept
    : OperationBase(owner, name, doc, std::move(signature), nullptr), begin_(begin) {
  apply(in_own_thread);
  Host::add_step(owner, *this, false);
}

/// Components that are stopped have no command under way; of one that was not, nobody hears again.
CommandBase::~CommandBase() { end(CommandStage::kCancelled, "its component has been destroyed"); }

base::Result<std::optional<types::Value>> CommandBase::invoke(
    const std::vector<types::Value>& arguments) {
  const base::Result<void> begun = begin_with(nullptr, arguments);
  if (!begun) return base::Error{begun.error()};
  return std::optional<types::Value>();
}

base::Result<void> CommandBase::begin_with(CommandTicket* ticket,
                                           const std::vector<types::Value>& arguments) {
  if (std::string problem = mismatch(arguments); !problem.empty()) {
    if (ticket != nullptr) ticket->end(CommandStage::kRefused, problem);
    return base::Error{std::move(problem)};
  }
  std::vector<const void*> places;
  for (const types::Value& argument : arguments) places.push_back(argument.data());
  const Outcome outcome = begin_from(ticket, places.data());
  if (!outcome) return base::Error{std::string(outcome.reason())};
  return {};
}

void CommandBase::let_wait(std::size_t capacity, Begin check) {
  waiting_ = std::make_unique<internal::WaitingCommands>(signature(), capacity);
  may_wait_ = check;
}

void CommandBase::prepare_from(const void* const* arguments) {
  if (waiting_ != nullptr) waiting_->shape(arguments);
}

std::size_t CommandBase::waiting() const { return waiting_ == nullptr ? 0 : waiting_->size(); }

Outcome CommandBase::begin_from(CommandTicket* ticket, const void* const* arguments) {
  if (CommandsUnderWay* const all = several_of(*this)) {
    return begin_another(*this, *all, ticket, arguments);
  }
  return has_to_wait() ? wait(ticket, arguments) : begin_now(ticket, arguments);
}

Outcome CommandBase::begin_now(CommandTicket* ticket, const void* const* arguments) {
  Outcome outcome = admit(ticket);
  if (!outcome) return outcome;
  const bool completed =
      Host::run(owner(), Host::context(owner()), [&] { outcome = begin_(*this, arguments); });
  return begun(ticket, completed, outcome);
}

void CommandBase::report(double progress) {
  if (ticket_ != nullptr) ticket_->report(progress);
}

void CommandBase::cancel(const CommandTicket& ticket) {
  constexpr std::string_view kReason = "cancelled by its sender";
  if (CommandsUnderWay* const all = several_of(*this)) {
    return all->end(ticket, CommandStage::kCancelled, kReason);
  }
  if (ticket_ == &ticket) return cancel(kReason);
  const std::size_t place = waiting_ == nullptr ? 0 : waiting_->find(ticket);
  if (place == waiting()) return;
  drop_waiting(place + 1, kReason);
  CommandTicket* const cancelled = waiting_->take_last().ticket;
  note(owner(), Noted::kCancelled, name(), kReason);
  cancelled->end(CommandStage::kCancelled, kReason);
}

void CommandBase::step() {
  if (phase_ == Phase::kUnderWay && done_ != nullptr && done_(*this)) complete();
  if (phase_ == Phase::kIdle && waiting() > 0) begin_next();
}

// --- waiting -------------------------------------------------------------------------------------

bool CommandBase::has_to_wait() const {
  return waiting_ != nullptr && (active() || !waiting_->empty());
}

Outcome CommandBase::wait(CommandTicket* ticket, const void* const* arguments) {
  const Outcome answer = may_wait_now(arguments);
  if (!answer) return refuse(*this, ticket, answer);
  waiting_->add(ticket, arguments);
  if (ticket != nullptr) ticket->wait_its_turn();
  return answer;
}

Outcome CommandBase::may_wait_now(const void* const* arguments) {
  if (waiting_->full()) {
    char number[20];
    const char* const end = std::to_chars(number, number + sizeof number, waiting()).ptr;
    Reason why("one command is under way and ");
    why.append({number, end}).append(waiting() == 1 ? " waits" : " wait");
    return refused(why.append(", which is the most: wait until one is done"));
  }
  Outcome answer = accepted();
  const bool completed =
      Host::run(owner(), Host::context(owner()), [&] { answer = may_wait_(*this, arguments); });
  return completed ? answer : refused(owner().reason());
}

/// The one before it is done. Those behind one that refuses were meant to begin where it ends.
void CommandBase::begin_next() {
  const internal::WaitingCommands::Command next = waiting_->take_first();
  const Outcome answer = begin_now(next.ticket, next.arguments);
  if (answer) return;
  owner().log_warning("{}: refused when its turn came: {}", name(), answer.reason());
  drop_waiting(0, answer.reason());
}

void CommandBase::drop_waiting(std::size_t remaining, std::string_view reason) {
  if (waiting() <= remaining) return;
  Reason why("it waited for a command that was not done: ");
  why.append(reason);
  while (waiting() > remaining) {
    CommandTicket* const dropped = waiting_->take_last().ticket;
    note(owner(), Noted::kCancelled, name(), why);
    if (dropped != nullptr) dropped->end(CommandStage::kCancelled, why);
  }
}

/// What stands for a command of a component that lives elsewhere.
class CommandBase::Twin final : public CommandBase {
 public:
  Twin(Component& owner, const CommandBase& original)
      : CommandBase(owner, original.name(), original.doc(), original.signature(),
                    [](CommandBase& command, const void* const* arguments) {
                      return static_cast<StandIn&>(command.owner()).begin(command, arguments);
                    }) {
    cancelled_ = [](CommandBase& command) {
      static_cast<StandIn&>(command.owner()).cancel(command);
    };
  }
};

std::unique_ptr<OperationBase> CommandBase::make_twin(Component& owner) const {
  return std::make_unique<Twin>(owner, *this);
}

Outcome CommandBase::admit(CommandTicket* ticket) {
  const bool running = owner().state() == State::kRunning;
  if ((running || serves_in_any_state()) && !active()) {
    note(owner(), Noted::kBegun, name(), {});
    phase_ = Phase::kBeginning;
    return accepted();
  }
  if (!active()) return refuse(*this, ticket, not_running(owner()));
  Reason why("the previous command is still under way, and this command does not queue");
  if (is_elsewhere()) why.append(" from another process");
  return refuse(*this, ticket, refused(why));
}

Outcome CommandBase::begun(CommandTicket* ticket, bool completed, const Outcome& outcome) {
  const Outcome answer = completed ? outcome : refused(owner().reason());
  if (!answer) note(owner(), Noted::kRefused, name(), answer.reason());
  if (!answer) {
    phase_ = Phase::kIdle;
  } else if (phase_ == Phase::kBeginning) {
    phase_ = Phase::kUnderWay;
  }
  if (ticket == nullptr) return answer;
  if (!answer) {
    ticket->end(CommandStage::kRefused, answer.reason());
  } else if (phase_ == Phase::kUnderWay) {
    ticket_ = ticket;
    ticket->accept();
  } else {
    ticket->end(ended_early_, early_reason_);
  }
  return answer;
}

void CommandBase::cancel(std::string_view reason) {
  if (CommandsUnderWay* const all = several_of(*this)) {
    return all->end_all(CommandStage::kCancelled, reason);
  }
  if (phase_ != Phase::kUnderWay) {
    end(CommandStage::kCancelled, reason);
    return;
  }
  note(owner(), Noted::kCancelled, name(), reason);
  CommandTicket* const ticket = std::exchange(ticket_, nullptr);
  phase_ = Phase::kIdle;  // first: what the component does now may begin the next one
  drop_waiting(0, reason);
  if (cancelled_ != nullptr)
    Host::run(owner(), Host::context(owner()), [this] { cancelled_(*this); });
  if (ticket != nullptr) ticket->end(CommandStage::kCancelled, reason);
}

void CommandBase::end(CommandStage stage, std::string_view reason) {
  CommandTicket* const ticket = std::exchange(ticket_, nullptr);
  if (phase_ == Phase::kBeginning) {
    ended_early_ = stage;
    early_reason_ = reason;
  }
  if (active()) note(owner(), noted(stage), name(), reason);
  phase_ = Phase::kIdle;
  if (stage != CommandStage::kDone) drop_waiting(0, reason);
  if (ticket != nullptr) ticket->end(stage, reason);
}

CommandHandle::~CommandHandle() {
  if (ticket_ != nullptr) ticket_->release();
}

CommandStage CommandHandle::stage() const {
  return sent() ? ticket_->stage() : CommandStage::kRefused;
}

bool CommandHandle::ended() const { return !sent() || ticket_->ended(); }

double CommandHandle::progress() const { return sent() ? ticket_->progress() : 0.0; }

std::string_view CommandHandle::reason() const {
  return sent() ? ticket_->reason() : component::name_of(refusal_);
}

void CommandHandle::cancel() {
  if (sent()) ticket_->request_cancel();
}

class CommandCallerBase::SentTicket final : public internal::SentCommand {
 public:
  using SentCommand::SentCommand;
};

void CommandCallerBase::LetGo::operator()(SentTicket* ticket) const { ticket->release(); }

CommandCallerBase::CommandCallerBase(Component& owner, std::string_view name, std::string_view doc,
                                     Signature signature) noexcept
    : OperationCallerBase(owner, name, doc, std::move(signature)) {}

CommandCallerBase::~CommandCallerBase() = default;

void CommandCallerBase::connect(OperationBase& command) {
  operation_ = &command;
  tickets_.clear();
  for (std::size_t i = 0; i < outstanding(); ++i) {
    tickets_.emplace_back(new SentTicket(static_cast<CommandBase&>(command)));
  }
}

void CommandCallerBase::disconnect() {
  operation_ = nullptr;
  tickets_.clear();
}

CommandHandle CommandCallerBase::send_from(const void* const* arguments) {
  if (operation_ == nullptr) return CommandHandle(CallStatus::kNotConnected);
  for (auto& ticket : tickets_) {
    if (!ticket->try_claim()) continue;
    ticket->set_arguments(arguments);
    Host::context(operation_->owner()).post(*ticket);
    return CommandHandle(*ticket);
  }
  count_refused();
  return CommandHandle(CallStatus::kQueueFull);
}

}  // namespace armature::component
