// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/component/operation.hpp"

namespace armature::component {

/// Where a command is. Ordered: everything from kRefused on is an end.
enum class CommandStage : std::uint32_t {
  kFree,
  kQueued,
  kAccepted,  ///< under way
  kRefused,
  kDone,
  kFailed,
  kCancelled,
};

std::string_view name_of(CommandStage stage);

/// How a command fares; written by the component that executes it, read by whoever gave it.
class CommandTicket : public rt::Message, public SharedRecord {
 public:
  explicit CommandTicket(Deliver action) : rt::Message(action) {}

  CommandStage stage() const { return stage_.load(std::memory_order_acquire); }
  bool ended() const { return stage() >= CommandStage::kRefused; }
  /// 0..1 as the component reports it.
  double progress() const { return progress_.load(std::memory_order_relaxed); }
  /// Why it was refused, failed or was cancelled; empty until it ended.
  std::string_view reason() const { return ended() ? reason_.view() : std::string_view(); }
  bool cancel_requested() const { return cancel_.load(std::memory_order_acquire); }
  void request_cancel() {
    if (cancel_.exchange(true, std::memory_order_acq_rel)) return;
    share_once_more();
    executor().post(cancellation_);
  }

  bool try_claim() {
    if (!try_share()) return false;
    progress_.store(0.0, std::memory_order_relaxed);
    cancel_.store(false, std::memory_order_relaxed);
    stage_.store(CommandStage::kQueued, std::memory_order_relaxed);
    return true;
  }

  /// @thread the executing one
  void report(double progress) { progress_.store(progress, std::memory_order_relaxed); }
  void accept() { stage_.store(CommandStage::kAccepted, std::memory_order_release); }
  void end(CommandStage stage, std::string_view reason) {
    reason_ = reason;
    stage_.store(stage, std::memory_order_release);
    release();
  }

 protected:
  virtual ExecutionContext& executor() const = 0;
  /// Ends the command if it is under way for this ticket.
  virtual void cancel_now() = 0;

 private:
  /// Its sender wants the command to end, on the way to the executing thread.
  struct Cancellation final : rt::Message {
    explicit Cancellation(CommandTicket& command_ticket)
        : rt::Message(&deliver), ticket(command_ticket) {}
    static void deliver(rt::Message& message) {
      CommandTicket& ticket = static_cast<Cancellation&>(message).ticket;
      ticket.cancel_now();
      ticket.release();
    }
    CommandTicket& ticket;
  };

  std::atomic<CommandStage> stage_{CommandStage::kFree};
  std::atomic<double> progress_{0.0};
  std::atomic<bool> cancel_{false};
  Reason reason_;
  Cancellation cancellation_{*this};
};

/// Options of a command.
template <auto Predicate>
struct DoneWhen {};
/// `bool Predicate()`, asked after each update: true completes the command. A component that is not
/// updated calls `complete` instead.
template <auto Predicate>
inline constexpr DoneWhen<Predicate> done_when{};
template <auto Function>
struct CancelledBy {};
/// `void Function()`, told when the command is cancelled or its component stops.
template <auto Function>
inline constexpr CancelledBy<Function> cancelled_by{};

/// An operation that goes on after it was accepted: refused with a reason, or under way with
/// progress until it is done, failed or cancelled. One at a time; runs in its component's thread.
template <typename... Args>
class Command final : public OperationBase, public Step {
 public:
  /// `Function` is `Outcome f(Args...)`: accepts, or refuses with a reason and changes nothing.
  /// Options: done_when<&X::f>, cancelled_by<&X::f>, args(names...).
  template <auto Function, typename... Options>
  Command(Component* owner, std::string_view name, Serve<Function>, std::string_view doc,
          Options... options)
      : OperationBase(*owner,
                      std::make_unique<About>(name, doc, Signature::of<void, Args...>({}), true)),
        function_([](Component& component, Args... arguments) -> Outcome {
          using Owner = internal::OwnerOf<Function>;
          static_assert(std::is_invocable_r_v<Outcome, decltype(Function), Owner&, Args...>,
                        "a command is served by Outcome f(arguments of the command)");
          return (static_cast<Owner&>(component).*Function)(static_cast<Args>(arguments)...);
        }) {
    (apply(options), ...);
    owner->add_step(*this, false);
  }

