// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/engines.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace armature::exec::internal {
namespace {

/// A measured cycle takes longer, that of a thousand components several times as long. The number
/// is odd, so that cycles which differ by turns are all measured.
std::uint64_t usual_measuring(const ThreadPlan& thread) {
  constexpr base::Duration kInterval = std::chrono::milliseconds(250);
  const base::Duration period = std::max(thread.activity.period, thread.trigger_period);
  const bool known = period > base::Duration::zero();
  return static_cast<std::uint64_t>(known ? kInterval / period : 250) | 1u;
}

/// Of calls and of the end, which nobody else may wait for longer.
constexpr base::Duration kLongestWait = std::chrono::milliseconds(100);

/// Who drives is not to spend time on waking those who only look on. They run as often as all that
/// could send them anything, so that no queue of theirs fills up.
bool may_sleep_through(const ThreadPlan& thread, const Blueprint& blueprint, const Plan& plan) {
  const auto is_shadow = [&](Index member) { return blueprint.components[member].shadow; };
  const base::Duration period = thread.activity.period;
  return thread.activity.kind == Activity::Kind::kPeriodic && period <= kLongestWait &&
         std::ranges::all_of(thread.members, is_shadow) &&
         std::ranges::all_of(plan.threads, [&](const ThreadPlan& other) {
           return other.activity.kind != Activity::Kind::kPeriodic ||
                  period <= other.activity.period;
         });
}

std::unique_ptr<Engine> engine_of(const ThreadPlan& thread, const Blueprint& blueprint) {
  std::vector<component::Component*> members;
  std::vector<component::Component*> updating;
  for (const Index member : thread.members) {
    members.push_back(blueprint.components[member].component.get());
  }
  const bool periodic = thread.activity.kind == Activity::Kind::kPeriodic;
  for (const Index each : thread.updating) {
    if (periodic) updating.push_back(blueprint.components[each].component.get());
  }
  return std::make_unique<Engine>(thread.name, thread.activity, std::move(members),
                                  std::move(updating));
}

}  // namespace

Engines make_engines(const Blueprint& blueprint, const Plan& plan, const EngineSettings& settings) {
  Engines engines;
  for (const ThreadPlan& thread : plan.threads) {
    Engine& engine = *engines.emplace_back(engine_of(thread, blueprint));
    const std::uint64_t often = settings.measure_every;
    engine.measure_every(often != 0 ? often : usual_measuring(thread));
    if (may_sleep_through(thread, blueprint, plan)) engine.sleep_through();
    component::ExecutionContext& context = engine.context();
    context.limit_depth(thread.depth + component::kLeastDepthLimit);
    context.supervisor = settings.supervisor;
    context.simulated = settings.simulated;
    context.real_time = thread.activity.scheduler != Activity::Scheduler::kOther;
    context.cycle_time = settings.now;
  }
  return engines;
}

std::vector<Engine*> pointers_to(const Engines& engines) {
  std::vector<Engine*> pointers;
  for (const auto& engine : engines) pointers.push_back(engine.get());
  return pointers;
}

}  // namespace armature::exec::internal
