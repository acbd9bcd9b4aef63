// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/diagnostic.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/internal/application/engines.hpp"
#include "armature/exec/internal/application/unreachable.hpp"
#include "armature/exec/internal/hook_series.hpp"
#include "armature/exec/plan.hpp"

namespace armature::exec::internal {

/// What was sent to threads that had ended already. Operations that were sent are their
/// components' code, which may hang like a hook.
class Leftovers {
 public:
  Leftovers(const Blueprint& blueprint, const Plan& plan, const Engines& engines,
            Unreachable& unreachable, HookPatience patience)
      : blueprint_(blueprint),
        plan_(plan),
        engines_(engines),
        unreachable_(unreachable),
        patience_(std::move(patience)) {}

  /// Delivers all of it, and what comes of that; names the thread whose leftovers hang.
  void deliver(base::Diagnostics& diagnostics) const;

 private:
  bool deliver_once(base::Diagnostics& diagnostics) const;
  void deliver_to(Index thread, base::Diagnostics& diagnostics) const;

  const Blueprint& blueprint_;
  const Plan& plan_;
  const Engines& engines_;
  Unreachable& unreachable_;
  const HookPatience patience_;
};

}  // namespace armature::exec::internal
