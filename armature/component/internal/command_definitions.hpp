// SPDX-License-Identifier: Apache-2.0
#pragma once

// What of commands and their callers is not in their header.

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "armature/component/command.hpp"

namespace armature::component {

template <typename... Args>
Command<Args...>::Command(Component& owner, std::string_view name, std::string_view doc,
                          Function function) noexcept
    : CommandBase(owner,
                  std::make_unique<About>(name, doc, Signature::of<void, Args...>({}), true)),
      function_(function) {}

template <typename... Args>
Command<Args...>::~Command() = default;

template <typename... Args>
std::unique_ptr<OperationBase> Command<Args...>::twin(StandIn& owner) const {
  const auto pass_on = [](Command& command, Args... arguments) -> Outcome {
    const std::array<const void*, sizeof...(Args)> places{&arguments...};
    return static_cast<StandIn&>(command.owner()).begin(command, places.data());
  };
  std::unique_ptr<Command> made(new Command(owner, name(), doc(), Function(pass_on)));
  mark_twin(*made);
  return made;
}

template <typename... Args>
Outcome Command<Args...>::begin(CommandTicket* ticket, Args... arguments) {
  Outcome outcome = admit(ticket);
  if (!outcome) return outcome;
  const bool completed = owner().run(
      owner().context(), [&] { outcome = function_(*this, static_cast<Args>(arguments)...); });
  return begun(ticket, completed, outcome);
}

template <typename... Args>
base::Result<void> Command<Args...>::begin_with(CommandTicket* ticket,
                                                const std::vector<types::Value>& arguments) {
  if (std::string problem = mismatch(arguments); !problem.empty()) {
    if (ticket != nullptr) ticket->end(CommandStage::kRefused, problem);
    return base::Error{std::move(problem)};
  }
  const Outcome outcome = begin_with(ticket, arguments, std::index_sequence_for<Args...>{});
  if (!outcome) return base::Error{std::string(outcome.reason())};
  return {};
}

template <typename... Args>
template <std::size_t... I>
Outcome Command<Args...>::begin_with(CommandTicket* ticket,
                                     [[maybe_unused]] const std::vector<types::Value>& arguments,
                                     std::index_sequence<I...>) {
  return begin(ticket, *static_cast<const std::decay_t<Args>*>(arguments[I].data())...);
}

template <typename... Args>
struct CommandCaller<Args...>::Ticket final : CommandTicket {
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

template <typename... Args>
CommandCaller<Args...>::CommandCaller(Component& owner, std::string_view name,
                                      std::string_view doc) noexcept
    : OperationCallerBase(owner,
                          std::make_unique<About>(name, doc, Signature::of<void, Args...>({}))) {}

template <typename... Args>
CommandCaller<Args...>::~CommandCaller() = default;

template <typename... Args>
CommandHandle CommandCaller<Args...>::send(Args... arguments) {
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

template <typename... Args>
void CommandCaller<Args...>::connect(OperationBase& base) {
  command_ = static_cast<Command<Args...>*>(&base);
  about().target = &base;
  tickets_.clear();
  for (std::size_t i = 0; i < outstanding_; ++i) tickets_.emplace_back(new Ticket(*command_));
}

template <typename... Args>
void CommandCaller<Args...>::disconnect() {
  command_ = nullptr;
  about().target = nullptr;
  tickets_.clear();
}

}  // namespace armature::component
