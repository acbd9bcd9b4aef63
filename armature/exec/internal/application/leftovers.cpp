// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/leftovers.hpp"

#include "armature/base/quoted.hpp"

namespace armature::exec::internal {

using base::quoted;
using component::Component;

/// Nobody runs any more, so that this ends soon.
void Leftovers::deliver(base::Diagnostics& diagnostics) const {
  constexpr int kRounds = 64;
  for (int round = 0; round < kRounds; ++round) {
    if (!deliver_once(diagnostics)) return;
  }
}

/// @return whether there was anything
bool Leftovers::deliver_once(base::Diagnostics& diagnostics) const {
  bool any = false;
  for (Index t = 0; t < engines_.size(); ++t) {
    const component::ExecutionContext& context = engines_[t]->context();
    if (context.live || unreachable_.includes(context)) continue;
    engines_[t]->close_account();
    if (!engines_[t]->has_leftovers()) continue;
    any = true;
    deliver_to(t, diagnostics);
  }
  return any;
}

void Leftovers::deliver_to(Index thread, base::Diagnostics& diagnostics) const {
  Engine* const engine = engines_[thread].get();
  Component* const any_member =
      blueprint_.components[plan_.threads[thread].members.front()].component.get();
  const HookSeries delivery{{any_member}, [engine](Component&) {
                              engine->deliver_leftovers();
                              return component::accepted();
                            }};
  if (!run_hooks(delivery, patience_).hangs) return;
  const component::ExecutionContext& context = engine->context();
  unreachable_.give_up(context);
  const Component* const where = context.running();
  diagnostics.error({}, "a message to the thread " + quoted(context.name) +
                            ", handled after its end, hangs" +
                            (where == nullptr ? "" : " in " + quoted(where->name())));
}

}  // namespace armature::exec::internal
