// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "armature/component/outcome.hpp"
#include "armature/exec/internal/application/executor.hpp"
#include "armature/exec/internal/application/health.hpp"
#include "armature/exec/internal/application/roster.hpp"
#include "armature/exec/modes.hpp"

namespace armature::exec::internal {

/// What the plan has to say about modes, and the wish for another one, for the component `Modes`.
class ModeControl {
 public:
  ModeControl(const Blueprint& blueprint, const Plan& plan, const Roster& roster,
              const Executor& executor, const Health& health)
      : blueprint_(blueprint), plan_(plan), roster_(roster), executor_(executor), health_(health) {}

  /// Before a start.
  void set_up(base::Time now) const;
  /// Who switches; nullptr if the application has no modes.
  Modes* switcher() const;
  component::Outcome switch_to(std::string_view name) const;

 private:
  Modes::Mode mode_of(std::size_t number) const;

  const Blueprint& blueprint_;
  const Plan& plan_;
  const Roster& roster_;
  const Executor& executor_;
  const Health& health_;
};

}  // namespace armature::exec::internal
