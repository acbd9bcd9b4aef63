// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/internal/statuses.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "armature/base/seconds.hpp"
#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/exec/modes.hpp"
#include "armature/platform/clock.hpp"

namespace armature::inspect::internal {
namespace {

using component::Component;

double microseconds(double ns) { return ns / 1000.0; }

ThreadStatus status_of(const exec::ThreadStatistics& thread, const exec::ThreadPlan& plan) {
  ThreadStatus status;
  status.name = plan.name;
  status.activity = activity_text(plan.activity);
  status.components = plan.members.size();
  status.cycles = thread.cycles_run;
  status.skipped = thread.cycles_skipped;
  status.log_lines_dropped = thread.log_lines_dropped;
  if (thread.cycles_run == 0) return status;
  const double tick_us = microseconds(platform::tick_period_ns());
  status.cycle_median_us = static_cast<double>(thread.cycle_ticks.percentile(0.5)) * tick_us;
  status.cycle_high_us = static_cast<double>(thread.cycle_ticks.percentile(0.999)) * tick_us;
  status.cycle_most_us = static_cast<double>(thread.cycle_ticks.most) * tick_us;
  const auto period = static_cast<double>(plan.activity.period.count());
  if (period > 0.0) {
    status.load_percent = 100.0 * thread.cycle_ticks.mean() * tick_us / microseconds(period);
  }
  status.latency_median_us = microseconds(static_cast<double>(thread.latency_ns.percentile(0.5)));
  status.latency_most_us = microseconds(static_cast<double>(thread.latency_ns.most));
  return status;
}

bool is_simulated(const exec::Application& application) {
  const auto& components = application.blueprint().components;
  return !components.empty() && component::Host::context(*components.front().component).simulated;
}

/// The present one; empty if there are none.
std::string mode_of(exec::Application& application) {
  if (application.plan().modes.empty()) return {};
  const auto mode = application.value_of(exec::kModesName, "mode");
  return mode ? mode.value().text() : std::string();
}

std::size_t index_of(const exec::Application& application, const Component& component) {
  const auto& all = application.blueprint().components;
  const auto found = std::find_if(all.begin(), all.end(), [&](const exec::ComponentEntry& entry) {
    return entry.component.get() == &component;
  });
  return static_cast<std::size_t>(found - all.begin());
}

/// Why components of one thread are as they are, which that thread knows.
std::vector<std::string> reasons_of(exec::Application& application,
                                    const std::vector<Component*>& components) {
  const auto reasons = std::make_shared<std::vector<std::string>>();
  const bool answered = application.run_in_thread_of(*components.front(), [reasons, components] {
    for (const Component* const one : components) reasons->emplace_back(one->reason());
  });
  if (answered) return *reasons;
  return std::vector<std::string>(components.size(), "its thread does not answer");
}

}  // namespace

std::string activity_text(const exec::Activity& activity) {
  if (activity.kind != exec::Activity::Kind::kPeriodic) {
    return std::string(exec::name_of(activity.kind));
  }
  char text[40];
  std::snprintf(text, sizeof text, "every %g ms", 1000.0 * base::to_seconds(activity.period));
  return text;
}

const exec::ThreadPlan& thread_of(const exec::Application& application,
                                  const Component& component) {
  const exec::Plan& plan = application.plan();
  return plan.threads[plan.thread_of[index_of(application, component)]];
}

ApplicationStatus status_of(exec::Application& application) {
  ApplicationStatus status;
  status.name = application.blueprint().name;
  status.time = application.now();
  status.simulated = is_simulated(application);
  status.mode = mode_of(application);
  status.faults = application.faults();
  status.reactions = application.reactions();
  const std::vector<exec::ThreadStatistics> threads = application.thread_statistics();
  for (std::size_t i = 0; i < threads.size(); ++i) {
    const exec::ThreadPlan& plan = application.plan().threads[i];
    if (!plan.members.empty()) status.threads.push_back(status_of(threads[i], plan));
  }
  return status;
}

ComponentStatus status_without_reason(const exec::Application& application,
                                      const Component& component) {
  const std::size_t index = index_of(application, component);
  const exec::ComponentEntry& entry = application.blueprint().components[index];
  const std::vector<exec::Index>& order = application.plan().start_order;
  ComponentStatus status;
  status.name = component.name();
  status.model = entry.model;
  status.state = component.state();
  status.thread = application.plan().threads[application.plan().thread_of[index]].name;
  status.autostart = entry.autostart;
  status.start_order =
      static_cast<int>(std::find(order.begin(), order.end(), index) - order.begin());
  return status;
}

std::vector<ComponentStatus> statuses_of(exec::Application& application,
                                         const std::vector<Component*>& components) {
  std::vector<ComponentStatus> all;
  std::map<const component::ExecutionContext*, std::vector<std::size_t>> resting;
  for (std::size_t i = 0; i < components.size(); ++i) {
    all.push_back(status_without_reason(application, *components[i]));
    const bool runs = all.back().state == component::State::kRunning;
    if (!runs) resting[&component::Host::context(*components[i])].push_back(i);
  }
  for (const auto& [context, indices] : resting) {
    std::vector<Component*> asked;
    for (const std::size_t i : indices) asked.push_back(components[i]);
    const std::vector<std::string> reasons = reasons_of(application, asked);
    for (std::size_t k = 0; k < indices.size(); ++k) all[indices[k]].reason = reasons[k];
  }
  return all;
}

}  // namespace armature::inspect::internal
