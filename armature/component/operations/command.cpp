// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operations/command.hpp"

#include <string>

#include "armature/component/black_box.hpp"
#include "armature/component/host.hpp"
#include "armature/component/internal/arguments.hpp"
#include "armature/component/lanes.hpp"
#include "armature/component/operations/command_ticket.hpp"
#include "armature/component/stand_in.hpp"

namespace armature::component {

namespace {

using Noted = BlackBox::Note::Kind;

Noted noted(CommandStage stage) {
  if (stage == CommandStage::kDone) return Noted::kDone;
  return stage == CommandStage::kFailed ? Noted::kFailed : Noted::kCancelled;
}

}  // namespace

std::string_view name_of(CommandStage stage) {
  switch (stage) {
    case CommandStage::kFree:
      return "free";
    case CommandStage::kQueued:
      return "queued";
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

Outcome CommandBase::begin_from(CommandTicket* ticket, const void* const* arguments) {
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
  if (ticket_ == &ticket) cancel("cancelled by its sender");
}

void CommandBase::step() {
  if (phase_ == Phase::kUnderWay && done_ != nullptr && done_(*this)) complete();
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
  Reason why(active() ? "the previous command is still under way" : "the component is not running");
  if (!active() && !owner().reason().empty()) why.append(": ").append(owner().reason());
  const Outcome refusal = refused(why);
  note(owner(), Noted::kRefused, name(), refusal.reason());
  if (ticket != nullptr) ticket->end(CommandStage::kRefused, refusal.reason());
  return refusal;
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
  if (phase_ != Phase::kUnderWay) {
    end(CommandStage::kCancelled, reason);
    return;
  }
  note(owner(), Noted::kCancelled, name(), reason);
  CommandTicket* const ticket = std::exchange(ticket_, nullptr);
  phase_ = Phase::kIdle;  // first: what the component does now may begin the next one
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

/// Of a command that a component sends; it carries the arguments there.
class CommandCallerBase::SentTicket final : public CommandTicket {
 public:
  explicit SentTicket(CommandBase& command)
      : CommandTicket(&SentTicket::deliver), command_(command), arguments_(command.signature()) {}

  void set_arguments(const void* const* arguments) { arguments_.assign(arguments); }

 private:
  static void deliver(rt::Message& message) {
    auto& ticket = static_cast<SentTicket&>(message);
    if (ticket.cancel_requested()) {
      ticket.end(CommandStage::kCancelled, "cancelled before it began");
      return;
    }
    static_cast<void>(ticket.command_.begin_from(&ticket, ticket.arguments_.places()));
  }
  ExecutionContext& executor() const override { return Host::context(command_.owner()); }
  void cancel_now() override { command_.cancel(*this); }

  CommandBase& command_;
  internal::Arguments arguments_;
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
