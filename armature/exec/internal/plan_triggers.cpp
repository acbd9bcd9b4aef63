// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "armature/exec/internal/grouped.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

/// The handlers of an application and which of them may set off which other in the same thread.
/// Handlers of a component that lead to the same are one kind, such as those of an array of ports;
/// the search goes over kinds, so that its effort grows with the wiring and not with its square.
class TriggerGraph {
 public:
  /// @param modes  those that count; what does not run in one of them sets nobody off
  TriggerGraph(const Blueprint& blueprint, const Plan& plan, ModeSet modes)
      : blueprint_(blueprint),
        plan_(plan),
        modes_(modes),
        first_kind_(blueprint.components.size(), kNone) {
    kinds_.reserve(2 * blueprint.components.size());
    // All kinds first: which of them a way begins at is known only then.
    std::vector<Handler> handlers;
    handlers.reserve(plan.connections.size() + plan.subscriptions.size());
    for (const ConnectionPlan& connection : plan.connections) {
      const component::InputPortBase& input = *connection.input;
      handlers.push_back(connection.triggers ? handler_of(input, connection.to) : Handler{});
    }
    for (const SubscriptionPlan& subscription : plan.subscriptions) {
      handlers.push_back(handler_of(*subscription.handler, subscription.to));
    }
    ways_ = Grouped<Way>(kinds_.size());
    auto handler = handlers.begin();
    for (const ConnectionPlan& connection : plan.connections) {
      const Handler& to = *handler++;
      if (!runs_within_the_write(connection)) continue;
      add_way(connection.from, *connection.output,
              {to, &connection.entry->where, is_periodic(connection.to)});
    }
    for (const SubscriptionPlan& subscription : plan.subscriptions) {
      const Handler& to = *handler++;
      if (!same_thread(subscription.from, subscription.to) ||
          !both_run(subscription.from, subscription.to)) {
        continue;
      }
      add_way(subscription.from, *subscription.event,
              {to, &blueprint.components[subscription.to].where, false});
    }
    ways_.close();
  }

  void report_cycles(base::Diagnostics& diagnostics) {
    for (std::size_t start = 0; start < kinds_.size(); ++start) {
      if (kinds_[start].state == State::kUnseen) search(start, diagnostics);
    }
  }

  /// How deep handlers nest in each thread; to be asked if there are no cycles.
  std::vector<int> depths() const {
    std::vector<int> depths(plan_.threads.size(), 0);
    for (const Kind& kind : kinds_) {
      int& depth = depths[plan_.thread_of[kind.component]];
      depth = std::max(depth, kind.depth);
    }
    return depths;
  }

 private:
  enum class State { kUnseen, kOpen, kDone };
  struct Handler {
    const component::Entrance* entrance = nullptr;
    std::size_t kind = 0;
  };
  struct Way {
    Handler to;
    const base::Location* where = nullptr;
    bool ends_by_delay = false;
  };
  struct Kind {
    Index component;
    const component::LeadsTo* effects;
    std::size_t next;  ///< of the same component, or kNone
    State state = State::kUnseen;
    int depth = 1;  ///< of the handlers that it sets off, itself included
  };
  struct Visit {
    Handler handler;
    std::size_t next_way = 0;
  };

  template <typename Entry>
  Handler handler_of(const Entry& entry, Index component) {
    return {&entry, kind_of(component, entry.effects())};
  }

  std::size_t kind_of(Index component, const component::LeadsTo& effects) {
    for (std::size_t kind = first_kind_[component]; kind != kNone; kind = kinds_[kind].next) {
      if (*kinds_[kind].effects == effects) return kind;
    }
    kinds_.push_back({component, &effects, first_kind_[component]});
    return first_kind_[component] = kinds_.size() - 1;
  }

  /// @param through  output port or event of `from`
  template <typename Member>
  void add_way(Index from, const Member& through, const Way& way) {
    for (std::size_t kind = first_kind_[from]; kind != kNone; kind = kinds_[kind].next) {
      if (kinds_[kind].effects->includes(through.name())) ways_.add(kind, way);
    }
  }

