// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <deque>
#include <set>
#include <vector>

#include "armature/component/host.hpp"
#include "armature/exec/internal/grouped.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

using component::Component;
using component::Pace;

/// Finds how often each component is run. Periods spread from the periodic components, one after
/// the other, to those that they trigger, and then to those that are only called. Each component
/// takes at most two of them, so that the effort grows with the wiring only.
class PacePlanner {
 public:
  PacePlanner(const Blueprint& blueprint, const Plan& plan)
      : blueprint_(blueprint),
        plan_(plan),
        paces_(blueprint.components.size()),
        taking_(blueprint.components.size(), true),
        triggers_(blueprint.components.size()),
        reaches_(blueprint.components.size()) {}

  std::vector<Pace> run() {
    find_edges();
    for (Index i = 0; i < paces_.size(); ++i) {
      const Activity& activity = blueprint_.components[i].activity;
      if (activity.kind != Activity::Kind::kPeriodic) continue;
      paces_[i] = {.period = activity.period, .owner = blueprint_.components[i].component.get()};
    }
    spread(triggers_);
    spread(reaches_);
    return std::move(paces_);
  }

 private:
  using Edges = Grouped<Index>;
  struct Reached {
    Index component;
    const Component* owner;
  };

  void find_edges() {
    for (const ConnectionPlan& connection : plan_.connections) {
      if (connection.triggers) add(connection.from, connection.to, true);
    }
    for (const SubscriptionPlan& told : plan_.subscriptions) {
      if (!told.event->is_occasional()) add(told.from, told.to, true);
    }
    for (const CallPlan& call : plan_.calls) add(call.caller, call.callee, false);
    triggers_.close();
    reaches_.close();
  }

  void add(Index from, Index to, bool triggers) {
    if (!plan_.run_together(from, to)) return;
    if (triggers) triggers_.add(from, to);
    reaches_.add(from, to);
  }

  /// To those that have no period yet.
  void spread(const Edges& edges) {
    std::set<base::Duration> periods;
    for (Index i = 0; i < paces_.size(); ++i) {
      taking_[i] = paces_[i].owner == nullptr;
      if (taking_[i]) continue;
      periods.insert(paces_[i].period);
      if (paces_[i].ambiguous()) periods.insert(paces_[i].other);
    }
    const std::vector<Pace> from = paces_;
    for (const base::Duration period : periods) spread_one(period, from, edges);
  }

  void spread_one(base::Duration period, const std::vector<Pace>& from, const Edges& edges) {
    std::deque<Reached> open;
    for (Index i = 0; i < from.size(); ++i) {
      const Pace& pace = from[i];
      if (pace.owner != nullptr && pace.period == period) open.push_back({i, pace.owner});
      if (pace.ambiguous() && pace.other == period) open.push_back({i, pace.other_owner});
    }
    while (!open.empty()) {
      const Reached here = open.front();
      open.pop_front();
      for (const Index to : edges[here.component]) {
        if (taking_[to] && take(paces_[to], period, here.owner)) open.push_back({to, here.owner});
      }
    }
  }

  /// False if it has this period, or two others.
  static bool take(Pace& pace, base::Duration period, const Component* owner) {
    if (pace.owner == nullptr) {
      pace = {.period = period, .owner = owner};
      return true;
    }
    if (pace.period == period || pace.ambiguous()) return false;
    pace.other = period;
    pace.other_owner = owner;
    return true;
  }

  const Blueprint& blueprint_;
  const Plan& plan_;
  std::vector<Pace> paces_;
  std::vector<bool> taking_;  ///< had no period when the present spreading began
  Edges triggers_;            ///< from component: whom it triggers
  Edges reaches_;             ///< from component: whom it triggers or calls
};

}  // namespace

void plan_periods(const Blueprint& blueprint, const Plan& plan) {
  const std::vector<Pace> paces = PacePlanner(blueprint, plan).run();
  for (Index i = 0; i < paces.size(); ++i) {
    component::Host::set_pace(*blueprint.components[i].component, paces[i]);
  }
}

}  // namespace armature::exec::internal
