// SPDX-License-Identifier: Apache-2.0
#include "armature/report/goals.hpp"

#include <utility>

#include "armature/report/internal/json.hpp"

namespace armature::report {
namespace {

/// Empty: nothing.
std::string mistake_in(const Goal& goal) {
  if (goal.name.empty()) return "has no name";
  if (!is_pointer(goal.figure)) {
    return "has the figure '" + goal.figure +
           "', expected where it is in report.json, such as /io/wam7/computing_us";
  }
  if (!goal.over.empty() && !is_pointer(goal.over)) {
    return "is over '" + goal.over + "', expected where that is in report.json";
  }
  if (goal.most.has_value() == goal.least.has_value()) return "needs a number, most or least";
  return {};
}

}  // namespace

std::vector<Goal> parse_goals(const std::string& text, const std::string& file,
                              base::Diagnostics& diagnostics) {
  std::vector<Goal> goals;
  if (text.empty()) return goals;
  const Json document = Json::parse(text, nullptr, false);
  const auto list = document.is_object() ? document.find("to_reach") : document.end();
  if (list == document.end() || !list->is_array()) {
    diagnostics.error({file, 0, 0}, "expected an object with a list `to_reach`");
    return goals;
  }
  for (const Json& entry : *list) {
    Goal goal{text_in(entry, "name"), text_in(entry, "unit"),   text_in(entry, "figure"),
              text_in(entry, "over"), number_in(entry, "most"), number_in(entry, "least")};
    if (const std::string mistake = mistake_in(goal); !mistake.empty()) {
      diagnostics.error({file, 0, 0}, "goal " + std::to_string(goals.size() + 1) + ", '" +
                                          goal.name + "', " + mistake);
    }
    goals.push_back(std::move(goal));
  }
  return goals;
}

Reached look_up(const Goal& goal, const std::string& report) {
  const Json figures = Json::parse(report, nullptr, false);
  Reached found{number_at(figures, goal.figure)};
  if (found.value && !goal.over.empty()) {
    const std::optional<double> divisor = number_at(figures, goal.over);
    found.value =
        divisor && *divisor != 0.0 ? std::optional(*found.value / *divisor) : std::nullopt;
  }
  if (!found.value) return found;
  found.reached = goal.most ? *found.value <= *goal.most : *found.value >= *goal.least;
  return found;
}

}  // namespace armature::report
