// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <deque>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "armature/exec/internal/grouped.hpp"
#include "armature/exec/internal/wiring.hpp"
#include "armature/exec/modes.hpp"

namespace armature::exec::internal {
namespace {

class ThreadPlanner {
 public:
  ThreadPlanner(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics)
      : blueprint_(blueprint),
        plan_(plan),
        diagnostics_(diagnostics),
        triggered_by_(blueprint.components.size()),
        called_or_triggered_by_(blueprint.components.size()) {}

  void run() {
    plan_.thread_of.assign(blueprint_.components.size(), kNone);
    for (Index i = 0; i < blueprint_.components.size(); ++i) {
      const ComponentEntry& entry = blueprint_.components[i];
      check_activity(entry);
      if (entry.activity.owns_thread()) plan_.thread_of[i] = own_thread(i, entry);
    }
    check_thread_names();
    ThreadPlan service;
    service.name = "service";
    service.activity.kind = Activity::Kind::kTriggered;
    plan_.threads.push_back(service);
    find_edges();
    // A sequential component runs in the most urgent thread that triggers it; one that nobody
    // triggers runs in the most urgent thread that calls it.
    spread(triggered_by_);
    spread(called_or_triggered_by_);
    seat_modes();
    for (Index& thread : plan_.thread_of) {
      if (thread == kNone) thread = plan_.service_thread();
    }
    find_trigger_periods();
  }

 private:
  using Edges = Grouped<Index>;

  void check_activity(const ComponentEntry& entry) {
    const Activity& activity = entry.activity;
    const std::string who = "the activity of " + quoted(entry.component->name());
    if (activity.kind == Activity::Kind::kPeriodic && activity.period <= base::Duration::zero()) {
      diagnostics_.error(entry.where, who + " needs a period above 0");
    }
    const bool realtime = activity.scheduler == Activity::Scheduler::kRealtime;
    if (realtime && activity.priority == 0) {
      diagnostics_.error(entry.where, who + " is scheduled in real time and needs a priority",
                         "give it one, priority: 1..99, 99 is the most urgent");
    } else if (realtime && (activity.priority < 1 || activity.priority > 99)) {
      diagnostics_.error(entry.where, who + " has the priority " +
                                          std::to_string(activity.priority) +
                                          "; real-time priorities are 1 .. 99, 99 most urgent");
    }
    const bool deadline = activity.scheduler == Activity::Scheduler::kDeadline;
    if (deadline && activity.kind != Activity::Kind::kPeriodic) {
      diagnostics_.error(entry.where, who + " is scheduled by deadline but not periodic",
                         "give it a period, or the scheduler realtime with a priority");
    }
    if (deadline && activity.budget <= base::Duration::zero()) {
      diagnostics_.error(entry.where, who + " is scheduled by deadline and needs a budget",
                         "declare the execution time of a cycle: budget: 200 us");
    }
    if (activity.budget > activity.period && activity.period > base::Duration::zero()) {
      diagnostics_.error(entry.where, who + " has a budget above its period",
                         "give it a shorter budget or a longer period");
    }
  }

  Index own_thread(Index component, const ComponentEntry& entry) {
    const std::string& shared = entry.activity.thread;
    if (!shared.empty()) {
      const auto known = shared_threads_.find(shared);
      if (known != shared_threads_.end()) return join(known->second, component, entry);
      shared_threads_.emplace(shared, plan_.threads.size());
    }
    ThreadPlan thread;
    thread.name = shared.empty() ? entry.component->name() : shared;
    thread.activity = entry.activity;
    thread.updating.push_back(component);
    plan_.threads.push_back(std::move(thread));
    return plan_.threads.size() - 1;
  }

  Index join(Index thread, Index component, const ComponentEntry& entry) {
    ThreadPlan& shared = plan_.threads[thread];
    const std::string differences = differences_of(shared.activity, entry.activity);
    if (!differences.empty()) {
      const component::Component& other = *blueprint_.components[shared.updating[0]].component;
      diagnostics_.error(entry.where,
                         quoted(entry.component->name()) + " and " + quoted(other.name()) +
                             " share the thread " + quoted(shared.name) + ", but differ in " +
                             differences,
                         "give both the same, or each its own thread");
    }
    shared.activity.budget += entry.activity.budget;
    shared.updating.push_back(component);
    return thread;
  }

  static std::string differences_of(const Activity& a, const Activity& b) {
    const std::pair<const char*, bool> checks[] = {
        {"kind", a.kind == b.kind},
        {"period", a.period == b.period},
        {"scheduler", a.scheduler == b.scheduler},
        {"priority", a.priority == b.priority},
        {"CPUs", a.cpus == b.cpus},
        {"overrun", a.overrun == b.overrun && a.late_cycles_to_fault == b.late_cycles_to_fault}};
    std::string text;
    for (const auto& [what, same] : checks) {
      if (!same) text += (text.empty() ? "" : ", ") + std::string(what);
    }
    return text;
  }

  void check_thread_names() {
    for (const auto& [name, thread] : shared_threads_) {
      for (const ThreadPlan& other : plan_.threads) {
        if (other.name != name || &other == &plan_.threads[thread]) continue;
        const ComponentEntry& entry = blueprint_.components[plan_.threads[thread].updating[0]];
        diagnostics_.error(entry.where,
                           "the thread " + quoted(name) + " of " + quoted(entry.component->name()) +
                               " has the name of a component that has its own thread",
                           "give the shared thread another name");
      }
    }
  }

