// SPDX-License-Identifier: Apache-2.0
#include "armature/report/page_data.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "armature/report/internal/figures_json.hpp"
#include "armature/report/internal/page_curves.hpp"

namespace armature::report {
namespace {

using internal::figures_of;
using internal::packed;

constexpr std::size_t kPointsOfACurve = 8000;
constexpr std::size_t kPointsOfASmallCurve = 1200;
constexpr std::size_t kPointsOfAllCurves = 500'000;
constexpr std::size_t kFewestPoints = 100;
constexpr std::size_t kComplaints = 100;
constexpr std::size_t kNamesInATitle = 3;

constexpr double kPerRad = 1e5;
constexpr double kPerRadOfErrors = 1e7;

/// Of each curve.
struct Points {
  std::size_t large = kPointsOfACurve;
  std::size_t small = kPointsOfASmallCurve;
};

Json curves_of(const Joint& joint, std::size_t points) {
  Signal error{{}, {}, {}, joint.time_s, {}};
  for (std::size_t i = 0; i < joint.time_s.size(); ++i) {
    error.values.push_back(joint.desired[i] - joint.measured[i]);
  }
  Json figures = figures_of(joint);
  figures["curves"] = {
      {"desired", packed({{}, {}, {}, joint.time_s, joint.desired}, points, kPerRad)},
      {"measured", packed({{}, {}, {}, joint.time_s, joint.measured}, points, kPerRad)},
      {"error", packed(error, points, kPerRadOfErrors)}};
  return figures;
}

Json curves_of(const Velocity& velocity, std::size_t points) {
  Json figures = figures_of(velocity);
  figures["curves"] = {{"desired", packed(velocity.desired, points)},
                       {"measured", packed(velocity.measured, points)}};
  return figures;
}

Json curves_of(const Effort& effort, std::size_t points) {
  Json figures = figures_of(effort);
  figures["curve"] = packed(effort.signal, points);
  return figures;
}

template <typename Items>
Json all_curves_of(const Items& items, std::size_t points) {
  Json all = Json::array();
  for (const auto& item : items) all.push_back(curves_of(item, points));
  return all;
}

/// The signals that stand above already.
std::set<std::string> shown_in(const Run& run) {
  std::set<std::string> shown;
  for (const Joint& joint : run.joints) shown.insert({joint.desired_from, joint.measured_from});
  for (const Velocity& velocity : run.velocities) {
    shown.insert({velocity.desired.name, velocity.measured.name});
  }
  for (const Effort& effort : run.efforts) shown.insert(effort.signal.name);
  return shown;
}

/// Everything that is more than one number, and not shown already.
Json others_of(const Run& run, std::size_t points) {
  const std::set<std::string> shown = shown_in(run);
  Json others = Json::array();
  for (const Signal& signal : run.signals.all) {
    if (shown.contains(signal.name) || signal.values.size() < 2) continue;
    Json one = packed(signal, points);
    one["name"] = signal.name;
    one["unit"] = signal.unit;
    one["doc"] = signal.doc;
    others.push_back(std::move(one));
  }
  return others;
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

/// run.json without what the page has elsewhere, and with as many complaints as anybody reads.
Json summary_for_page(const Run& run) {
  Json summary = internal::summary_of(run);
  if (!summary.is_object()) return summary;
  summary.erase("moments");
  summary.erase("limits");
  if (!summary.contains("complaints") || !summary["complaints"].is_array()) return summary;
  Json& complaints = summary["complaints"];
  if (complaints.size() <= kComplaints) return summary;
  std::size_t more = complaints.size() - kComplaints;
  const auto told = summary.find("complaints_left_out");
  if (told != summary.end() && told->is_number_unsigned()) more += told->get<std::size_t>();
  complaints.erase(complaints.begin() + static_cast<std::ptrdiff_t>(kComplaints), complaints.end());
  summary["complaints_left_out"] = more;
  return summary;
}

Json page_of(const Run& run, const Points& points) {
  Json one{{"name", run.name},
           {"recording", run.recording.substr(run.recording.find_last_of('/') + 1)},
           {"cut_off", run.cut_off},
           {"summary", summary_for_page(run)},
           {"moments", internal::moments_of(run.moments)},
           {"moments_left_out", run.moments.left_out},
           {"joints", all_curves_of(run.joints, points.large)},
           {"velocities", all_curves_of(run.velocities, points.large)},
           {"efforts", all_curves_of(run.efforts, points.large)},
           {"others", others_of(run, points.small)}};
  if (run.timeline) one["timeline"] = timeline_of(*run.timeline);
  return one;
}

/// Those that are found in all of report.json.
void add_figures(const Runs& runs, Json& page) {
  const Json report = internal::report_of(runs);
  if (report.contains("to_reach")) page["to_reach"] = report["to_reach"];
  page["elsewhere"] = runs.phases.elsewhere;
  for (Json& run : page["runs"]) {
    const Json& figures = report["runs"][run["name"].get<std::string>()];
    if (figures.contains("phases")) run["phases"] = figures["phases"];
  }
}

std::string page_with(const Runs& runs, const Points& points) {
  Json page{{"title", title_of(runs)},
            {"name", runs.name},
            {"runs", Json::array()},
            {"io", internal::cycle_of(runs)}};
  for (const Run& run : runs.runs) page["runs"].push_back(page_of(run, points));
  if (const Json found = internal::found_of(runs); found.is_object()) {
    for (const char* const shown : internal::kShownOnly) {
      if (found.contains(shown)) page[shown] = found[shown];
    }
  }
  if (!runs.what_if_json.empty()) page["what_if"] = Json::parse(runs.what_if_json);
  if (!runs.goals.empty() || !runs.phases.all.empty()) add_figures(runs, page);
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

/// So many that the first attempt is not much too large.
Points first_points(const Runs& runs) {
  std::size_t curves = 1;
  for (const Run& run : runs.runs) {
    curves += 3 * run.joints.size() + 2 * run.velocities.size() + run.efforts.size();
  }
  return {std::min(kPointsOfACurve, kPointsOfAllCurves / curves), kPointsOfASmallCurve};
}

}  // namespace

std::string title_of(const Runs& runs) {
  std::vector<std::string> names;
  for (const Run& run : runs.runs) {
    const std::string name = text_in(internal::summary_of(run), "application");
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  if (names.empty()) return runs.name;
  std::string title = names.front();
  for (std::size_t i = 1; i < std::min(names.size(), kNamesInATitle); ++i) title += ", " + names[i];
  const std::size_t more = names.size() - std::min(names.size(), kNamesInATitle);
  return more == 0 ? title : title + " and " + std::to_string(more) + " more";
}

std::string page_json(const Runs& runs, std::size_t most) {
  constexpr double kMargin = 0.9;
  Points points = first_points(runs);
  std::string text = page_with(runs, points);
  while (text.size() > most && std::max(points.large, points.small) > kFewestPoints) {
    const double share = kMargin * static_cast<double>(most) / static_cast<double>(text.size());
    const auto fewer = [&](std::size_t count) {
      return std::max(kFewestPoints, static_cast<std::size_t>(static_cast<double>(count) * share));
    };
    points = {fewer(points.large), fewer(points.small)};
    text = page_with(runs, points);
  }
  return text;
}

}  // namespace armature::report
