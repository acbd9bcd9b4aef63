// SPDX-License-Identifier: Apache-2.0
#include "armature/report/timeline.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "armature/report/internal/json.hpp"

namespace armature::report {
namespace {

struct Event {
  std::string name;
  double begin_us = 0.0;
  double length_us = 0.0;
  long long thread = 0;

  double end_us() const { return begin_us + length_us; }
};

struct Trace {
  std::vector<Event> steps;  ///< by their begin, as the next
  std::vector<Event> cycles;
  std::map<long long, std::string> threads;
};

/// The events, if there is a list of them; in a trace that was cut off, those that are whole.
Json events_of(const std::string& text) {
  Json document = Json::parse(text, nullptr, false);
  if (document.is_discarded()) {
    const std::size_t whole = text.rfind("},\n");
    if (whole != std::string::npos) {
      document = Json::parse(text.substr(0, whole + 1) + ']', nullptr, false);
    }
  }
  return document.is_object() && document.contains("traceEvents") ? document["traceEvents"]
                                                                  : document;
}

bool is_number(const Json& event, const char* field) {
  return event.contains(field) && event[field].is_number();
}

base::Result<void> add(const Json& event, Trace& trace) {
  const std::string kind = event.value("ph", "");
  const long long thread = is_number(event, "tid") ? event["tid"].get<long long>() : 0;
  if (kind == "M" && event.value("name", "") == "thread_name" && event.contains("args")) {
    trace.threads[thread] = event["args"].value("name", "");
  }
  if (kind != "X") return {};
  const std::string name = event.value("name", "");
  if (name.empty() || !is_number(event, "ts") || !is_number(event, "dur")) {
    return base::Error{"a complete event without name, ts or dur: " + event.dump()};
  }
  const Event one{name, event["ts"].get<double>(), event["dur"].get<double>(), thread};
  const std::string category = event.value("cat", "");
  if (category == "step") trace.steps.push_back(one);
  if (category == "cycle") trace.cycles.push_back(one);
  return {};
}

base::Result<Trace> parse_trace(const std::string& text) {
  const Json events = events_of(text);
  if (!events.is_array()) {
    return base::Error{
        "expected a trace of `armature run --trace`: a list of events, or an object "
        "with the list traceEvents"};
  }
  Trace trace;
  try {
    for (const Json& event : events) {
      if (auto added = add(event, trace); !added) return base::Error{added.error()};
    }
  } catch (const Json::exception& wrong) {
    return base::Error{std::string("a field of another type than expected: ") + wrong.what()};
  }
  const auto earlier = [](const Event& a, const Event& b) { return a.begin_us < b.begin_us; };
  std::stable_sort(trace.steps.begin(), trace.steps.end(), earlier);
  std::stable_sort(trace.cycles.begin(), trace.cycles.end(), earlier);
  return trace;
}

/// The cycles of the thread that had the most to do.
std::vector<Event> cycles_of_busiest(const Trace& trace) {
  std::map<long long, double> busy_us;
  for (const Event& step : trace.steps) busy_us[step.thread] += step.length_us;
  std::vector<Event> cycles;
  if (busy_us.empty()) return cycles;
  const auto busiest =
      std::max_element(busy_us.begin(), busy_us.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const Event& cycle : trace.cycles) {
    if (cycle.thread == busiest->first) cycles.push_back(cycle);
  }
  return cycles;
}

/// The first step that begins at `time_us` or later.
std::vector<Event>::const_iterator step_from(const Trace& trace, double time_us) {
  return std::lower_bound(trace.steps.begin(), trace.steps.end(), time_us,
                          [](const Event& step, double time) { return step.begin_us < time; });
}

bool has_steps(const Trace& trace, const Event& cycle) {
  for (auto step = step_from(trace, cycle.begin_us);
       step != trace.steps.end() && step->begin_us < cycle.end_us(); ++step) {
    if (step->thread == cycle.thread) return true;
  }
  return false;
}

void add_bar(const Event& step, double begin_us, const Trace& trace, Timeline& timeline) {
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

/// @param end_us  when the thread's next cycle begins
Timeline timeline_of(const Event& cycle, double end_us, const Trace& trace) {
  Timeline timeline;
  timeline.length_us = cycle.length_us;
  timeline.end_us = cycle.length_us;
  const double pause_us = (end_us - cycle.begin_us) / 2.0;
  for (auto step = step_from(trace, cycle.begin_us);
       step != trace.steps.end() && step->begin_us < end_us; ++step) {
    if (step->begin_us - cycle.begin_us > timeline.end_us + pause_us) break;
    add_bar(*step, cycle.begin_us, trace, timeline);
  }
  return timeline;
}

}  // namespace

base::Result<Timeline> parse_timeline(const std::string& text, const std::string& file) {
  auto parsed = parse_trace(text);
  if (!parsed) return base::Error{file + ": " + parsed.error()};
  const Trace& trace = parsed.value();
  const std::vector<Event> cycles = cycles_of_busiest(trace);
  // The last one has no next to end it.
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    const bool whole = i + 1 < cycles.size() || cycles.size() == 1;
    if (whole && has_steps(trace, cycles[i])) candidates.push_back(i);
  }
  if (candidates.empty()) return Timeline{};
  const auto middle = candidates.begin() + static_cast<std::ptrdiff_t>(candidates.size() / 2);
  std::nth_element(candidates.begin(), middle, candidates.end(), [&](std::size_t a, std::size_t b) {
    return cycles[a].length_us < cycles[b].length_us;
  });
  const Event& cycle = cycles[*middle];
  const bool last = *middle + 1 == cycles.size();
  Timeline timeline =
      timeline_of(cycle, last ? cycle.end_us() : cycles[*middle + 1].begin_us, trace);
  timeline.cycles = cycles.size();
  return timeline;
}

}  // namespace armature::report
