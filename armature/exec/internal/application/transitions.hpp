// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

#include "armature/component/outcome.hpp"
#include "armature/exec/internal/application/executor.hpp"
#include "armature/exec/internal/application/mode_control.hpp"
#include "armature/exec/internal/application/roster.hpp"

namespace armature::exec::internal {

/// Transitions of the life cycle of single components, each done by the component's own thread.
class Transitions {
 public:
  Transitions(const Roster& roster, const Executor& executor, const ModeControl& modes)
      : roster_(roster), executor_(executor), modes_(modes) {}

  component::Outcome start(std::string_view name) const;
  /// At once, whatever it holds.
  component::Outcome stop(std::string_view name) const;
  component::Outcome recover(std::string_view name) const;
  component::Outcome reset(std::string_view name) const;
  component::Outcome clean_up(std::string_view name) const;

 private:
  using Transition = std::function<component::Outcome(component::Component&)>;

  component::Outcome change(std::string_view name, Transition transition) const;

  const Roster& roster_;
  const Executor& executor_;
  const ModeControl& modes_;
};

}  // namespace armature::exec::internal
