// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/timeline_pump.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "armature/platform/clock.hpp"

namespace armature::exec::internal {
namespace {

/// What is kept until the controlling thread, which may be held up, looks again.
constexpr base::Duration kPatience = std::chrono::milliseconds(250);
constexpr std::size_t kMostEntries = 1u << 16;

/// A simulated application takes no harm if much is written at once.
constexpr base::Duration kBurst = std::chrono::milliseconds(1);
constexpr base::Duration kSimulatedBurst = std::chrono::milliseconds(250);

constexpr std::size_t kFewestEntries = 1024;

/// Entries of a cycle in which everything happens twice: each handler that runs is a step, and
/// so is what its caller goes on with.
std::vector<std::size_t> entries_of_a_cycle(const Plan& plan) {
  std::vector<std::size_t> handlers(plan.threads.size());
  for (std::size_t t = 0; t < plan.threads.size(); ++t) {
    handlers[t] += plan.threads[t].members.size();
  }
  for (const ConnectionPlan& each : plan.connections) ++handlers[plan.thread_of[each.to]];
  for (const SubscriptionPlan& each : plan.subscriptions) ++handlers[plan.thread_of[each.to]];
  for (const CallPlan& each : plan.calls) ++handlers[plan.thread_of[each.caller]];
  for (std::size_t& each : handlers) each = 2 * (2 * each + 2);
  return handlers;
}

std::size_t capacity_for(std::size_t cycle, const ThreadPlan& thread) {
  constexpr base::Duration kUsualPeriod = std::chrono::milliseconds(1);
  const base::Duration known = std::max(thread.activity.period, thread.trigger_period);
  const base::Duration period = known > base::Duration::zero() ? known : kUsualPeriod;
  const std::size_t cycles = static_cast<std::size_t>(kPatience / period) + 1;
  return std::clamp(cycle * cycles, kFewestEntries, std::max(kMostEntries, cycle));
}

}  // namespace

void TimelinePump::set_engines(const std::vector<Engine*>& engines, const Plan& plan,
                               bool simulated) {
  engines_ = engines;
  sources_.clear();
  if (!options_.sink) return;
  tick_ns_ = platform::tick_period_ns();
  const std::vector<std::size_t> entries = entries_of_a_cycle(plan);
  if (simulated) {
    const std::size_t all = std::reduce(entries.begin(), entries.end());
    add_source({std::max(2 * all, kFewestEntries), options_.share, kSimulatedBurst});
  }
  for (std::size_t i = 0; i < engines.size(); ++i) {
    if (!simulated) {
      add_source({capacity_for(entries[i], plan.threads[i]), options_.share, kBurst});
    }
    engines[i]->keep_timeline(sources_.back().timeline, static_cast<std::uint16_t>(i));
  }
}

void TimelinePump::add_source(const component::Timeline::Limits& limits) {
  Source source;
  source.timeline = std::make_shared<component::Timeline>(limits);
  sources_.push_back(std::move(source));
}

void TimelinePump::drain() {
  for (Source& source : sources_) drain(source);
}

void TimelinePump::drain_if_half_full() {
  for (Source& source : sources_) {
    component::Timeline& timeline = *source.timeline;
    if (timeline.pushed() - source.taken < timeline.capacity() / 2) continue;
    const std::uint64_t begun = platform::ticks();
    drain(source);
    timeline.spend(platform::ticks() - begun);
  }
}

void TimelinePump::drain(Source& source) {
  while (const Entry* entry = source.timeline->pop()) take(source, *entry);
  tell_losses(source);
}

void TimelinePump::take(Source& source, const Entry& entry) {
  ++source.taken;
  switch (entry.kind) {
    case Entry::Kind::kOpen:
      if (std::exchange(source.open, true)) source.cut_off += 1 + source.steps.size();
      source.opened = entry;
      source.steps.clear();
      break;
    case Entry::Kind::kStep:
      source.steps.push_back(entry);
      break;
    case Entry::Kind::kClose:
      if (std::exchange(source.open, false)) tell_stretch(source, entry);
      break;
  }
}

/// Times are counted from when the thread woke up, or from the end of the stretch before: that of
/// the thread, and in simulated time, where threads take turns at one instant, that of any.
void TimelinePump::tell_stretch(Source& source, const Entry& closed) {
  const std::uint64_t first = source.opened.begin;
  const base::Time begin = std::max(source.opened.time, source.done);
  const auto at = [&](std::uint64_t tick) {
    return begin + base::Duration(std::llround(static_cast<double>(tick - first) * tick_ns_));
  };
  source.done = at(closed.end);
  TimelineSlice slice = slice_of(source);
  slice.kind = closed.cycle ? TimelineSlice::Kind::kCycle : TimelineSlice::Kind::kMessages;
  slice.begin = begin;
  slice.length = source.done - begin;
  slice.cycle = closed.begin;
  slice.cycle_time = closed.time;
  slice.detailed = closed.detailed;
  slice.missing = source.opened.missing;
  tell(slice);
  slice.kind = TimelineSlice::Kind::kStep;
  slice.missing = 0;
  for (const Entry& step : source.steps) {
    slice.component = step.component->name();
    slice.begin = at(step.begin);
    slice.length = at(step.end) - slice.begin;
    tell(slice);
  }
}

void TimelinePump::tell_losses(Source& source) {
  const std::uint64_t lost = source.timeline->dropped() + source.cut_off;
  const std::uint64_t before = std::exchange(source.told_losses, lost);
  if (lost == before) return;
  TimelineSlice slice = slice_of(source);
  slice.kind = TimelineSlice::Kind::kLost;
  slice.begin = source.done;
  slice.missing = lost - before;
  tell(slice);
}

TimelineSlice TimelinePump::slice_of(const Source& source) const {
  TimelineSlice slice;
  slice.thread = source.opened.thread;
  slice.thread_name = engines_[slice.thread]->context().name;
  return slice;
}

void TimelinePump::tell(const TimelineSlice& slice) noexcept {
  if (!options_.sink) return;
  try {
    options_.sink(slice);
  } catch (...) {
    options_.sink = nullptr;
  }
}

}  // namespace armature::exec::internal
