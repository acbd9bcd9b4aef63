// SPDX-License-Identifier: Apache-2.0
#include "armature/component/command.hpp"

#include "armature/component/black_box.hpp"

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

CommandBase::CommandBase(Component& owner, std::unique_ptr<About> about) noexcept
    : OperationBase(owner, std::move(about)) {
  owner.add_step(*this, false);
}

/// Components that are stopped have no command under way; of one that was not, nobody hears again.
CommandBase::~CommandBase() { end(CommandStage::kCancelled, "its component is gone"); }

base::Result<std::optional<types::Value>> CommandBase::invoke(
    const std::vector<types::Value>& arguments) {
  const base::Result<void> begun = begin_with(nullptr, arguments);
  if (!begun) return base::Error{begun.error()};
  return std::optional<types::Value>();
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

void CommandBase::mark_twin(CommandBase& twin) const {
  OperationBase::mark_twin(twin);
  twin.cancelled_ = [](CommandBase& command) {
    static_cast<StandIn&>(command.owner()).cancel(command);
  };
}

Outcome CommandBase::admit(CommandTicket* ticket) {
  const bool running = owner().state() == State::kRunning;
  if ((running || about().any_state) && !active()) {
    note(owner(), Noted::kBegun, name(), {});
    phase_ = Phase::kBeginning;
    return accepted();
  }
  Reason why(active() ? "the command before is still under way" : "the component is not running");
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
  if (cancelled_ != nullptr) owner().run(owner().context(), [this] { cancelled_(*this); });
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

}  // namespace armature::component
