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

 protected:
  virtual ExecutionContext& executor() const = 0;
  /// Ends the command if it is under way for this ticket.
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

/// Options of a command.
template <auto Predicate>
struct DoneWhen {};
/// `bool Predicate()`, asked after each update: true completes the command. A component that is not
/// updated calls `complete` instead.
template <auto Predicate>
inline constexpr DoneWhen<Predicate> done_when{};
/// Option of a command.
template <auto Function>
struct CancelledBy {};
/// `void Function()`, told when the command is cancelled or its component stops.
template <auto Function>
inline constexpr CancelledBy<Function> cancelled_by{};

/// What tools know of a command, and how it goes on after it was accepted.
class CommandBase : public OperationBase, public Step {
 public:
  ~CommandBase() override;

  bool is_command() const final { return true; }
  bool active() const { return phase_ != Phase::kIdle; }

  base::Result<std::optional<types::Value>> invoke(
      const std::vector<types::Value>& arguments) final;
  /// The same for a tool that follows the command: `ticket` is told how it fares, also of a
  /// refusal.
  /// @thread the component's own
  virtual base::Result<void> begin_with(CommandTicket* ticket,
                                        const std::vector<types::Value>& arguments) = 0;

  /// For the component: how far it is (0..1), and its end.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void report(double progress);
  void complete() { end(CommandStage::kDone, {}); }
  void fail(std::string_view reason) { end(CommandStage::kFailed, reason); }

  /// Ends the command if it is the one that `ticket` began.
  void cancel(const CommandTicket& ticket);

  void step() final;
  void halt(std::string_view reason) final { cancel(reason); }

 protected:
  /// How the command stands. While `kBeginning`, its function decides whether to accept it.
  enum class Phase : std::uint8_t { kIdle, kBeginning, kUnderWay };

  CommandBase(Component& owner, std::unique_ptr<About> about) noexcept;

  using OperationBase::apply;
  template <auto Predicate>
  void apply(DoneWhen<Predicate>) noexcept {
    done_ = [](CommandBase& command) -> bool {
      using Owner = internal::OwnerOf<Predicate>;
      return (static_cast<Owner&>(command.owner()).*Predicate)();
    };
  }
  template <auto Function>
  void apply(CancelledBy<Function>) noexcept {
    cancelled_ = [](CommandBase& command) {
      using Owner = internal::OwnerOf<Function>;
      (static_cast<Owner&>(command.owner()).*Function)();
    };
  }

  /// `twin` is one of this command.
  void mark_twin(CommandBase& twin) const;

  /// Begins, or refuses because it cannot now; `ticket` is told of a refusal, if there is one.
  Outcome admit(CommandTicket* ticket);
  /// Goes on after the component was asked, and tells `ticket`, if there is one.
  /// @param completed  no exception escaped
  /// @param outcome    what the component said
  Outcome begun(CommandTicket* ticket, bool completed, const Outcome& outcome);

 private:
  void cancel(std::string_view reason);
  void end(CommandStage stage, std::string_view reason);

  bool (*done_)(CommandBase&) = nullptr;
  void (*cancelled_)(CommandBase&) = nullptr;
  Phase phase_ = Phase::kIdle;
  CommandStage ended_early_ = CommandStage::kDone;  ///< while it was begun
  Reason early_reason_;
  CommandTicket* ticket_ = nullptr;
};

/// An operation that goes on after it was accepted: refused with a reason, or under way with
/// progress until it is done, failed or cancelled. One at a time; runs in its component's thread.
template <typename... Args>
class Command final : public CommandBase {
 public:
  /// `Function` is `Outcome f(Args...)`: accepts, or refuses with a reason and changes nothing.
  /// Options: done_when<&X::f>, cancelled_by<&X::f>, by_operator, in_any_state, args(names...).
  template <auto Function, typename... Options>
  Command(Component* owner, std::string_view name, Serve<Function>, std::string_view doc,
          Options... options) noexcept
      : Command(*owner, name, doc, [](Command& command, Args... arguments) -> Outcome {
          using Owner = internal::OwnerOf<Function>;
          static_assert(std::is_invocable_r_v<Outcome, decltype(Function), Owner&, Args...>,
                        "a command is served by Outcome f(arguments of the command)");
          auto& component = static_cast<Owner&>(command.owner());
          return (component.*Function)(static_cast<Args>(arguments)...);
        }) {
    (apply(options), ...);
  }
  ~Command() override;

  /// Begins the command; `ticket` is told how it fares, if there is one.
  Outcome begin(CommandTicket* ticket, Args... arguments);

  base::Result<void> begin_with(CommandTicket* ticket,
                                const std::vector<types::Value>& arguments) override;

  std::unique_ptr<OperationBase> twin(StandIn& owner) const override;

 private:
  using Function = Outcome (*)(Command&, Args...);

  Command(Component& owner, std::string_view name, std::string_view doc,
          Function function) noexcept;
  template <std::size_t... I>
  Outcome begin_with(CommandTicket* ticket, const std::vector<types::Value>& arguments,
                     std::index_sequence<I...>);

  Function function_;
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
  CommandCaller(Component* owner, std::string_view name, std::string_view doc,
                Options... options) noexcept
      : CommandCaller(*owner, name, doc) {
    (apply(options), ...);
  }
  ~CommandCaller() override;

  bool needs_command() const override { return true; }

  /// Sends the command and returns at once.
  /// @rt nonblocking; allocates only to make room for larger vectors than ever sent
  /// @thread the component's own
  CommandHandle send(Args... arguments);

  void connect(OperationBase& base) override;
  void disconnect() override;

 private:
  CommandCaller(Component& owner, std::string_view name, std::string_view doc) noexcept;

  struct Ticket;

  using OperationCallerBase::apply;
  void apply(Outstanding option) noexcept { outstanding_ = option.count; }

  Command<Args...>* command_ = nullptr;
  std::size_t outstanding_ = kDefaultOutstanding;
  std::vector<std::unique_ptr<Ticket, SharedRecord::LetGo>> tickets_;
};

// Compiled once, in the library.
extern template class Command<>;
extern template class Command<double>;
extern template class Command<const std::vector<double>&>;
extern template class CommandCaller<>;
extern template class CommandCaller<double>;
extern template class CommandCaller<const std::vector<double>&>;

}  // namespace armature::component

#include "armature/component/internal/command_definitions.hpp"