  void find_edges() {
    for (const ConnectionPlan& connection : plan_.connections) {
      if (connection.triggers) add_trigger(connection.from, connection.to);
    }
    for (const SubscriptionPlan& subscription : plan_.subscriptions) {
      add_trigger(subscription.from, subscription.to);
    }
    for (const CallPlan& call : plan_.calls) {
      called_or_triggered_by_.add(call.caller, call.callee);
    }
    triggered_by_.close();
    called_or_triggered_by_.close();
  }

  /// Modes are switched in the thread of what they switch.
  void seat_modes() {
    if (plan_.modes.empty()) return;
    Index switched = 0;
    while (switched < plan_.modes_of.size() && plan_.modes_of[switched] == ~ModeSet{0}) ++switched;
    for (Index i = 0; i < blueprint_.components.size(); ++i) {
      const bool is_modes = blueprint_.components[i].component->name() == kModesName;
      if (is_modes && switched < plan_.modes_of.size()) {
        plan_.thread_of[i] = plan_.thread_of[switched];
      }
    }
  }

  void add_trigger(Index from, Index to) {
    triggered_by_.add(from, to);
    called_or_triggered_by_.add(from, to);
  }

  /// Shadows run in the threads of shadows, whoever triggers them.
  bool crosses(Index from, Index to) const {
    return blueprint_.components[from].shadow != blueprint_.components[to].shadow;
  }

  /// Gives every unassigned component the most urgent thread that reaches it.
  void spread(const Edges& edges) {
    std::vector<Index> by_urgency;
    for (Index i = 0; i + 1 < plan_.threads.size(); ++i) by_urgency.push_back(i);
    std::stable_sort(by_urgency.begin(), by_urgency.end(), [this](Index a, Index b) {
      return urgency(plan_.threads[a].activity) > urgency(plan_.threads[b].activity);
    });
    std::vector<std::vector<Index>> already(plan_.threads.size());
    for (Index i = 0; i < plan_.thread_of.size(); ++i) {
      if (plan_.thread_of[i] != kNone) already[plan_.thread_of[i]].push_back(i);
    }
    for (const Index thread : by_urgency) {
      std::deque<Index> open(already[thread].begin(), already[thread].end());
      while (!open.empty()) {
        const Index from = open.front();
        open.pop_front();
        for (const Index to : edges[from]) {
          if (plan_.thread_of[to] != kNone || crosses(from, to)) continue;
          plan_.thread_of[to] = thread;
          open.push_back(to);
        }
      }
    }
  }

  /// A triggered thread runs as often as the fastest periodic thread whose triggers reach it.
  void find_trigger_periods() {
    std::vector<Index> periodic;
    for (Index i = 0; i < plan_.threads.size(); ++i) {
      if (plan_.threads[i].activity.kind == Activity::Kind::kPeriodic) periodic.push_back(i);
    }
    std::stable_sort(periodic.begin(), periodic.end(), [this](Index a, Index b) {
      return plan_.threads[a].activity.period < plan_.threads[b].activity.period;
    });
    std::vector<bool> reached(blueprint_.components.size(), false);
    for (const Index thread : periodic) {
      std::deque<Index> open(plan_.threads[thread].updating.begin(),
                             plan_.threads[thread].updating.end());
      while (!open.empty()) {
        const Index from = open.front();
        open.pop_front();
        for (const Index to : triggered_by_[from]) {
          if (reached[to]) continue;
          reached[to] = true;
          ThreadPlan& other = plan_.threads[plan_.thread_of[to]];
          const bool unknown = other.trigger_period == base::Duration::zero();
          if (other.activity.kind == Activity::Kind::kTriggered && unknown) {
            other.trigger_period = plan_.threads[thread].activity.period;
          }
          open.push_back(to);
        }
      }
    }
  }

  const Blueprint& blueprint_;
  Plan& plan_;
  base::Diagnostics& diagnostics_;
  std::unordered_map<std::string, Index> shared_threads_;
  Edges triggered_by_;            ///< from component: whom it triggers
  Edges called_or_triggered_by_;  ///< from component: whom it triggers or calls
};

}  // namespace

void plan_threads(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics) {
  ThreadPlanner(blueprint, plan, diagnostics).run();
}

void check_priorities(const Blueprint& blueprint, const Plan& plan,
                      base::Diagnostics& diagnostics) {
  for (const ConnectionPlan& connection : plan.connections) {
    const Activity& writer = plan.threads[plan.thread_of[connection.from]].activity;
    const bool urgent = writer.scheduler == Activity::Scheduler::kRealtime;
    if (!connection.triggers || !urgent || !plan.run_together(connection.from, connection.to)) {
      continue;
    }
    const Activity& reader = blueprint.components[connection.to].activity;
    const bool interrupts = reader.kind == Activity::Kind::kTriggered &&
                            reader.scheduler == Activity::Scheduler::kRealtime &&
                            reader.priority > writer.priority;
    if (!interrupts) continue;
    // It costs time and harms no data: a reader of another thread may run beside its writer anyway.
    diagnostics.named_warning(
        "priority_inversion", connection.entry->where,
        quoted(connection.entry->to_component) + " (priority " + std::to_string(reader.priority) +
            ") is triggered by " + quoted(connection.entry->from_component) + " (priority " +
            std::to_string(writer.priority) + ") but is more urgent: it interrupts its producer",
        "give the consumer at most the producer's priority");
  }
}

}  // namespace armature::exec::internal
