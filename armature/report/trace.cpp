// SPDX-License-Identifier: Apache-2.0
#include "armature/report/trace.hpp"

#include <algorithm>
#include <utility>

#include "armature/report/internal/json.hpp"

namespace armature::report {
namespace {

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

base::Result<void> add(const Json& event, StepTrace& trace) {
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
  const StepTrace::Event one{name, event["ts"].get<double>(), event["dur"].get<double>(), thread};
  const std::string category = event.value("cat", "");
  if (category == "step") trace.steps.push_back(one);
  if (category == "cycle") trace.cycles.push_back(one);
  return {};
}

base::Result<StepTrace> trace_of(const Json& events) {
  if (!events.is_array()) {
    return base::Error{
        "expected a trace of `armature run --trace`: a list of events, or an object "
        "with the list traceEvents"};
  }
  StepTrace trace;
  try {
    for (const Json& event : events) {
      if (auto added = add(event, trace); !added) return base::Error{added.error()};
    }
  } catch (const Json::exception& wrong) {
    return base::Error{std::string("a field of another type than expected: ") + wrong.what()};
  }
  const auto earlier = [](const StepTrace::Event& a, const StepTrace::Event& b) {
    return a.begin_us < b.begin_us;
  };
  std::stable_sort(trace.steps.begin(), trace.steps.end(), earlier);
  std::stable_sort(trace.cycles.begin(), trace.cycles.end(), earlier);
  return trace;
}

bool has_steps(const StepTrace& trace, const StepTrace::Event& cycle) {
  const auto steps = trace.steps_between(cycle.begin_us, cycle.end_us());
  return std::ranges::any_of(
      steps, [&](const StepTrace::Event& step) { return step.thread == cycle.thread; });
}

}  // namespace

std::span<const StepTrace::Event> StepTrace::steps_between(double begin_us, double end_us) const {
  const auto before = [](const Event& step, double time_us) { return step.begin_us < time_us; };
  const auto first = std::lower_bound(steps.begin(), steps.end(), begin_us, before);
  return {first, std::lower_bound(first, steps.end(), std::max(begin_us, end_us), before)};
}

base::Result<StepTrace> parse_trace(const std::string& text, const std::string& file) {
  auto trace = trace_of(events_of(text));
  if (!trace) return base::Error{file + ": " + trace.error()};
  return trace;
}

std::vector<TracedCycle> cycles_of_busiest(const StepTrace& trace) {
  std::map<long long, double> busy_us;
  for (const StepTrace::Event& step : trace.steps) busy_us[step.thread] += step.length_us;
  std::vector<TracedCycle> cycles;
  if (busy_us.empty()) return cycles;
  const auto busiest =
      std::max_element(busy_us.begin(), busy_us.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const StepTrace::Event& cycle : trace.cycles) {
    if (cycle.thread != busiest->first) continue;
    if (!cycles.empty()) cycles.back().next_us = cycle.begin_us;
    cycles.push_back({cycle, cycle.end_us(), has_steps(trace, cycle)});
  }
  // The last one has no next to end it.
  if (cycles.size() > 1) cycles.back().whole = false;
  return cycles;
}

}  // namespace armature::report
