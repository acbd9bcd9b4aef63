// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "armature/component/holding.hpp"
#include "armature/exec/internal/application/executor.hpp"
#include "armature/exec/internal/application/health.hpp"
#include "armature/exec/internal/application/roster.hpp"
#include "armature/exec/run_end.hpp"

namespace armature::exec::internal {

/// The components that keep something from moving by itself, and what: asked in their own threads,
/// and only while the application runs, since else nothing is held.
class Holders {
 public:
  Holders(const Blueprint& blueprint, const Plan& plan, const Roster& roster,
          const Executor& executor, const Health& health)
      : blueprint_(blueprint), plan_(plan), roster_(roster), executor_(executor), health_(health) {}

  /// What would move by itself if all of them stopped now.
  std::vector<Held> held() const;
  /// What `component` holds.
  std::optional<Held> held_by(component::Component& component) const;
  /// What another component holds only as long as `component` runs.
  std::optional<Held> held_by_help_of(const component::Component& component) const;

 private:
  bool needs(const component::Holding& holding, const component::Component& component) const;

  const Blueprint& blueprint_;
  const Plan& plan_;
  const Roster& roster_;
  const Executor& executor_;
  const Health& health_;
};

}  // namespace armature::exec::internal
