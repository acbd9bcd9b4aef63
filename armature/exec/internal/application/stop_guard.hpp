// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "armature/component/operations/command.hpp"
#include "armature/component/outcome.hpp"
#include "armature/exec/application_options.hpp"
#include "armature/exec/internal/application/holders.hpp"
#include "armature/exec/internal/application/outlets.hpp"
#include "armature/exec/internal/application/roster.hpp"
#include "armature/exec/internal/application/tool_access.hpp"
#include "armature/exec/internal/application/transitions.hpp"

namespace armature::exec::internal {

/// Lets no component stop that holds something: it does what is declared before a stop first.
class StopGuard {
 public:
  /// @param before_stop  what each holder does before it stops
  StopGuard(const std::vector<CommandName>& before_stop, const Roster& roster,
            const Holders& holders, const ToolAccess& tools, const Transitions& transitions,
            Outlets& outlets)
      : before_stop_(before_stop),
        roster_(roster),
        holders_(holders),
        tools_(tools),
        transitions_(transitions),
        outlets_(outlets) {}

  /// Stops it; or has it begin what comes before, if it holds something; or refuses.
  component::Outcome stop(std::string_view name);
  /// Stops those whose commands are done by now, and says who goes on and why.
  void finish();
  bool is_on_way(std::string_view name) const;
  /// It goes on running, and what moves comes to rest.
  void cancel(std::string_view name);
  /// Everything stops.
  void forget_all() { on_way_.clear(); }

 private:
  /// A component that stops when its command is done.
  struct WayToStop {
    CommandName command;
    component::CommandHandle handle;
  };

  component::Outcome begin(const Held& held);
  void end(const WayToStop& way);

  const std::vector<CommandName>& before_stop_;
  const Roster& roster_;
  const Holders& holders_;
  const ToolAccess& tools_;
  const Transitions& transitions_;
  Outlets& outlets_;
  std::vector<WayToStop> on_way_;
};

/// Its name as messages have it: `'Arm.park'`.
std::string dotted(const CommandName& name);

}  // namespace armature::exec::internal
