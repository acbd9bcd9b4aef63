// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

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
      if (runs_within_the_write(connection)) {
        out_of_[connection.from].push_back({connection.output->name(), index_.at(connection.input),
                                            &connection.entry->where, is_periodic(connection.to)});
      }
    }
    for (const SubscriptionPlan& subscription : plan.subscriptions) {
      if (same_thread(subscription.from, subscription.to)) {
        out_of_[subscription.from].push_back({subscription.event->name(),
                                              index_.at(subscription.handler),
                                              &blueprint.components[subscription.to].where, false});
      }
    }
  }

  void report_cycles(base::Diagnostics& diagnostics) {
    state_.assign(nodes_.size(), State::kUnseen);
    for (std::size_t start = 0; start < nodes_.size(); ++start) {
      if (state_[start] == State::kUnseen) search(start, diagnostics);
    }
  }

  /// How deep handlers nest in each thread; to be asked if there are no cycles.
  std::vector<int> depths() const {
    std::vector<int> depths(plan_.threads.size(), 0);
    for (const Node& node : nodes_) {
      int& depth = depths[plan_.thread_of[node.component]];
      depth = std::max(depth, node.depth);
    }
    return depths;
  }

 private:
  enum class State { kUnseen, kOpen, kDone };
  struct Node {
    Index component;
    std::string path;
    const component::LeadsTo* effects;
    int depth = 1;  ///< of the handlers that it sets off, itself included
  };
  struct Way {
    std::string_view through;  ///< output port or event
    std::size_t to;
    const base::Location* where;
    bool ends_by_delay;
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

  /// A delayed value is not handled before the next cycle; but in a triggered thread that follows
  /// at once, so that the delay does not end a cycle of handlers.
  bool runs_within_the_write(const ConnectionPlan& connection) const {
    if (!connection.input->triggers() || !same_thread(connection.from, connection.to)) return false;
    return !connection.entry->policy.one_cycle_delay || !is_periodic(connection.to);
  }

  bool is_periodic(Index component) const {
    const ThreadPlan& thread = plan_.threads[plan_.thread_of[component]];
    return thread.activity.kind == Activity::Kind::kPeriodic;
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
        const int depth = here.depth + 1;
        path.pop_back();
        if (!path.empty()) deepen(path.back().node, depth);
        continue;
      }
      const Way& way = ways[visit.next_way++];
      if (!here.effects->includes(way.through)) continue;
      if (state_[way.to] == State::kOpen) report(path, way, diagnostics);
      if (state_[way.to] == State::kDone) deepen(visit.node, nodes_[way.to].depth + 1);
      if (state_[way.to] != State::kUnseen) continue;
      state_[way.to] = State::kOpen;
      path.push_back({way.to});
    }
  }

  void deepen(std::size_t node, int depth) {
    nodes_[node].depth = std::max(nodes_[node].depth, depth);
  }

  void report(const std::vector<Visit>& path, const Way& back, base::Diagnostics& diagnostics) {
    std::string text;
    bool inside = false;
    bool delay_helps = false;
    for (const Visit& visit : path) {
      inside = inside || visit.node == back.to;
      if (!inside) continue;
      text += nodes_[visit.node].path + " -> ";
      delay_helps = delay_helps || way_taken(visit).ends_by_delay;
    }
    diagnostics.error(*back.where,
                      "handlers may set each other off without end: " + text + nodes_[back.to].path,
                      std::string("declare ") +
                          (delay_helps ? "delay: one_cycle on one of these connections, or " : "") +
                          "leads_to(...) where a handler does not write all outputs of its "
                          "component");
  }

  const Way& way_taken(const Visit& visit) const {
    return out_of_.at(nodes_[visit.node].component)[visit.next_way - 1];
  }

  const Blueprint& blueprint_;
  const Plan& plan_;
  std::vector<Node> nodes_;
  std::unordered_map<const void*, std::size_t> index_;
  std::unordered_map<Index, std::vector<Way>> out_of_;
  std::vector<State> state_;
};

/// Each level takes room on the thread's stack.
constexpr int kDeepest = 2000;

}  // namespace

void plan_triggers(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics) {
  TriggerGraph graph(blueprint, plan);
  const std::size_t before = diagnostics.error_count();
  graph.report_cycles(diagnostics);
  if (diagnostics.error_count() > before) return;
  const std::vector<int> depths = graph.depths();
  for (Index t = 0; t < plan.threads.size(); ++t) {
    plan.threads[t].depth += depths[t];
    if (depths[t] <= kDeepest) continue;
    diagnostics.error({},
                      "in the thread " + quoted(plan.threads[t].name) +
                          " handlers set each other off in a chain of " +
                          std::to_string(depths[t]) + "; at most " + std::to_string(kDeepest) +
                          " may nest",
                      "give a component in the middle of the chain its own thread");
  }
}

}  // namespace armature::exec::internal