  bool is_command() const override { return true; }
  bool active() const { return phase_ != Phase::kIdle; }

  /// For the component: how far it is (0..1), and its end.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void report(double progress) {
    if (ticket_ != nullptr) ticket_->report(progress);
  }
  void complete() { end(CommandStage::kDone, {}); }
  void fail(std::string_view reason) { end(CommandStage::kFailed, reason); }

  /// Begins the command; `ticket` is told how it fares, if there is one.
  Outcome begin(CommandTicket* ticket, Args... arguments) {
    Outcome outcome = accept_or_refuse(static_cast<Args>(arguments)...);
    if (ticket == nullptr) return outcome;
    if (!outcome) {
      ticket->end(CommandStage::kRefused, outcome.reason());
    } else if (phase_ == Phase::kUnderWay) {
      ticket_ = ticket;
      ticket->accept();
    } else {
      ticket->end(ended_early_, early_reason_);
    }
    return outcome;
  }

  /// Ends the command if it is the one that `ticket` began.
  void cancel(const CommandTicket& ticket) {
    if (ticket_ == &ticket) cancel("cancelled by its sender");
  }

  void step() override {
    if (phase_ == Phase::kUnderWay && done_ != nullptr && done_(owner())) complete();
  }
  void halt(std::string_view reason) override { cancel(reason); }

  base::Result<std::optional<types::Value>> invoke(
      const std::vector<types::Value>& arguments) override {
    if (std::string problem = mismatch(arguments); !problem.empty()) {
      return base::Error{std::move(problem)};
    }
    const Outcome outcome = begin_with(arguments, std::index_sequence_for<Args...>{});
    if (!outcome) return base::Error{std::string(outcome.reason())};
    return std::optional<types::Value>();
  }

 private:
  using OperationBase::apply;
  template <auto Predicate>
  void apply(DoneWhen<Predicate>) {
    done_ = [](Component& component) -> bool {
      using Owner = internal::OwnerOf<Predicate>;
      return (static_cast<Owner&>(component).*Predicate)();
    };
  }
  template <auto Function>
  void apply(CancelledBy<Function>) {
    cancelled_ = [](Component& component) {
      using Owner = internal::OwnerOf<Function>;
      (static_cast<Owner&>(component).*Function)();
    };
  }

  enum class Phase : std::uint8_t { kIdle, kBeginning, kUnderWay };

  Outcome accept_or_refuse(Args... arguments) {
    if (owner().state() != State::kRunning) return refused("the component is not running");
    if (active()) return refused("the command before is still under way");
    phase_ = Phase::kBeginning;
    Outcome outcome = accepted();
    const bool completed = owner().run(
        owner().context(), [&] { outcome = function_(owner(), static_cast<Args>(arguments)...); });
    if (completed && outcome.ok()) {
      if (phase_ == Phase::kBeginning) phase_ = Phase::kUnderWay;
      return outcome;
    }
    phase_ = Phase::kIdle;
    return completed ? outcome : refused(owner().reason());
  }

  template <std::size_t... I>
  Outcome begin_with([[maybe_unused]] const std::vector<types::Value>& arguments,
                     std::index_sequence<I...>) {
    return begin(nullptr, *static_cast<const std::decay_t<Args>*>(arguments[I].data())...);
  }

  void cancel(std::string_view reason) {
    if (phase_ != Phase::kUnderWay) {
      end(CommandStage::kCancelled, reason);
      return;
    }
    CommandTicket* const ticket = std::exchange(ticket_, nullptr);
    phase_ = Phase::kIdle;  // first: what the component does now may begin the next one
    if (cancelled_ != nullptr) owner().run(owner().context(), [this] { cancelled_(owner()); });
    if (ticket != nullptr) ticket->end(CommandStage::kCancelled, reason);
  }

  void end(CommandStage stage, std::string_view reason) {
    CommandTicket* const ticket = std::exchange(ticket_, nullptr);
    if (phase_ == Phase::kBeginning) {
      ended_early_ = stage;
      early_reason_ = reason;
    }
    phase_ = Phase::kIdle;
    if (ticket != nullptr) ticket->end(stage, reason);
  }

  Outcome (*function_)(Component&, Args...);
  bool (*done_)(Component&) = nullptr;
  void (*cancelled_)(Component&) = nullptr;
  Phase phase_ = Phase::kIdle;
  CommandStage ended_early_ = CommandStage::kDone;  ///< while it was begun
  Reason early_reason_;
  CommandTicket* ticket_ = nullptr;
};

