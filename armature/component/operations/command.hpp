// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/component/operations/operation.hpp"
#include "armature/component/step.hpp"

namespace armature::component {

class CommandTicket;

namespace internal {
class WaitingCommands;
}

/// Where a command is. Ordered: everything from kRefused on is an end.
enum class CommandStage : std::uint32_t {
  kFree,
  kQueued,    ///< on its way to the component
  kWaiting,   ///< accepted, and not begun yet: the one before it is under way
  kAccepted,  ///< under way
  kRefused,
  kDone,
  kFailed,
  kCancelled,
};

std::string_view name_of(CommandStage stage);

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
/// Option of a command.
template <auto Function>
struct MayWait {
  std::size_t capacity;
};
/// So many commands may wait while one is under way; without this option none does. `Function` is
/// `Outcome f(Args...) const`, asked when a command is to wait: it refuses what can be refused
/// before it is known where the command begins, and arguments of another shape than `prepare` was
/// given. The command itself is asked when it begins, in the update in which the one before it is
/// done; if it refuses then, its sender is told so, and the log.
///
/// A command that waits was given in the hope of what the one before it does: where that one ends
/// in any other way than done, all that wait are cancelled.
template <auto Function>
constexpr MayWait<Function> may_wait(std::size_t capacity) {
  return {capacity};
}

/// The runtime's side of a command: what tools know of it, and how it goes on after it was
/// accepted.
class CommandBase : public OperationBase, public Step {
 public:
  ~CommandBase() override;

  bool is_command() const final { return true; }
  bool active() const { return phase_ != Phase::kIdle; }
  /// How many are accepted and have not begun.
  /// @thread the component's own
  std::size_t waiting() const;

  base::Result<std::optional<types::Value>> invoke(
      const std::vector<types::Value>& arguments) final;
  /// The same for a tool that follows the command: `ticket` is told how it fares, also of a
  /// refusal.
  /// @thread the component's own
  base::Result<void> begin_with(CommandTicket* ticket, const std::vector<types::Value>& arguments);
  /// Begins the command with arguments that are where `arguments` says, as its signature has them.
  /// @param ticket  is told how it fares; nullptr: nobody asks
  /// @thread the component's own
  Outcome begin_from(CommandTicket* ticket, const void* const* arguments);

  /// For the component: how far it is (0..1), and its end. `fail` also ends all that wait.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void report(double progress);
  void complete() { end(CommandStage::kDone, {}); }
  void fail(std::string_view reason) { end(CommandStage::kFailed, reason); }

  /// Ends the command if it is the one that `ticket` began, or waits for its turn.
  void cancel(const CommandTicket& ticket);

  void step() final;
  void halt(std::string_view reason) final { cancel(reason); }

 protected:
  using Begin = Outcome (*)(CommandBase&, const void* const* arguments);

  CommandBase(Component& owner, std::string_view name, std::string_view doc, Signature signature,
              Begin begin) noexcept;

  /// @param check  asked before a command waits
  void let_wait(std::size_t capacity, Begin check);
  void prepare_from(const void* const* arguments);

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

 private:
  class Twin;
  enum class Phase : std::uint8_t { kIdle, kBeginning, kUnderWay };

  std::unique_ptr<OperationBase> make_twin(Component& owner) const final;
  /// Begins, or refuses because it cannot now; `ticket` is told of a refusal, if there is one.
  Outcome admit(CommandTicket* ticket);
  Outcome begin_now(CommandTicket* ticket, const void* const* arguments);
  /// The next one waits behind those before it, or is refused.
  bool has_to_wait() const;
  Outcome wait(CommandTicket* ticket, const void* const* arguments);
  Outcome may_wait_now(const void* const* arguments);
  void begin_next();
  /// Ends those that wait, but for the first `remaining`.
  void drop_waiting(std::size_t remaining, std::string_view reason);
  /// Goes on after the component was asked, and tells `ticket`, if there is one.
  /// @param completed  no exception escaped
  /// @param outcome    what the component said
  Outcome begun(CommandTicket* ticket, bool completed, const Outcome& outcome);
  void cancel(std::string_view reason);
  void end(CommandStage stage, std::string_view reason);

