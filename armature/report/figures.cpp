// SPDX-License-Identifier: Apache-2.0
#include "armature/report/figures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/report/internal/figures_json.hpp"

namespace armature::report {
namespace internal {

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

Json figures_of(const Effort& effort) {
  const Json share = effort.limit ? Json(effort.largest / *effort.limit) : Json();
  return {{"joint", effort.joint},     {"unit", effort.signal.unit},
          {"largest", effort.largest}, {"limit", or_null(effort.limit)},
          {"largest_of_limit", share}, {"signal", effort.signal.name}};
}

Json figures_of(const Velocity& velocity) {
  const Json share = velocity.limit ? Json(velocity.largest / *velocity.limit) : Json();
  return {{"joint", velocity.joint},
          {"largest_rad_s", velocity.largest},
          {"limit_rad_s", or_null(velocity.limit)},
          {"largest_of_limit", share},
          {"signal", velocity.measured.name}};
}

Json moments_of(const Moments& moments) {
  Json all = Json::array();
  for (const Moment& moment : moments.all) {
    all.push_back(
        {{"time_s", moment.time_s}, {"kind", name_of(moment.kind)}, {"told", moment.told}});
  }
  return all;
}

Json summary_of(const Run& run) {
  return run.summary.empty() ? Json() : Json::parse(run.summary, nullptr, false);
}

Json cycle_of(const Runs& runs) {
  return runs.cycle_json.empty() ? Json() : Json::parse(runs.cycle_json, nullptr, false);
}

Json found_of(const Runs& runs) {
  return runs.figures_json.empty() ? Json() : Json::parse(runs.figures_json, nullptr, false);
}

}  // namespace internal

namespace {

using internal::cycle_of;
using internal::figures_of;
using internal::moments_of;
using internal::or_null;
using internal::summary_of;

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

Json velocities_of(const Run& run) {
  Json velocities = Json::array();
  for (const Velocity& velocity : run.velocities) velocities.push_back(figures_of(velocity));
  return velocities;
}

Json efforts_of(const Run& run) {
  Json efforts = Json::array();
  for (const Effort& effort : run.efforts) efforts.push_back(figures_of(effort));
  return efforts;
}

/// Unknown is what its parts do not tell; a phase without a bus is its computing.
Json phases_of(const Run& run, const Phases& phases, const Json& report) {
  Json all = Json::array();
  for (std::size_t i = 0; i < run.phase_computing_us.size(); ++i) {
    const Phase& phase = phases.all[i];
    const std::optional<double>& computing = run.phase_computing_us[i];
    std::optional<double> whole = computing;
    Json one{{"name", phase.name}, {"us", Json()}, {"computing_us", or_null(computing)}};
    if (!phase.bus.empty()) {
      const std::optional<double> bus = number_at(report, phase.bus);
      one["bus_us"] = or_null(bus);
      whole = computing && bus ? std::optional(*computing + *bus) : std::nullopt;
    }
    one["us"] = or_null(whole);
    one["elsewhere_us"] = or_null(phase.elsewhere_us);
    all.push_back(std::move(one));
  }
  return all;
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

}  // namespace

namespace internal {

Json report_of(const Runs& runs) {
  Json report{{"controllers", Json::object()}, {"runs", Json::object()}};
  for (const Run& run : runs.runs) {
    Json& one = report["runs"][run.name];
    one = {{"recording", run.recording}, {"cut_off", run.cut_off}, {"summary", summary_of(run)}};
    if (!run.moments.all.empty()) one["moments"] = moments_of(run.moments);
    if (!run.velocities.empty()) one["velocities"] = velocities_of(run);
    if (!run.efforts.empty()) one["efforts"] = efforts_of(run);
    if (run.joints.empty()) continue;
    Json joints = Json::array();
    for (const Joint& joint : run.joints) joints.push_back(figures_of(joint));
    report["controllers"][run.name] = {{"all", figures_of_all(run.joints)},
                                       {"joints", std::move(joints)}};
  }
  if (Json cycle = cycle_of(runs); !cycle.is_null()) report["io"] = std::move(cycle);
  if (Json found = found_of(runs); found.is_object()) {
    for (const char* const shown : kShownOnly) found.erase(shown);
    report["figures"] = std::move(found);
  }
  for (const Run& run : runs.runs) {
    if (run.phase_computing_us.empty()) continue;
    report["runs"][run.name]["phases"] = phases_of(run, runs.phases, report);
  }
  if (!runs.goals.empty()) report["to_reach"] = reached_of(runs.goals, report);
  return report;
}

}  // namespace internal

std::string figures_json(const Runs& runs) {
  return internal::report_of(runs).dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace armature::report
