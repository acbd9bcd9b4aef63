// SPDX-License-Identifier: Apache-2.0
// What modes may not switch off: what holds something, and whoever it needs for that.
#include <algorithm>
#include <string>
#include <vector>

#include "armature/component/holding.hpp"
#include "armature/component/interface.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

class HolderCheck {
 public:
  HolderCheck(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics)
      : blueprint_(blueprint), plan_(plan), diagnostics_(diagnostics) {}

  void run() {
    for (Index i = 0; i < blueprint_.components.size(); ++i) {
      const auto& holdings = component::interface_of(*blueprint_.components[i].component).holdings;
      if (holdings.empty()) continue;
      expect_in_all_modes(i, "which holds something");
      for (const component::Holding* const holding : holdings) check_keepers(i, *holding);
    }
  }

 private:
  void check_keepers(Index holder, const component::Holding& holding) {
    for (const SubscriptionPlan& told : plan_.subscriptions) {
      if (told.to != holder || told.handler != holding.keeper()) continue;
      for (const Index needed : who_runs_for(blueprint_, plan_, told.from)) {
        expect_in_all_modes(needed, "without which " + name_of(holder) + " holds nothing");
      }
    }
  }

  void expect_in_all_modes(Index component, const std::string& why) {
    const ModeSet left_out = all_modes(plan_) & ~plan_.modes_of[component];
    if (left_out == 0) return;
    diagnostics_.error(blueprint_.components[component].where,
                       "a switch of modes would let go: " + name_of(component) + ", " + why +
                           ", does not run" + in_modes(plan_, left_out),
                       "name it in no mode: then it runs in all");
  }

  std::string name_of(Index i) const { return quoted(blueprint_.components[i].component->name()); }

  const Blueprint& blueprint_;
  const Plan& plan_;
  base::Diagnostics& diagnostics_;
};

}  // namespace

std::vector<Index> who_runs_for(const Blueprint& blueprint, const Plan& plan, Index component) {
  std::vector<Index> all{component};
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (blueprint.components[all[i]].activity.owns_thread()) continue;
    for (const SubscriptionPlan& told : plan.subscriptions) {
      if (told.to != all[i] || std::ranges::find(all, told.from) != all.end()) continue;
      all.push_back(told.from);
    }
  }
  return all;
}

void check_holders(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics) {
  if (!plan.modes.empty()) HolderCheck(blueprint, plan, diagnostics).run();
}

}  // namespace armature::exec::internal
