// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

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
  /// @param number  of the act that begins it; 0: nobody keeps account of acts
  void belong_to(component::CommandBase& command, std::uint32_t number) {
    command_ = &command;
    number_ = number;
  }
  /// The number, once, after it was asked to end; else 0.
  /// @thread the controlling one
  std::uint32_t take_cancelled() {
    return number_ != 0 && cancel_requested() ? std::exchange(number_, 0) : 0;
  }

 private:
  component::ExecutionContext& executor() const override {
    return component::Host::context(command_->owner());
  }
  void cancel_now() override { command_->cancel(*this); }

  component::CommandBase* command_ = nullptr;
  std::uint32_t number_ = 0;
};

}  // namespace armature::exec::internal
