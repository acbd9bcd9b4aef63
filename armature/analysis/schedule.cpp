// SPDX-License-Identifier: Apache-2.0
#include "armature/analysis/schedule.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <set>

#include "armature/analysis/internal/load_text.hpp"
#include "armature/document/document.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::analysis {

using namespace document;
namespace {

using exec::Index;
using exec::urgency;
using internal::percent_text;
using Cpus = std::set<int>;

constexpr double kDeadlineShare = 0.95;  // the kernel admits no more

/// Finds each thread's execution time and period.
class LoadFinder {
 public:
  LoadFinder(const exec::Blueprint& blueprint, const exec::Plan& plan,
             const ExecutionTimes& measured, base::Diagnostics& diagnostics)
      : blueprint_(blueprint), plan_(plan), measured_(measured), diagnostics_(diagnostics) {}

  ThreadLoad load_of(const exec::ThreadPlan& thread) {
    ThreadLoad load;
    load.name = thread.name;
    load.activity = thread.activity;
    const bool periodic = thread.activity.kind == exec::Activity::Kind::kPeriodic;
    load.period = periodic ? thread.activity.period : thread.trigger_period;
    const base::Duration declared = declared_cost(thread);
    const std::optional<base::Duration> measured = measured_cost(thread);
    if (declared > base::Duration::zero()) {
      load.cost = declared;
      load.source = ThreadLoad::Source::kDeclared;
      if (measured && *measured > declared) warn_of_budget(thread, declared, *measured);
    } else if (measured) {
      load.cost = *measured;
      load.source = ThreadLoad::Source::kMeasured;
    }
    return load;
  }

 private:
  /// A deadline thread's budget is all it gets; elsewhere every component has its own.
  base::Duration declared_cost(const exec::ThreadPlan& thread) const {
    if (thread.activity.scheduler == exec::Activity::Scheduler::kDeadline) {
      return thread.activity.budget;
    }
    return most_of_modes([&](exec::ModeSet mode) {
      base::Duration sum{};
      for (const Index member : thread.members) {
        if (runs_in(mode, member)) sum += blueprint_.components[member].activity.budget;
      }
      return sum;
    });
  }

  /// What modes switch lives in one thread, so that no two threads need their most in different
  /// modes.
  template <typename Cost>
  base::Duration most_of_modes(const Cost& cost) const {
    base::Duration most{};
    for (std::size_t mode = 0; mode < std::max<std::size_t>(1, plan_.modes.size()); ++mode) {
      most = std::max(most, cost(exec::ModeSet{1} << mode));
    }
    return most;
  }
  bool runs_in(exec::ModeSet mode, Index component) const {
    return (plan_.modes_of[component] & mode) != 0;
  }

  /// The thread's, or else the sum of its components' if they were measured in other threads.
  std::optional<base::Duration> measured_cost(const exec::ThreadPlan& thread) const {
    const auto whole = measured_.threads.find(thread.name);
    if (whole != measured_.threads.end()) return whole->second.p999;
    const auto measured = [&](Index member) {
      return measured_.components.find(blueprint_.components[member].component->name());
    };
    for (const Index member : thread.members) {
      if (measured(member) == measured_.components.end()) return std::nullopt;
    }
    return most_of_modes([&](exec::ModeSet mode) {
      base::Duration sum{};
      for (const Index member : thread.members) {
        if (runs_in(mode, member)) sum += measured(member)->second.p999;
      }
      return sum;
    });
  }

  void warn_of_budget(const exec::ThreadPlan& thread, base::Duration declared,
                      base::Duration measured) {
    diagnostics_.named_warning(
        "budget_exceeded", blueprint_.components[thread.members.front()].where,
        "thread " + in_quotes(thread.name) + " declares a budget of " + to_text(declared) +
            ", but took " + to_text(measured) + " when it was measured");
  }

  const exec::Blueprint& blueprint_;
  const exec::Plan& plan_;
  const ExecutionTimes& measured_;
  base::Diagnostics& diagnostics_;
};

/// Can the threads meet their periods? Everything here knows its load.
class LoadChecker {
 public:
  struct Task {
    ThreadLoad* load;
    Cpus cpus;
    base::Location where;
  };

