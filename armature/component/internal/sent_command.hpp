// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/host.hpp"
#include "armature/component/internal/arguments.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/component/operations/command_ticket.hpp"

namespace armature::component::internal {

/// A command on its way to its component, with its arguments.
class SentCommand : public CommandTicket {
 public:
  explicit SentCommand(CommandBase& command)
      : CommandTicket(&SentCommand::deliver), command_(command), arguments_(command.signature()) {}

  void set_arguments(const void* const* arguments) { arguments_.assign(arguments); }

 protected:
  /// It is not to begin any more.
  /// @thread the executing one
  virtual bool is_called_off() const { return cancel_requested(); }

 private:
  static void deliver(rt::Message& message) {
    auto& sent = static_cast<SentCommand&>(message);
    if (sent.is_called_off()) {
      sent.end(CommandStage::kCancelled, "cancelled before it began");
      return;
    }
    static_cast<void>(sent.command_.begin_from(&sent, sent.arguments_.places()));
  }
  ExecutionContext& executor() const final { return Host::context(command_.owner()); }
  void cancel_now() final { command_.cancel(*this); }

  CommandBase& command_;
  Arguments arguments_;
};

}  // namespace armature::component::internal
