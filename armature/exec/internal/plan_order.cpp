// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

/// Orders `count` nodes so that the first of each pair comes before the second; among equals, and
/// where a cycle leaves no choice, the lower index comes first.
class Sorter {
 public:
  explicit Sorter(std::size_t count) : after_(count), waiting_for_(count, 0) {}

  void before(Index first, Index second) {
    if (first == second) return;
    after_[first].push_back(second);
    ++waiting_for_[second];
  }

  /// @param cyclic  set to true if a cycle had to be broken
  std::vector<Index> sort(bool* cyclic = nullptr) {
    std::vector<Index> order;
    std::vector<bool> done(after_.size(), false);
    std::priority_queue<Index, std::vector<Index>, std::greater<>> ready;
    for (Index i = 0; i < after_.size(); ++i) {
      if (waiting_for_[i] == 0) ready.push(i);
    }
    Index first_open = 0;
    while (order.size() < after_.size()) {
      if (ready.empty()) {
        while (done[first_open]) ++first_open;
        if (cyclic != nullptr) *cyclic = true;
        waiting_for_[first_open] = 0;
        ready.push(first_open);
      }
      const Index next = ready.top();
      ready.pop();
      if (done[next]) continue;
      done[next] = true;
      order.push_back(next);
      for (const Index later : after_[next]) {
        if (waiting_for_[later] > 0 && --waiting_for_[later] == 0 && !done[later]) {
          ready.push(later);
        }
      }
    }
    return order;
  }

 private:
  std::vector<std::vector<Index>> after_;
  std::vector<std::size_t> waiting_for_;
};

void order_start(const Blueprint& blueprint, Plan& plan) {
  Sorter sorter(blueprint.components.size());
  for (const ConnectionPlan& connection : plan.connections) {
    if (!connection.entry->policy.one_cycle_delay) sorter.before(connection.from, connection.to);
  }
  plan.start_order = sorter.sort();
}

/// Who is told of an event first: a component that another's data is going to trigger must know of
/// the event before; one that merely reads another's data comes after it.
void order_subscriptions(const Blueprint& blueprint, Plan& plan) {
  Sorter sorter(blueprint.components.size());
  for (const ConnectionPlan& connection : plan.connections) {
    if (connection.input->triggers()) {
      sorter.before(connection.to, connection.from);
    } else if (!connection.entry->policy.one_cycle_delay) {
      sorter.before(connection.from, connection.to);
    }
  }
  const std::vector<Index> order = sorter.sort();
  std::vector<std::size_t> rank(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  std::stable_sort(plan.subscriptions.begin(), plan.subscriptions.end(),
                   [&rank](const SubscriptionPlan& a, const SubscriptionPlan& b) {
                     return std::pair(a.from, rank[a.to]) < std::pair(b.from, rank[b.to]);
                   });
}

/// Writers before readers among the components that a thread updates.
void order_updates(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics) {
  std::vector<Index> place(blueprint.components.size(), kNone);
  std::vector<std::vector<const ConnectionPlan*>> inside(plan.threads.size());
  for (const ThreadPlan& thread : plan.threads) {
    for (Index i = 0; i < thread.updating.size(); ++i) place[thread.updating[i]] = i;
  }
  for (const ConnectionPlan& connection : plan.connections) {
    const Index thread = plan.thread_of[connection.from];
    const bool both_update = place[connection.from] != kNone && place[connection.to] != kNone;
    if (both_update && thread == plan.thread_of[connection.to]) {
      inside[thread].push_back(&connection);
    }
  }
  for (Index t = 0; t < plan.threads.size(); ++t) {
    ThreadPlan& thread = plan.threads[t];
    if (thread.updating.size() < 2) continue;
    Sorter sorter(thread.updating.size());
    for (const ConnectionPlan* connection : inside[t]) {
      if (connection->entry->policy.one_cycle_delay) continue;
      sorter.before(place[connection->from], place[connection->to]);
    }
    bool cyclic = false;
    std::vector<Index> order = sorter.sort(&cyclic);
    for (Index& each : order) each = thread.updating[each];
    thread.updating = std::move(order);
    if (!cyclic) continue;
    const ConnectionEntry& entry = *inside[t].back()->entry;
    diagnostics.error(entry.where,
                      "the components that share the thread " + quoted(thread.name) +
                          " read each other's data in a loop, so that no order has every writer "
                          "before its reader",
                      "declare on one connection of the loop: delay: one_cycle");
  }
}

void list_members(Plan& plan) {
  for (const Index component : plan.start_order) {
    plan.threads[plan.thread_of[component]].members.push_back(component);
  }
}

}  // namespace

void plan_order(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics) {
  order_start(blueprint, plan);
  order_subscriptions(blueprint, plan);
  order_updates(blueprint, plan, diagnostics);
  list_members(plan);
}

}  // namespace armature::exec::internal