  LoadChecker(std::vector<Task> tasks, int cpus, base::Diagnostics& diagnostics)
      : tasks_(std::move(tasks)), diagnostics_(diagnostics) {
    for (int cpu = 0; cpu < cpus; ++cpu) all_cpus_.insert(cpu);
    for (Task& task : tasks_) {
      task.cpus = {task.load->activity.cpus.begin(), task.load->activity.cpus.end()};
      if (task.cpus.empty()) task.cpus = all_cpus_;
    }
  }

  void check() {
    std::set<Cpus> groups = {all_cpus_};
    for (const Task& task : tasks_) groups.insert(task.cpus);
    for (const Cpus& group : groups) {
      check_utilisation(group, "", 1.0, [](const ThreadLoad&) { return true; });
      check_utilisation(group, " scheduled by deadline", kDeadlineShare,
                        [](const ThreadLoad& load) {
                          return load.activity.scheduler == exec::Activity::Scheduler::kDeadline;
                        });
    }
    for (const Task& task : tasks_) find_response(task);
  }

 private:
  /// The threads that can run nowhere else must fit.
  template <typename Chosen>
  void check_utilisation(const Cpus& group, const std::string& which, double share,
                         const Chosen& chosen) {
    double sum = 0.0;
    std::string parts;
    const Task* heaviest = nullptr;
    for (const Task& task : tasks_) {
      const bool only_here =
          std::includes(group.begin(), group.end(), task.cpus.begin(), task.cpus.end());
      if (!only_here || !chosen(*task.load)) continue;
      const double part = task.load->utilisation();
      sum += part;
      parts += (parts.empty() ? "" : ", ") + task.load->name + " " + percent_text(part);
      if (heaviest == nullptr || part > heaviest->load->utilisation()) heaviest = &task;
    }
    const double most = share * static_cast<double>(group.size());
    if (sum <= most) return;
    diagnostics_.error(heaviest->where,
                       "the threads" + which + " on " + internal::cpus_text(group, all_cpus_) +
                           " need " + percent_text(sum) + " of a CPU, but have " +
                           percent_text(most) + ": " + parts,
                       "give them longer periods, shorter execution times or more CPUs");
  }

  void find_response(const Task& task) {
    ThreadLoad& load = *task.load;
    if (load.activity.scheduler == exec::Activity::Scheduler::kDeadline)
      load.response = load.period;
    if (load.activity.scheduler != exec::Activity::Scheduler::kRealtime) return;
    load.response = response_of(task);
    if (load.response <= load.period) return;
    const std::string text = "thread " + in_quotes(load.name) + " (priority " +
                             std::to_string(load.activity.priority) + ") answers within " +
                             to_text(load.response) + " at worst, but its period is " +
                             to_text(load.period);
    const std::string others = names_of(rivals(task));
    const std::string hint =
        others.empty() ? "give it a longer period or a shorter execution time"
                       : "it waits for " + others +
                             "; give it a longer period, a higher priority or a CPU of its own";
    // Where a more urgent thread may run on another CPU, the bound is only an upper one.
    if (exact(task)) {
      diagnostics_.error(task.where, text, hint);
    } else {
      diagnostics_.named_warning("late_answer", task.where, text, hint);
    }
  }

  /// Those that may keep `task` from running, the equally urgent ones included.
  std::vector<const Task*> rivals(const Task& task) const {
    std::vector<const Task*> found;
    for (const Task& other : tasks_) {
      const bool meets = std::any_of(other.cpus.begin(), other.cpus.end(),
                                     [&](int cpu) { return task.cpus.count(cpu) > 0; });
      const bool urgent = urgency(other.load->activity) >= urgency(task.load->activity);
      if (&other != &task && meets && urgent) found.push_back(&other);
    }
    return found;
  }

  bool exact(const Task& task) const {
    const std::vector<const Task*> others = rivals(task);
    return task.cpus.size() == 1 &&
           std::all_of(others.begin(), others.end(),
                       [&](const Task* other) { return other->cpus == task.cpus; });
  }

