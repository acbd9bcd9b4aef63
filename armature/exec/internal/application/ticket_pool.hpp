// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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
  /// @param number  of the act that begins it; 0: none
  ToolTicket& claim(component::CommandBase& command, std::uint32_t number = 0);
  /// The numbers of those that were asked to end since the last time.
  std::vector<std::uint32_t> take_cancelled();
  /// Has all commands that are under way, or wait, come to an end.
  /// @return whether there was one
  bool cancel_all();
  bool any_under_way() const;

 private:
  std::vector<std::unique_ptr<ToolTicket, component::SharedRecord::LetGo>> tickets_;
};

}  // namespace armature::exec::internal