  Begin begin_;
  bool (*done_)(CommandBase&) = nullptr;
  void (*cancelled_)(CommandBase&) = nullptr;
  Phase phase_ = Phase::kIdle;
  CommandStage ended_early_ = CommandStage::kDone;  ///< while it was begun
  Reason early_reason_;
  CommandTicket* ticket_ = nullptr;
  Begin may_wait_ = nullptr;
  std::unique_ptr<internal::WaitingCommands> waiting_;  ///< nullptr: none may
};

/// An operation that goes on after it was accepted: refused with a reason, or under way with
/// progress until it is done, failed or cancelled. One at a time, and as many wait as `may_wait`
/// says; runs in its component's thread.
template <typename... Args>
class Command final : private CommandBase {
 public:
  using CommandBase::active;
  using CommandBase::complete;
  using CommandBase::fail;
  using CommandBase::report;
  using CommandBase::waiting;

  /// `Function` is `Outcome f(Args...)`: accepts, or refuses with a reason and changes nothing.
  /// Options: done_when<&X::f>, cancelled_by<&X::f>, may_wait<&X::f>(n), by_operator, in_any_state,
  /// args(names...).
  template <auto Function, typename... Options>
  Command(Component* owner, std::string_view name, Serve<Function>, std::string_view doc,
          Options... options) noexcept
      : CommandBase(*owner, name, doc, Signature::of<void, Args...>({}), &serve_from<Function>) {
    (apply(options), ...);
  }

  /// Gives the memory of those that wait the shape of these arguments, so that none of them
  /// allocates.
  /// @thread configuration only
  void prepare(Args... sample) {
    const std::array<const void*, sizeof...(Args)> places{&sample...};
    prepare_from(places.data());
  }

 private:
  using RuntimeFace = CommandBase;
  friend class internal::Inside;

  using CommandBase::apply;
  template <auto Function>
  void apply(MayWait<Function> option) noexcept {
    let_wait(option.capacity, &serve_from<Function>);
  }

  template <auto Function>
  static Outcome serve_from(CommandBase& command, [[maybe_unused]] const void* const* arguments) {
    using Owner = internal::OwnerOf<Function>;
    static_assert(std::is_invocable_r_v<Outcome, decltype(Function), Owner&, Args...>,
                  "a command is served by Outcome f(arguments of the command)");
    auto& component = static_cast<Owner&>(command.owner());
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return (component.*Function)(*static_cast<const std::decay_t<Args>*>(arguments[I])...);
    }
    (std::index_sequence_for<Args...>{});
  }
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
  ~CommandHandle();

  /// False if it could not be sent: not connected, or too many under way.
  bool sent() const { return ticket_ != nullptr; }
  CallStatus send_status() const { return sent() ? CallStatus::kDone : refusal_; }
  CommandStage stage() const;
  bool ended() const;
  double progress() const;
  std::string_view reason() const;
  /// Asks the component to end it; it is over when `stage` says so.
  void cancel();

 private:
  CommandTicket* ticket_ = nullptr;
  CallStatus refusal_ = CallStatus::kPending;
};

/// What callers of commands have in common.
class CommandCallerBase : public OperationCallerBase {
 public:
  ~CommandCallerBase() override;

  bool needs_command() const final { return true; }
  void connect(OperationBase& command) final;
  void disconnect() final;

 protected:
  CommandCallerBase(Component& owner, std::string_view name, std::string_view doc,
                    Signature signature) noexcept;

  /// @param arguments  where they are, as the signature has them
  CommandHandle send_from(const void* const* arguments);

 private:
  class SentTicket;
  struct LetGo {
    void operator()(SentTicket* ticket) const;
  };

  std::vector<std::unique_ptr<SentTicket, LetGo>> tickets_;
};

/// A component's declared use of a command of one of its peers.
template <typename... Args>
class CommandCaller final : private CommandCallerBase {
 public:
  using CommandCallerBase::bound;

  /// Options: from(property), optional, only_if(property), outstanding(n).
  template <typename... Options>
  CommandCaller(Component* owner, std::string_view name, std::string_view doc,
                Options... options) noexcept
      : CommandCallerBase(*owner, name, doc, Signature::of<void, Args...>({})) {
    (apply(options), ...);
  }

  /// Sends the command and returns at once.
  /// @rt nonblocking; allocates only to make room for larger vectors than ever sent
  /// @thread the component's own
  CommandHandle send(Args... arguments) {
    const std::array<const void*, sizeof...(Args)> places{&arguments...};
    return send_from(places.data());
  }

 private:
  using RuntimeFace = CommandCallerBase;
  friend class internal::Inside;
};

// Compiled once, in the library.
extern template class Command<>;
extern template class Command<double>;
extern template class Command<const std::vector<double>&>;
extern template class CommandCaller<>;
extern template class CommandCaller<double>;
extern template class CommandCaller<const std::vector<double>&>;

}  // namespace armature::component