/// A command that was sent; letting go of it does not cancel it.
class [[nodiscard]] CommandHandle {
 public:
  explicit CommandHandle(CallStatus refusal) : refusal_(refusal) {}
  explicit CommandHandle(CommandTicket& ticket) : ticket_(&ticket) {}
  CommandHandle(CommandHandle&& other) noexcept
      : ticket_(std::exchange(other.ticket_, nullptr)), refusal_(other.refusal_) {}
  CommandHandle& operator=(CommandHandle&& other) noexcept {
    std::swap(ticket_, other.ticket_);
    std::swap(refusal_, other.refusal_);
    return *this;
  }
  ~CommandHandle() {
    if (ticket_ != nullptr) ticket_->release();
  }

  /// False if it could not be sent: not connected, or too many under way.
  bool sent() const { return ticket_ != nullptr; }
  CallStatus send_status() const { return sent() ? CallStatus::kDone : refusal_; }
  CommandStage stage() const { return sent() ? ticket_->stage() : CommandStage::kRefused; }
  bool ended() const { return !sent() || ticket_->ended(); }
  double progress() const { return sent() ? ticket_->progress() : 0.0; }
  std::string_view reason() const {
    return sent() ? ticket_->reason() : component::name_of(refusal_);
  }
  /// Asks the component to end it; it is over when `stage` says so.
  void cancel() {
    if (sent()) ticket_->request_cancel();
  }

 private:
  CommandTicket* ticket_ = nullptr;
  CallStatus refusal_ = CallStatus::kPending;
};

/// A component's declared use of a command of one of its peers.
template <typename... Args>
class CommandCaller final : public OperationCallerBase {
 public:
  /// Options: from(property), optional, only_if(property), outstanding(n).
  template <typename... Options>
  CommandCaller(Component* owner, std::string_view name, std::string_view doc, Options... options)
      : OperationCallerBase(*owner,
                            std::make_unique<About>(name, doc, Signature::of<void, Args...>({}))) {
    (apply(options), ...);
  }

  bool needs_command() const override { return true; }

  /// Sends the command and returns at once.
  /// @rt nonblocking; allocates only to make room for larger vectors than ever sent
  /// @thread the component's own
  CommandHandle send(Args... arguments) {
    if (command_ == nullptr) return CommandHandle(CallStatus::kNotConnected);
    for (auto& ticket : tickets_) {
      if (!ticket->try_claim()) continue;
      ticket->arguments = std::tuple<const std::decay_t<Args>&...>(arguments...);
      command_->owner().context().post(*ticket);
      return CommandHandle(*ticket);
    }
    ++about().refused;
    return CommandHandle(CallStatus::kQueueFull);
  }

  void connect(OperationBase& base) override {
    command_ = static_cast<Command<Args...>*>(&base);
    about().target = &base;
    tickets_.clear();
    for (std::size_t i = 0; i < outstanding_; ++i) tickets_.emplace_back(new Ticket(*command_));
  }
  void disconnect() override {
    command_ = nullptr;
    about().target = nullptr;
    tickets_.clear();
  }

 private:
  struct Ticket final : CommandTicket {
    explicit Ticket(Command<Args...>& target) : CommandTicket(&Ticket::deliver), command(target) {}
    static void deliver(rt::Message& message) {
      auto& ticket = static_cast<Ticket&>(message);
      if (ticket.cancel_requested()) {
        ticket.end(CommandStage::kCancelled, "cancelled before it began");
        return;
      }
      static_cast<void>(std::apply(
          [&ticket](const std::decay_t<Args>&... given) {
            return ticket.command.begin(&ticket, given...);
          },
          ticket.arguments));
    }
    ExecutionContext& executor() const override { return command.owner().context(); }
    void cancel_now() override { command.cancel(*this); }
    Command<Args...>& command;
    std::tuple<std::decay_t<Args>...> arguments{};
  };

  using OperationCallerBase::apply;
  void apply(Outstanding option) { outstanding_ = option.count; }

  Command<Args...>* command_ = nullptr;
  std::size_t outstanding_ = kDefaultOutstanding;
  std::vector<std::unique_ptr<Ticket, SharedRecord::LetGo>> tickets_;
};

}  // namespace armature::component