  /// The usual fixed point (Joseph and Pandya), for several CPUs with what is left over from the
  /// cycle before (Andersson); stops once it is past the period.
  base::Duration response_of(const Task& task) const {
    const base::Duration own = task.load->cost;
    const std::vector<const Task*> others = rivals(task);
    const auto cpus = static_cast<base::Duration::rep>(task.cpus.size());
    if (static_cast<base::Duration::rep>(others.size()) < cpus) return own;
    base::Duration response = own;
    while (true) {
      base::Duration interference{};
      for (const Task* other : others) {
        interference += interference_of(*other, task, response);
        if (cpus > 1) interference += other->load->cost;
      }
      const base::Duration next = own + interference / cpus;
      if (next == response || next > task.load->period) return next;
      response = next;
    }
  }

  /// A thread of the same priority is not interrupted, so it can only have been there before.
  static base::Duration interference_of(const Task& other, const Task& task,
                                        base::Duration within) {
    const ThreadLoad& load = *other.load;
    const bool equal = urgency(load.activity) == urgency(task.load->activity);
    const auto releases = equal ? 1 : (within + load.period - base::Duration(1)) / load.period;
    return releases * load.cost;
  }

  static std::string names_of(const std::vector<const Task*>& tasks) {
    std::string names;
    for (const Task* task : tasks) {
      names += (names.empty() ? "" : ", ") + in_quotes(task->load->name);
    }
    return names;
  }

  std::vector<Task> tasks_;
  Cpus all_cpus_;
  base::Diagnostics& diagnostics_;
};

/// It may be checked on another machine than the one it is to run on, so this is no error.
void warn_of_missing_cpus(const exec::ThreadPlan& thread, const base::Location& where, int cpus,
                          base::Diagnostics& diagnostics) {
  for (const int cpu : thread.activity.cpus) {
    if (cpu < cpus) continue;
    diagnostics.named_warning("missing_cpu", where,
                              "thread " + in_quotes(thread.name) + " is to run on CPU " +
                                  std::to_string(cpu) + ", but this machine has CPUs 0 to " +
                                  std::to_string(cpus - 1));
  }
}

/// Where some times are known, the others are missed; where none is, nobody asked.
void note_unknown(const std::vector<ThreadLoad>& threads, base::Diagnostics& diagnostics) {
  std::string unknown;
  bool any_known = false;
  for (const ThreadLoad& load : threads) {
    any_known = any_known || load.known();
    if (!load.known()) unknown += (unknown.empty() ? "" : ", ") + load.name;
  }
  if (!any_known || unknown.empty()) return;
  diagnostics.note({}, "the load of these threads is unknown and was not checked: " + unknown,
                   "declare budget: in their activities, or measure with armature run --times");
}

}  // namespace

double Schedule::utilisation() const {
  return std::accumulate(
      threads.begin(), threads.end(), 0.0,
      [](double sum, const ThreadLoad& load) { return sum + load.utilisation(); });
}

Schedule check_schedule(const exec::Blueprint& blueprint, const exec::Plan& plan,
                        const ExecutionTimes& measured, int cpus, base::Diagnostics& diagnostics) {
  Schedule schedule;
  schedule.cpus = cpus;
  schedule.threads.reserve(plan.threads.size());
  std::vector<LoadChecker::Task> tasks;
  LoadFinder finder(blueprint, plan, measured, diagnostics);
  for (const exec::ThreadPlan& thread : plan.threads) {
    if (thread.members.empty()) continue;
    schedule.threads.push_back(finder.load_of(thread));
    ThreadLoad& load = schedule.threads.back();
    const Index first = thread.updating.empty() ? thread.members[0] : thread.updating[0];
    warn_of_missing_cpus(thread, blueprint.components[first].where, cpus, diagnostics);
    if (load.known()) tasks.push_back({&load, {}, blueprint.components[first].where});
  }
  note_unknown(schedule.threads, diagnostics);
  LoadChecker(std::move(tasks), cpus, diagnostics).check();
  return schedule;
}

}  // namespace armature::analysis
