// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <optional>
#include <queue>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "armature/exec/event_command.hpp"
#include "armature/exec/internal/grouped.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

/// Orders `count` nodes so that the first of each pair comes before the second; among equals, and
/// in a cycle, which leaves no choice, the lower index comes first.
class Sorter {
 public:
  explicit Sorter(std::size_t count) : after_(count), waiting_for_(count, 0) {}

  void before(Index first, Index second) {
    if (first == second) return;
    after_.add(first, second);
    ++waiting_for_[second];
  }

  /// @param cycle  is given the first cycle that had to be broken, each node before the next
  std::vector<Index> sort(std::vector<Index>* cycle = nullptr) {
    after_.close();
    std::vector<Index> order;
    order.reserve(after_.groups());
    std::vector<bool> done(after_.groups(), false);
    std::priority_queue<Index, std::vector<Index>, std::greater<>> ready;
    for (Index i = 0; i < after_.groups(); ++i) {
      if (waiting_for_[i] == 0) ready.push(i);
    }
    Index first_open = 0;
    while (order.size() < after_.groups()) {
      if (ready.empty()) {
        while (done[first_open]) ++first_open;
        // Not whoever is open: it may only wait for what is in the cycle.
        const std::vector<Index>& broken = find_cycle(first_open, done);
        if (cycle != nullptr && cycle->empty()) *cycle = broken;
        waiting_for_[broken.front()] = 0;
        ready.push(broken.front());
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
  /// Every node that is not done waits for another such node: going back from one to the next ends
  /// in a cycle. It begins with its lowest index.
  const std::vector<Index>& find_cycle(Index start, const std::vector<bool>& done) {
    if (!before_) look_back();
    ++walks_;
    std::vector<Index>& way = way_;
    way.clear();
    Index node = start;
    for (; seen_in_walk_[node] != walks_; node = open_one_before(node, done)) {
      seen_in_walk_[node] = walks_;
      way.push_back(node);
    }
    way.erase(way.begin(), std::find(way.begin(), way.end(), node));
    std::reverse(way.begin(), way.end());
    std::rotate(way.begin(), std::min_element(way.begin(), way.end()), way.end());
    return way;
  }

  Index open_one_before(Index node, const std::vector<bool>& done) {
    const auto candidates = (*before_)[node];
    std::size_t& passed = passed_[node];  // those are done, and stay so
    while (done[candidates[passed]]) ++passed;
    return candidates[passed];
  }

  /// Once, since a robot has a cycle for each joint.
  void look_back() {
    before_.emplace(after_.groups());
    for (Index node = 0; node < after_.groups(); ++node) {
      for (const Index later : after_[node]) before_->add(later, node);
    }
    before_->close();
    seen_in_walk_.assign(after_.groups(), 0);
    passed_.assign(after_.groups(), 0);
  }

  Grouped<Index> after_;
  std::vector<std::size_t> waiting_for_;
  std::optional<Grouped<Index>> before_;
  std::vector<std::size_t> seen_in_walk_;  ///< the last walk that came by each node
  std::vector<std::size_t> passed_;        ///< how many of those before each node are done
  std::vector<Index> way_;
  std::size_t walks_ = 0;
};

void order_start(const Blueprint& blueprint, Plan& plan) {
  Sorter sorter(blueprint.components.size());
  for (const ConnectionPlan& connection : plan.connections) {
    if (!connection.delayed) sorter.before(connection.from, connection.to);
  }
  plan.start_order = sorter.sort();
  // What commands others starts behind them, and stops before: what ends then begins nothing.
  std::stable_partition(plan.start_order.begin(), plan.start_order.end(), [&](Index each) {
    const component::Component* const component = blueprint.components[each].component.get();
    return dynamic_cast<const EventCommand*>(component) == nullptr;
  });
  if (plan.observers.empty()) return;
  const std::unordered_set<Index> observers(plan.observers.begin(), plan.observers.end());
  std::stable_partition(plan.start_order.begin(), plan.start_order.end(),
                        [&observers](Index each) { return observers.contains(each); });
}

/// Who is told of an event first: a component that another's data is going to trigger must know of
/// the event before; one that merely reads another's data comes after it.
void order_subscriptions(const Blueprint& blueprint, Plan& plan) {
  Sorter sorter(blueprint.components.size());
  for (const ConnectionPlan& connection : plan.connections) {
    if (connection.triggers) {
      sorter.before(connection.to, connection.from);
    } else if (!connection.delayed) {
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

/// Writers before readers among the components that each thread updates.
class UpdateOrder {
 public:
  UpdateOrder(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics)
      : blueprint_(blueprint),
        plan_(plan),
        diagnostics_(diagnostics),
        place_(blueprint.components.size(), kNone),
        inside_(plan.threads.size()) {
    for (const ThreadPlan& thread : plan.threads) {
      for (Index i = 0; i < thread.updating.size(); ++i) place_[thread.updating[i]] = i;
    }
    for (const ConnectionPlan& connection : plan.connections) {
      const Index thread = plan.thread_of[connection.from];
      const bool both_update = place_[connection.from] != kNone && place_[connection.to] != kNone;
      const bool at_once = !connection.delayed && plan.run_together(connection.from, connection.to);
      if (both_update && at_once && thread == plan.thread_of[connection.to]) {
        inside_[thread].push_back(&connection);
      }
    }
  }

  void run() {
    for (Index t = 0; t < plan_.threads.size(); ++t) {
      if (plan_.threads[t].updating.size() > 1) order(t);
    }
  }

 private:
  void order(Index thread) {
    std::vector<Index>& updating = plan_.threads[thread].updating;
    Sorter sorter(updating.size());
    for (const ConnectionPlan* connection : inside_[thread]) {
      sorter.before(place_[connection->from], place_[connection->to]);
    }
    std::vector<Index> loop;
    std::vector<Index> order = sorter.sort(&loop);
    for (Index& each : order) each = updating[each];
    for (Index& each : loop) each = updating[each];
    updating = std::move(order);
    if (!loop.empty()) report(thread, loop);
  }

  void report(Index thread, const std::vector<Index>& loop) {
    std::string way;
    for (const Index each : loop) way += blueprint_.components[each].component->name() + " -> ";
    way += blueprint_.components[loop.front()].component->name();
    const auto closes = [&](const ConnectionPlan* connection) {
      return connection->from == loop.back() && connection->to == loop.front();
    };
    const auto& inside = inside_[thread];
    const ConnectionPlan& last = **std::find_if(inside.begin(), inside.end(), closes);
    diagnostics_.error(last.entry->where,
                       "components that share the thread " + quoted(plan_.threads[thread].name) +
                           " read each other's data in a loop, so that no order has every writer "
                           "before its reader: " +
                           way,
                       "declare on one connection of the loop: delay: one_cycle");
  }

  const Blueprint& blueprint_;
  Plan& plan_;
  base::Diagnostics& diagnostics_;
  std::vector<Index> place_;  ///< of a component among those that its thread updates
  std::vector<std::vector<const ConnectionPlan*>> inside_;  ///< for each thread
};

void list_members(Plan& plan) {
  for (const Index component : plan.start_order) {
    plan.threads[plan.thread_of[component]].members.push_back(component);
  }
}

}  // namespace

void plan_order(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics) {
  order_start(blueprint, plan);
  order_subscriptions(blueprint, plan);
  UpdateOrder(blueprint, plan, diagnostics).run();
  list_members(plan);
}

}  // namespace armature::exec::internal
