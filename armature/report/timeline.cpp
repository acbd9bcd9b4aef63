// SPDX-License-Identifier: Apache-2.0
#include "armature/report/timeline.hpp"

#include <algorithm>
#include <iterator>

namespace armature::report {
namespace {

void add_bar(const StepTrace::Event& step, double begin_us, const StepTrace& trace,
             Timeline& timeline) {
  auto lane = std::find_if(timeline.lanes.begin(), timeline.lanes.end(),
                           [&](const Timeline::Lane& each) { return each.component == step.name; });
  if (lane == timeline.lanes.end()) {
    const auto thread = trace.threads.find(step.thread);
    timeline.lanes.push_back(
        {step.name, thread == trace.threads.end() ? std::string() : thread->second, {}});
    lane = std::prev(timeline.lanes.end());
  }
  lane->bars.push_back({step.begin_us - begin_us, step.length_us});
  timeline.end_us = std::max(timeline.end_us, step.end_us() - begin_us);
}

Timeline timeline_of(const TracedCycle& traced, const StepTrace& trace) {
  const StepTrace::Event& cycle = traced.cycle;
  Timeline timeline;
  timeline.length_us = cycle.length_us;
  timeline.end_us = cycle.length_us;
  const double pause_us = (traced.next_us - cycle.begin_us) / 2.0;
  for (const StepTrace::Event& step : trace.steps_between(cycle.begin_us, traced.next_us)) {
    if (step.begin_us - cycle.begin_us > timeline.end_us + pause_us) break;
    add_bar(step, cycle.begin_us, trace, timeline);
  }
  return timeline;
}

}  // namespace

Timeline find_timeline(const StepTrace& trace) {
  const std::vector<TracedCycle> cycles = cycles_of_busiest(trace);
  std::vector<TracedCycle> candidates;
  std::ranges::copy_if(cycles, std::back_inserter(candidates), &TracedCycle::whole);
  if (candidates.empty()) return Timeline{};
  const auto middle = candidates.begin() + static_cast<std::ptrdiff_t>(candidates.size() / 2);
  std::ranges::nth_element(candidates, middle, {},
                           [](const TracedCycle& traced) { return traced.cycle.length_us; });
  Timeline timeline = timeline_of(*middle, trace);
  timeline.cycles = cycles.size();
  return timeline;
}

}  // namespace armature::report
