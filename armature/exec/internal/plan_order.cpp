// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <queue>
#include <string>
#include <unordered_map>
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

/// The handlers of an application and which of them may set off which other in the same thread.
class TriggerGraph {
 public:
  TriggerGraph(const Blueprint& blueprint, const Plan& plan) : blueprint_(blueprint), plan_(plan) {
    for (const ConnectionPlan& connection : plan.connections) {
      if (connection.input->triggers()) node(connection.input, connection.to, *connection.input);
    }
    for (const SubscriptionPlan& subscription : plan.subscriptions) {
      node(subscription.handler, subscription.to, *subscription.handler);
    }
    for (const ConnectionPlan& connection : plan.connections) {
      const bool now = connection.input->triggers() && !connection.entry->policy.one_cycle_delay;
      if (now && same_thread(connection.from, connection.to)) {
        out_of_[connection.from].push_back(
            {connection.output->name(), index_.at(connection.input), connection.entry->where});
      }
    }
    for (const SubscriptionPlan& subscription : plan.subscriptions) {
      if (same_thread(subscription.from, subscription.to)) {
        out_of_[subscription.from].push_back({subscription.event->name(),
                                              index_.at(subscription.handler),
                                              blueprint.components[subscription.to].where});
      }
    }
  }

  void report_cycles(base::Diagnostics& diagnostics) {
    state_.assign(nodes_.size(), State::kUnseen);
    for (std::size_t start = 0; start < nodes_.size(); ++start) {
      if (state_[start] == State::kUnseen) search(start, diagnostics);
    }
  }

 private:
  enum class State { kUnseen, kOpen, kDone };
  struct Node {
    Index component;
    std::string path;
    const component::LeadsTo* effects;
  };
  struct Way {
    std::string_view through;  ///< output port or event
    std::size_t to;
    base::Location where;
  };
  struct Visit {
    std::size_t node;
    std::size_t next_way = 0;
  };

  template <typename Entry>
  void node(const void* key, Index component, const Entry& entry) {
    if (!index_.emplace(key, nodes_.size()).second) return;
    nodes_.push_back(
        {component,
         blueprint_.components[component].component->name() + "." + std::string(entry.name()),
         &entry.effects()});
  }

  bool same_thread(Index a, Index b) const { return plan_.thread_of[a] == plan_.thread_of[b]; }

  void search(std::size_t start, base::Diagnostics& diagnostics) {
    std::vector<Visit> path{{start}};
    state_[start] = State::kOpen;
    while (!path.empty()) {
      Visit& visit = path.back();
      const Node& here = nodes_[visit.node];
      const std::vector<Way>& ways = out_of_[here.component];
      if (visit.next_way == ways.size()) {
        state_[visit.node] = State::kDone;
        path.pop_back();
        continue;
      }
      const Way& way = ways[visit.next_way++];
      if (!here.effects->includes(way.through)) continue;
      if (state_[way.to] == State::kOpen) report(path, way, diagnostics);
      if (state_[way.to] != State::kUnseen) continue;
      state_[way.to] = State::kOpen;
      path.push_back({way.to});
    }
  }

  void report(const std::vector<Visit>& path, const Way& back, base::Diagnostics& diagnostics) {
    std::string text;
    bool inside = false;
    for (const Visit& visit : path) {
      inside = inside || visit.node == back.to;
      if (inside) text += nodes_[visit.node].path + " -> ";
    }
    diagnostics.error(back.where,
                      "handlers may set each other off without end: " + text + nodes_[back.to].path,
                      "declare delay: one_cycle on one of these connections, or leads_to(...) on "
                      "a port whose handler does not write all outputs of its component");
  }

  const Blueprint& blueprint_;
  const Plan& plan_;
  std::vector<Node> nodes_;
  std::unordered_map<const void*, std::size_t> index_;
  std::unordered_map<Index, std::vector<Way>> out_of_;
  std::vector<State> state_;
};

}  // namespace

void plan_order(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics) {
  order_start(blueprint, plan);
  order_subscriptions(blueprint, plan);
  order_updates(blueprint, plan, diagnostics);
  list_members(plan);
}

void check_trigger_cycles(const Blueprint& blueprint, const Plan& plan,
                          base::Diagnostics& diagnostics) {
  TriggerGraph(blueprint, plan).report_cycles(diagnostics);
}

}  // namespace armature::exec::internal
