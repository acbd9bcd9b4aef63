// SPDX-License-Identifier: Apache-2.0
#include "armature/report/phases.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "armature/report/internal/json.hpp"

namespace armature::report {
namespace {

using Steps = std::span<const StepTrace::Event>;

/// Empty, and `mistaken`, if it is something else than a list of names.
std::vector<std::string> components_in(const Json& entry, bool& mistaken) {
  std::vector<std::string> names;
  const auto list = entry.find("components");
  if (list == entry.end()) return names;
  mistaken = !list->is_array();
  for (const Json& name : *list) {
    if (name.is_string()) {
      names.push_back(name.get<std::string>());
    } else {
      mistaken = true;
    }
  }
  return names;
}

/// Empty: nothing.
std::string mistake_in(const Phase& phase) {
  if (phase.name.empty()) return "has no name";
  if (phase.components.empty()) return "needs a list of names, components";
  if (!phase.bus.empty() && !is_pointer(phase.bus)) {
    return "has the bus time '" + phase.bus +
           "', expected where it is in report.json, such as /io/sequential/bus_us";
  }
  return {};
}

Phase phase_in(const Json& entry, std::string& mistake) {
  if (!entry.is_object()) {
    mistake = "is no object";
    return {};
  }
  bool mistaken = false;
  Phase phase{.name = text_in(entry, "name"),
              .components = components_in(entry, mistaken),
              .after = text_in(entry, "after"),
              .before = text_in(entry, "before"),
              .bus = text_in(entry, "bus"),
              .elsewhere_us = number_in(entry, "elsewhere_us")};
  if (mistaken) phase.components.clear();
  mistake = mistake_in(phase);
  return phase;
}

Steps::iterator first_of(const std::string& component, Steps steps) {
  return std::ranges::find(steps, component, &StepTrace::Event::name);
}

/// Without the component that bounds them there are none.
Steps within_bounds(const Phase& phase, Steps steps) {
  const auto begin = phase.after.empty() ? steps.begin() : first_of(phase.after, steps);
  const auto end = phase.before.empty() ? steps.end() : first_of(phase.before, steps);
  const bool unbounded = !phase.before.empty() && end == steps.end();
  return begin < end && !unbounded ? Steps(begin, end) : Steps();
}

}  // namespace

Phases parse_phases(const std::string& text, const std::string& file,
                    base::Diagnostics& diagnostics) {
  Phases phases;
  if (text.empty()) return phases;
  const Json document = Json::parse(text, nullptr, false);
  const auto list = document.is_object() ? document.find("phases") : document.end();
  if (list == document.end() || !list->is_array()) {
    diagnostics.error({file, 0, 0}, "expected an object with a list `phases`");
    return phases;
  }
  phases.elsewhere = text_in(document, "elsewhere");
  for (const Json& entry : *list) {
    std::string mistake;
    phases.all.push_back(phase_in(entry, mistake));
    if (mistake.empty()) continue;
    diagnostics.error({file, 0, 0}, "phase " + std::to_string(phases.all.size()) + ", '" +
                                        phases.all.back().name + "', " + mistake);
  }
  return phases;
}

std::optional<double> computing_of(const Phase& phase, const StepTrace& trace) {
  std::vector<double> times_us;
  for (const TracedCycle& traced : cycles_of_busiest(trace)) {
    if (!traced.whole) continue;
    double time_us = 0.0;
    bool ran = false;
    for (const StepTrace::Event& step :
         within_bounds(phase, trace.steps_between(traced.cycle.begin_us, traced.next_us))) {
      if (std::ranges::find(phase.components, step.name) == phase.components.end()) continue;
      time_us += step.length_us;
      ran = true;
    }
    if (ran) times_us.push_back(time_us);
  }
  if (times_us.empty()) return std::nullopt;
  const auto middle = times_us.begin() + static_cast<std::ptrdiff_t>(times_us.size() / 2);
  std::nth_element(times_us.begin(), middle, times_us.end());
  return *middle;
}

}  // namespace armature::report