  /// A delayed value is not handled before the next cycle; but in a triggered thread that follows
  /// at once, so that the delay does not end a cycle of handlers.
  bool runs_within_the_write(const ConnectionPlan& connection) const {
    if (!connection.triggers || !same_thread(connection.from, connection.to)) return false;
    if (!both_run(connection.from, connection.to)) return false;
    return !connection.delayed || !is_periodic(connection.to);
  }

  bool both_run(Index a, Index b) const {
    return (plan_.modes_of[a] & plan_.modes_of[b] & modes_) != 0;
  }

  bool is_periodic(Index component) const {
    const ThreadPlan& thread = plan_.threads[plan_.thread_of[component]];
    return thread.activity.kind == Activity::Kind::kPeriodic;
  }

  bool same_thread(Index a, Index b) const { return plan_.thread_of[a] == plan_.thread_of[b]; }

  void search(std::size_t start, base::Diagnostics& diagnostics) {
    std::vector<Visit> path{{{{}, start}}};
    kinds_[start].state = State::kOpen;
    while (!path.empty()) {
      Visit& visit = path.back();
      Kind& here = kinds_[visit.handler.kind];
      const auto ways = ways_[visit.handler.kind];
      if (visit.next_way == ways.size()) {
        here.state = State::kDone;
        const int depth = here.depth + 1;
        path.pop_back();
        if (!path.empty()) deepen(kinds_[path.back().handler.kind], depth);
        continue;
      }
      const Way& way = ways[visit.next_way++];
      Kind& next = kinds_[way.to.kind];
      if (next.state == State::kOpen) report(path, way, diagnostics);
      if (next.state == State::kDone) deepen(here, next.depth + 1);
      if (next.state != State::kUnseen) continue;
      next.state = State::kOpen;
      path.push_back({way.to});
    }
  }

  static void deepen(Kind& kind, int depth) { kind.depth = std::max(kind.depth, depth); }

  /// The way leads back to a kind of handler that is on the path.
  void report(const std::vector<Visit>& path, const Way& back, base::Diagnostics& diagnostics) {
    std::string text = path_of(back.to);
    bool inside = false;
    bool delay_helps = false;
    ModeSet modes = plan_.modes_of[kinds_[back.to.kind].component];
    for (const Visit& visit : path) {
      if (inside) text += " -> " + path_of(visit.handler);
      inside = inside || visit.handler.kind == back.to.kind;
      if (inside) modes &= plan_.modes_of[kinds_[visit.handler.kind].component];
      delay_helps = delay_helps || (inside && way_taken(visit).ends_by_delay);
    }
    diagnostics.error(
        *back.where,
        "handlers may set each other off without end" + in_modes(plan_, modes) + ": " + text +
            " -> " + path_of(back.to),
        std::string("declare ") +
            (delay_helps ? "delay: one_cycle on one of these connections, or " : "") +
            "leads_to(...) where a handler does not write all outputs of its component");
  }

  const Way& way_taken(const Visit& visit) const {
    return ways_[visit.handler.kind][visit.next_way - 1];
  }

  std::string path_of(const Handler& handler) const {
    const Index component = kinds_[handler.kind].component;
    return blueprint_.components[component].component->name() + "." +
           std::string(handler.entrance->handler());
  }

  const Blueprint& blueprint_;
  const Plan& plan_;
  const ModeSet modes_;
  std::vector<Kind> kinds_;
  Grouped<Way> ways_{0};                 ///< of each kind
  std::vector<std::size_t> first_kind_;  ///< of each component, or kNone
};

/// Each level takes room on the thread's stack.
constexpr int kDeepest = 2000;

}  // namespace

void plan_triggers(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics) {
  std::vector<int> depths(plan.threads.size(), 0);
  std::set<std::string> told;
  for (std::size_t mode = 0; mode < std::max<std::size_t>(1, plan.modes.size()); ++mode) {
    TriggerGraph graph(blueprint, plan, plan.modes.empty() ? ~ModeSet{0} : ModeSet{1} << mode);
    base::Diagnostics found;
    graph.report_cycles(found);
    for (const base::Diagnostic& each : found.all()) {
      if (told.insert(each.message).second) diagnostics.error(each.where, each.message, each.hint);
    }
    if (!found.ok()) continue;
    const std::vector<int> here = graph.depths();
    for (Index t = 0; t < depths.size(); ++t) depths[t] = std::max(depths[t], here[t]);
  }
  if (!told.empty()) return;
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
