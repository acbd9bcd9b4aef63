// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/host.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/component/operations/command_ticket.hpp"

namespace armature::exec::internal {

/// Of a command that a tool began. The application keeps it, so that no component's thread frees
/// it, and gives it to one command after the other.
class ToolTicket final : public component::CommandTicket {
 public:
  ToolTicket() : CommandTicket(nullptr) {}  // never sent: the command begins in a task

  /// @thread the controlling one, which has claimed it
  void belong_to(component::CommandBase& command) { command_ = &command; }

 private:
  component::ExecutionContext& executor() const override {
    return component::Host::context(command_->owner());
  }
  void cancel_now() override { command_->cancel(*this); }

  component::CommandBase* command_ = nullptr;
};

}  // namespace armature::exec::internal
