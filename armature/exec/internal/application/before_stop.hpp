// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/exec/application_options.hpp"
#include "armature/exec/internal/application/clock.hpp"
#include "armature/exec/internal/application/health.hpp"
#include "armature/exec/internal/application/holders.hpp"
#include "armature/exec/internal/application/outlets.hpp"
#include "armature/exec/internal/application/roster.hpp"
#include "armature/exec/internal/application/run_loop.hpp"
#include "armature/exec/internal/application/ticket_pool.hpp"
#include "armature/exec/internal/application/tool_access.hpp"
#include "armature/exec/run_end.hpp"

namespace armature::exec::internal {

/// What the deployment has done before an orderly stop, and what is not let go of in silence. The
/// application runs on meanwhile.
class BeforeStop {
 public:
  BeforeStop(const ApplicationOptions& options, const Clock& clock, const Roster& roster,
             const ToolAccess& tools, TicketPool& tickets, const Holders& holders, Health& health,
             Outlets& outlets, RunLoop& loop)
      : options_(options),
        clock_(clock),
        roster_(roster),
        tools_(tools),
        tickets_(tickets),
        holders_(holders),
        health_(health),
        outlets_(outlets),
        loop_(loop) {}

  /// As Application::run_before_stop.
  base::Diagnostics run_commands(RunEnd end, const platform::StopSignal* stop, Leave leave);
  /// As Application::hold_until_told.
  base::Diagnostics hold_until_told(const platform::StopSignal* stop,
                                    const std::function<bool(base::Duration)>& converse);

 private:
  void begin_to_leave();
  bool cancel_all(const platform::StopSignal* stop);
  bool holds_nothing(std::string_view name) const;
  void leave_out(const CommandName& name, const char* why);
  bool do_it(const CommandName& name, const platform::StopSignal* stop,
             base::Diagnostics& diagnostics);
  std::string run(const CommandName& name, const platform::StopSignal* stop);
  void say(const std::vector<Held>& held);
  RunEnd wait_until_let_go(std::vector<Held>& held, base::Time end,
                           const platform::StopSignal* stop);

  const ApplicationOptions& options_;
  const Clock& clock_;
  const Roster& roster_;
  const ToolAccess& tools_;
  TicketPool& tickets_;
  const Holders& holders_;
  Health& health_;
  Outlets& outlets_;
  RunLoop& loop_;
};

}  // namespace armature::exec::internal
