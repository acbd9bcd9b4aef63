// SPDX-License-Identifier: Apache-2.0
#include "armature/report/figures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/report/internal/json.hpp"

namespace armature::report {
namespace {

constexpr std::size_t kPointsOfACurve = 8000;
constexpr std::size_t kPointsOfAllCurves = 250'000;
constexpr std::size_t kPointsOfASmallCurve = 1200;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json figures_of(const Joint& joint) {
  const auto& figures = joint.figures;
  const auto in_counts = [&](std::optional<double> rad) {
    return rad && joint.rad_per_count ? Json(*rad / *joint.rad_per_count) : Json();
  };
  return {{"joint", joint.name},
          {"iae", figures.iae},
          {"itae", figures.itae},
          {"ise", figures.ise},
          {"itse", figures.itse},
          {"max_abs_error_rad", figures.largest},
          {"rms_error_rad", joint.rms},
          {"final_error_rad", figures.last},
          {"final_error_counts", in_counts(figures.last)},
          {"at_rest_error_rad", or_null(joint.at_rest)},
          {"moved_arming_rad", or_null(joint.moved_arming)},
          {"at_rest_error_counts", in_counts(joint.at_rest)},
          {"moved_in_last_10_s_rad", or_null(joint.moved_lately)},
          {"rad_per_count", or_null(joint.rad_per_count)},
          {"period_s", joint.period_s},
          {"samples", joint.time_s.size()},
          {"samples_missing", joint.missing},
          {"from_s", joint.measured_since_s},
          {"desired", joint.desired_from},
          {"measured", joint.measured_from}};
}

/// The worst of the joints; of all errors together the root of the mean square.
Json figures_of_all(const std::vector<Joint>& joints) {
  double largest = 0.0;
  double squares = 0.0;
  std::optional<double> moved;
  for (const Joint& joint : joints) {
    largest = std::max(largest, joint.figures.largest);
    squares += joint.rms * joint.rms;
    if (joint.moved_lately) moved = std::max(moved.value_or(0.0), *joint.moved_lately);
  }
  return {{"max_abs_error_rad", largest},
          {"rms_error_rad", std::sqrt(squares / static_cast<double>(joints.size()))},
          {"moved_in_last_10_s_rad", or_null(moved)}};
}

Json summary_of(const Run& run) {
  return run.summary.empty() ? Json() : Json::parse(run.summary, nullptr, false);
}

/// Enough digits for a screen; what is not finite becomes null.
Json rounded(const std::vector<double>& values, double step) {
  Json all = Json::array();
  for (const double value : values) {
    const double whole = std::round(value / step);
    // A quotient is the number that a person would write: 0.1 and not 0.1000000001.
    all.push_back(std::isfinite(whole) ? Json(whole / (1.0 / step)) : Json());
  }
  return all;
}

Json curve(const Signal& signal, std::size_t points, double step) {
  const Signal thin = thinned(signal, points);
  return {{"t", rounded(thin.time_s, 1e-4)}, {"v", rounded(thin.values, step)}};
}

/// So many that a page with many runs can be opened still.
std::size_t points_of_a_curve(const Runs& runs) {
  std::size_t curves = 0;
  for (const Run& run : runs.runs) curves += 3 * run.joints.size() + run.efforts.size();
  return std::min(kPointsOfACurve, kPointsOfAllCurves / std::max<std::size_t>(curves, 1));
}

Json curves_of(const Joint& joint, std::size_t points) {
  Signal error{{}, {}, {}, joint.time_s, {}};
  for (std::size_t i = 0; i < joint.time_s.size(); ++i) {
    error.values.push_back(joint.desired[i] - joint.measured[i]);
  }
  Json figures = figures_of(joint);
  figures["curves"] = {
      {"desired", curve({{}, {}, {}, joint.time_s, joint.desired}, points, 1e-5)},
      {"measured", curve({{}, {}, {}, joint.time_s, joint.measured}, points, 1e-5)},
      {"error", curve(error, points, 1e-7)}};
  return figures;
}

/// A step that keeps five digits of the largest value.
double step_for(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest > 0.0 ? std::pow(10.0, std::ceil(std::log10(largest)) - 5.0) : 1.0;
}

/// Everything that is more than one number, and not shown as a position already.
Json others_of(const Run& run) {
  Json others = Json::array();
  for (const Signal& signal : run.signals.all) {
    bool shown = false;
    for (const Joint& joint : run.joints) {
      shown = shown || signal.name == joint.desired_from || signal.name == joint.measured_from;
    }
    for (const Effort& effort : run.efforts) shown = shown || signal.name == effort.signal.name;
    if (shown || signal.values.size() < 2) continue;
    Json one = curve(signal, kPointsOfASmallCurve, step_for(signal.values));
    one["name"] = signal.name;
    one["unit"] = signal.unit;
    one["doc"] = signal.doc;
    others.push_back(std::move(one));
  }
  return others;
}

Json figures_of(const Effort& effort) {
  const Json share = effort.limit ? Json(effort.largest / *effort.limit) : Json();
  return {{"joint", effort.joint},     {"unit", effort.signal.unit},
          {"largest", effort.largest}, {"limit", or_null(effort.limit)},
          {"largest_of_limit", share}, {"signal", effort.signal.name}};
}

Json efforts_of(const Run& run) {
  Json efforts = Json::array();
  for (const Effort& effort : run.efforts) efforts.push_back(figures_of(effort));
  return efforts;
}

Json timeline_of(const Timeline& timeline) {
  Json lanes = Json::array();
  for (const Timeline::Lane& lane : timeline.lanes) {
    Json bars = Json::array();
    for (const Timeline::Bar& bar : lane.bars) {
      bars.push_back({{"begin", bar.begin_us}, {"length", bar.length_us}});
    }
    lanes.push_back({{"component", lane.component}, {"thread", lane.thread}, {"bars", bars}});
  }
  return {{"lanes", lanes},
          {"length_us", timeline.length_us},
          {"end_us", timeline.end_us},
          {"cycles", timeline.cycles}};
}

Json page_of(const Run& run, std::size_t points) {
  Json one{{"name", run.name},
           {"recording", run.recording.substr(run.recording.find_last_of('/') + 1)},
           {"cut_off", run.cut_off},
           {"summary", summary_of(run)}};
  one["joints"] = Json::array();
  for (const Joint& joint : run.joints) one["joints"].push_back(curves_of(joint, points));
  one["efforts"] = Json::array();
  for (const Effort& effort : run.efforts) {
    Json shown = figures_of(effort);
    shown["curve"] = curve(effort.signal, points, step_for(effort.signal.values));
    one["efforts"].push_back(std::move(shown));
  }
  one["others"] = others_of(run);
  if (run.timeline) one["timeline"] = timeline_of(*run.timeline);
  return one;
}

Json cycle_of(const Runs& runs) {
  return runs.cycle_json.empty() ? Json() : Json::parse(runs.cycle_json, nullptr, false);
}

Json reached_of(const std::vector<Goal>& goals, const Json& report) {
  const std::string text = report.dump(-1, ' ', false, Json::error_handler_t::replace);
  Json all = Json::array();
  for (const Goal& goal : goals) {
    const Reached found = look_up(goal, text);
    Json one{{"name", goal.name}, {"unit", goal.unit}, {"value", or_null(found.value)}};
    one[goal.most ? "most" : "least"] = goal.most ? *goal.most : *goal.least;
    one["reached"] = found.reached;
    all.push_back(std::move(one));
  }
  return all;
}

Json report_of(const Runs& runs) {
  Json report{{"controllers", Json::object()}, {"runs", Json::object()}};
  for (const Run& run : runs.runs) {
    Json& one = report["runs"][run.name];
    one = {{"recording", run.recording}, {"cut_off", run.cut_off}, {"summary", summary_of(run)}};
    if (!run.efforts.empty()) one["efforts"] = efforts_of(run);
    if (run.joints.empty()) continue;
    Json joints = Json::array();
    for (const Joint& joint : run.joints) joints.push_back(figures_of(joint));
    report["controllers"][run.name] = {{"all", figures_of_all(run.joints)},
                                       {"joints", std::move(joints)}};
  }
  if (Json cycle = cycle_of(runs); !cycle.is_null()) report["io"] = std::move(cycle);
  if (!runs.goals.empty()) report["to_reach"] = reached_of(runs.goals, report);
  return report;
}

}  // namespace

std::string figures_json(const Runs& runs) {
  return report_of(runs).dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string page_json(const Runs& runs) {
  Json page{{"name", runs.name}, {"runs", Json::array()}, {"io", cycle_of(runs)}};
  const std::size_t points = points_of_a_curve(runs);
  for (const Run& run : runs.runs) page["runs"].push_back(page_of(run, points));
  if (!runs.goals.empty()) page["to_reach"] = report_of(runs)["to_reach"];
  const std::string text = page.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      safe += "\\u003c";  // nothing in a name ends the element that holds it
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace armature::report
