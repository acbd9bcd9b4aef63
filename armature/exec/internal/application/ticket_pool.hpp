// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "armature/component/operations/call_record.hpp"
#include "armature/exec/internal/tool_ticket.hpp"

namespace armature::exec::internal {

/// The tickets of all commands that tools began, used again and again.
/// @thread the controlling one
class TicketPool {
 public:
  /// One that nobody has, for this command.
  ToolTicket& claim(component::CommandBase& command);
  /// Has all commands that are under way, or wait, come to an end.
  /// @return whether there was one
  bool cancel_all();
  bool any_under_way() const;

 private:
  std::vector<std::unique_ptr<ToolTicket, component::SharedRecord::LetGo>> tickets_;
};

}  // namespace armature::exec::internal
