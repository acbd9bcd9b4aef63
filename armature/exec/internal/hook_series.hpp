// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"

namespace armature::exec::internal {

/// A transition of the life cycle of many components, one after the other.
struct HookSeries {
  using Transition = std::function<component::Outcome(component::Component&)>;

  std::vector<component::Component*> components;
  Transition transition;
  bool ends_at_refusal = false;
};

/// How it went.
struct HookReport {
  struct Refusal {
    component::Component* component;
    std::string reason;
  };
  std::vector<Refusal> refusals;
  /// What was not done; if anything hangs, it is the first of these.
  std::vector<component::Component*> open;
  bool hangs = false;
};

/// How long one component may take, and what the waiting thread does meanwhile, now and then.
struct HookPatience {
  base::Duration limit;
  std::function<void()> meanwhile;
  bool operators_too = false;  ///< besides, as long as it waits for a person (WaitsForOperator)

  /// Of one component.
  base::Duration limit_of(const component::Component& component) const;
};

/// The name of the thread in which `run_hooks` runs them.
inline constexpr const char* kLifeCycleThread = "life cycle";

/// Runs the hooks in a thread of their own. If one hangs, it is left alone there and none follows.
HookReport run_hooks(const HookSeries& series, const HookPatience& patience);

/// Runs the hooks in the running thread of `context`. If that hangs, they run when it goes on.
HookReport run_hooks_in(component::ExecutionContext& context, const HookSeries& series,
                        const HookPatience& patience);

}  // namespace armature::exec::internal
