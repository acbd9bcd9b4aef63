// SPDX-License-Identifier: Apache-2.0
#pragma once

// How a command fares, between who executes it and who gave it: for who gives commands to
// components without being one.

#include <atomic>
#include <string_view>

#include "armature/component/operations/call_record.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/component/outcome.hpp"
#include "armature/rt/inbox.hpp"

namespace armature::component {

/// What the thread that executes a command and its sender tell each other.
///
/// Specification: whoever sees that the command ended sees the reason; of several wishes to cancel
/// it one is told to the executing thread, for which the record is shared until then.
template <typename Text, typename Atomics>
class BasicCommandState : public BasicSharedRecord<Atomics> {
 public:
  CommandStage stage() const { return stage_.load(std::memory_order_acquire); }
  bool ended() const { return stage() >= CommandStage::kRefused; }
  /// 0..1 as the component reports it.
  double progress() const { return progress_.load(std::memory_order_relaxed); }
  /// Why it was refused, failed or was cancelled; of a command that ended.
  const Text& given_reason() const { return reason_; }
  bool cancel_requested() const { return cancel_.load(std::memory_order_acquire); }

  /// @thread the sender's
  bool try_claim() {
    if (!this->try_share()) return false;
    progress_.store(0.0, std::memory_order_relaxed);
    cancel_.store(false, std::memory_order_relaxed);
    stage_.store(CommandStage::kQueued, std::memory_order_relaxed);
    return true;
  }
  /// True if the executing thread is to be told, which releases the record afterwards.
  bool want_cancel() {
    if (cancel_.exchange(true, std::memory_order_acq_rel)) return false;
    this->share_once_more();
    return true;
  }

  /// @thread the executing one
  void report(double progress) { progress_.store(progress, std::memory_order_relaxed); }
  void wait_its_turn() { stage_.store(CommandStage::kWaiting, std::memory_order_release); }
  void accept() { stage_.store(CommandStage::kAccepted, std::memory_order_release); }
  template <typename Given>
  void end(CommandStage stage, const Given& reason) {
    reason_ = reason;
    stage_.store(stage, std::memory_order_release);
    this->release();
  }

 private:
  typename Atomics::template Atomic<CommandStage> stage_{CommandStage::kFree};
  typename Atomics::template Atomic<double> progress_{0.0};
  typename Atomics::template Atomic<bool> cancel_{false};
  Text reason_{};
};

/// How a command fares; written by the component that executes it, read by whoever gave it.
class CommandTicket : public rt::Message, public BasicCommandState<Reason, rt::StdAtomics> {
 public:
  explicit CommandTicket(Deliver action) : rt::Message(action) {}

  /// Why it was refused, failed or was cancelled; empty until it ended.
  std::string_view reason() const { return ended() ? given_reason().view() : std::string_view(); }
  void request_cancel();
  /// The command ends so.
  /// @thread the executing one
  void end(CommandStage stage, const Reason& reason) {
    ending(stage, reason);
    BasicCommandState::end(stage, reason);
  }

 protected:
  /// For a sender that wants to be told; what it tells him on may share the record once more.
  /// @thread the executing one
  virtual void ending(CommandStage /*stage*/, const Reason& /*reason*/) {}
  virtual ExecutionContext& executor() const = 0;
  /// Ends the command if it is under way, or waits, for this ticket.
  virtual void cancel_now() = 0;

 private:
  /// Its sender wants the command to end, on the way to the executing thread.
  struct Cancellation final : rt::Message {
    explicit Cancellation(CommandTicket& command_ticket)
        : rt::Message(&deliver), ticket(command_ticket) {}
    static void deliver(rt::Message& message);
    CommandTicket& ticket;
  };

  Cancellation cancellation_{*this};
};

}  // namespace armature::component
