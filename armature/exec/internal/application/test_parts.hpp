// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests of an application's parts: what all of them lie upon, without an application.

#include "armature/exec/internal/application/clock.hpp"
#include "armature/exec/internal/application/death_notice.hpp"
#include "armature/exec/internal/application/engines.hpp"
#include "armature/exec/internal/application/executor.hpp"
#include "armature/exec/internal/application/health.hpp"
#include "armature/exec/internal/application/roster.hpp"
#include "armature/exec/internal/application/unreachable.hpp"
#include "armature/exec/internal/test_components.hpp"

namespace armature::exec::internal {

/// Planned components in engines that nobody runs until the test does.
class PlannedParts {
 public:
  explicit PlannedParts(Blueprint declared, bool simulated = true, base::Duration limit = 60s)
      : blueprint(std::move(declared)),
        clock(simulated),
        executor(clock, unreachable, death_notice, limit) {
    base::Diagnostics diagnostics;
    plan = make_plan(blueprint, diagnostics);
    problems = diagnostics.to_text();
    engines = make_engines(blueprint, plan, {&health.incidents(), simulated, 1, clock.now()});
  }
  PlannedParts(const PlannedParts&) = delete;
  PlannedParts& operator=(const PlannedParts&) = delete;

  component::Component& component(std::size_t place) {
    return *blueprint.components[place].component;
  }
  Engine& engine_of(std::size_t place) { return *engines[plan.thread_of[place]]; }

  Blueprint blueprint;
  Plan plan;
  std::string problems;
  Clock clock;
  Unreachable unreachable;
  DeathNotice death_notice;
  Health health{death_notice, unreachable};
  Engines engines;
  Roster roster{blueprint};
  Executor executor;
};

}  // namespace armature::exec::internal
