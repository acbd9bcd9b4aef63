// SPDX-License-Identifier: Apache-2.0
#pragma once

// Members of a component whose types are known when it is made, not when it is compiled: for
// components that the runtime makes from a deployment.

#include <atomic>
#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "armature/component/events/event.hpp"
#include "armature/component/events/event_tap.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"

namespace armature::component {

/// Handles an event of any signature, and leads to nothing: what it is to cause is sent by message.
/// In the raiser's thread it is told after the typed handlers.
class UntypedEventHandler final : public EventHandlerBase, private EventTap {
 public:
  /// @param arguments  where they are, as the event's signature describes them
  using Function = void (*)(void* self, const void* const* arguments);

  /// @param name  a literal
  UntypedEventHandler(Component& owner, std::string_view name, std::string_view doc,
                      const EventBase& like, Function function, void* self) noexcept;

  /// The event is raised in the thread of both.
  /// @thread configuration only
  void listen(EventBase& event);
  void listen_no_more(EventBase& event);

 private:
  void event_raised(const void* const* arguments) noexcept override;
  void handle_from(ExecutionContext& where, const void* const* arguments) noexcept override;

  Function function_;
  void* self_;
};

/// The declared use of a command of any signature.
class UntypedCommandCaller final : public CommandCallerBase {
 public:
  /// Told of the end of each command that was sent.
  /// @thread the component's own
  using Ended = void (*)(void* self, CommandStage stage, std::string_view reason);

  /// @param name  lives as long as this
  /// @param most  so many may be under way
  UntypedCommandCaller(Component& owner, std::string_view name, std::string_view doc,
                       const CommandBase& like, std::size_t most, Ended ended, void* self) noexcept;
  ~UntypedCommandCaller() override;

  /// Gives all that is sent the shape of these arguments, so that sending them never allocates.
  /// @thread configuration only, after it was connected
  void prepare(const void* const* sample);
  /// Sends the command and returns at once.
  /// @param arguments  where they are, as the command's signature has them
  /// @return kPending, kNotConnected, or kQueueFull if too many are under way
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  CallStatus send(const void* const* arguments);
  /// Nobody is told of the end of those that are under way now.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void forget();
  /// No command begins from now on, and those under way are cancelled; until `resume`.
  /// @thread any
  void rest();
  /// @rt nonblocking, no allocation
  void resume() { rests_.store(false, std::memory_order_release); }
  bool rests() const { return rests_.load(std::memory_order_acquire); }

 private:
  class Order;
  void tell(CommandStage stage, std::string_view reason);
  struct LetGo {
    void operator()(Order* order) const;
  };

  std::atomic<bool> rests_{false};
  std::size_t most_;
  Ended ended_;
  void* self_;
  std::vector<std::unique_ptr<Order, LetGo>> orders_;
};

/// The declared use of an operation of any signature, which is never waited for.
class UntypedOperationCaller final : public OperationCallerBase {
 public:
  /// Told of the end of each call that was sent.
  /// @param result  what it returned, of a call that is done; nullptr if nothing
  /// @thread the component's own
  using Ended = void (*)(void* self, CallStatus status, const void* result);

  /// @param name  lives as long as this
  /// @param most  so many may be under way
  UntypedOperationCaller(Component& owner, std::string_view name, std::string_view doc,
                         const OperationBase& like, std::size_t most, Ended ended,
                         void* self) noexcept;
  ~UntypedOperationCaller() override;

  /// Gives all that is sent the shape of these arguments, so that sending them never allocates.
  /// @thread configuration only, after it was connected
  void prepare(const void* const* sample);
  /// Sends the call to the operation's own thread and returns at once.
  /// @param arguments  where they are, as the operation's signature has them
  /// @return kPending, kNotConnected, or kQueueFull if too many are under way
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  CallStatus send(const void* const* arguments);
  /// Nobody is told of the end of those that are under way now, and what has not begun does not.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void forget();

 private:
  class Question;
  struct LetGo {
    void operator()(Question* question) const;
  };

  std::size_t most_;
  Ended ended_;
  void* self_;
  std::vector<std::unique_ptr<Question, LetGo>> questions_;
};

/// An input of the type and unit of an output.
class UntypedInputPort final : public InputPortBase {
 public:
  UntypedInputPort(Component& owner, std::string_view name, std::string_view doc,
                   const OutputPortBase& like) noexcept;

  /// As `Reading`, of any type.
  using Reading = InputPortBase::Found;
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  Reading read() noexcept { return find(); }
};

}  // namespace armature::component
