// SPDX-License-Identifier: Apache-2.0
#include "armature/report/moments.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "armature/report/internal/json.hpp"

namespace armature::report {
namespace {

/// What comes so soon after a moment is its consequence: who is disarmed at an E-stop.
constexpr double kAtOnce_s = 0.2;
/// Joints are let go one after the other.
constexpr double kOneArming_s = 1.0;
constexpr std::size_t kMost = 200;

constexpr std::array kKinds = {MomentKind::kArmed,   MomentKind::kReset, MomentKind::kDisarmed,
                               MomentKind::kStopped, MomentKind::kFault, MomentKind::kEstop};

std::optional<MomentKind> kind_named(const std::string& name) {
  const auto found =
      std::ranges::find_if(kKinds, [&](MomentKind kind) { return name_of(kind) == name; });
  return found == kKinds.end() ? std::nullopt : std::optional(*found);
}

bool is_bad(MomentKind kind) { return kind >= MomentKind::kDisarmed; }

/// Those that are no moments, or that nobody can place on the axis, are not there.
std::vector<Moment> told_in(const std::string& summary, double zero_s) {
  std::vector<Moment> moments;
  const Json run = Json::parse(summary, nullptr, false);
  if (!run.is_object() || !run.contains("moments") || !run["moments"].is_array()) return moments;
  if (!run.contains("begin_s") || !run["begin_s"].is_number()) return moments;
  const double begin_s = run["begin_s"].get<double>() - zero_s;
  for (const Json& one : run["moments"]) {
    if (!one.is_object() || !one.contains("time_s") || !one["time_s"].is_number()) continue;
    const auto kind = kind_named(text_in(one, "kind"));
    if (!kind) continue;
    moments.push_back({begin_s + one["time_s"].get<double>(),
                       *kind,
                       {text_in(one, "component") + ": " + text_in(one, "message")}});
  }
  return moments;
}

/// `Joint2.Armed`, `WAM.Armed7`.
bool says_armed(const Signal& signal) {
  const std::size_t dot = signal.name.rfind('.');
  if (dot == std::string::npos || signal.name.compare(dot + 1, 5, "Armed") != 0) return false;
  return signal.name.find_first_not_of("0123456789", dot + 6) == std::string::npos;
}

/// When all signals of this kind became true, and when the first of them did not stay so; of an
/// arm that is stopped nobody logs it.
std::vector<Moment> changes_of_armed(const Signals& signals) {
  struct Change {
    double time_s;
    std::size_t signal;
    bool armed;
  };
  std::vector<Change> changes;
  std::size_t count = 0;
  for (const Signal& signal : signals.all) {
    if (!says_armed(signal)) continue;
    for (std::size_t i = 0; i < signal.values.size(); ++i) {
      changes.push_back({signal.time_s[i], count, signal.values[i] == 1.0});
    }
    ++count;
  }
  std::ranges::stable_sort(changes, {}, &Change::time_s);
  std::vector<bool> armed(count, false);
  std::vector<Moment> moments;
  bool all = false;
  for (const Change& change : changes) {
    armed[change.signal] = change.armed;
    const bool now = std::ranges::find(armed, false) == armed.end();
    if (now == all) continue;
    all = now;
    moments.push_back({change.time_s, now ? MomentKind::kArmed : MomentKind::kDisarmed, {}});
  }
  return moments;
}

bool belongs_to(const Moment& later, const Moment& moment) {
  const double after_s = later.time_s - moment.time_s;
  if (is_bad(later.kind) && is_bad(moment.kind)) return after_s <= kAtOnce_s;
  return later.kind == moment.kind && after_s <= kOneArming_s;
}

/// Of a moment that nobody has logged.
std::string what_changed(MomentKind kind) {
  return kind == MomentKind::kArmed ? "all joints are armed" : "not all joints are armed";
}

std::vector<Moment> joined(const std::vector<Moment>& moments) {
  std::vector<Moment> all;
  for (const Moment& moment : moments) {
    if (all.empty() || !belongs_to(moment, all.back())) {
      all.push_back(moment);
      continue;
    }
    all.back().kind = std::max(all.back().kind, moment.kind);
    all.back().told.insert(all.back().told.end(), moment.told.begin(), moment.told.end());
  }
  return all;
}

}  // namespace

Moments moments_of(const std::string& summary, const Signals& signals, double zero_s) {
  std::vector<Moment> moments = told_in(summary, zero_s);
  const std::vector<Moment> changes = changes_of_armed(signals);
  moments.insert(moments.end(), changes.begin(), changes.end());
  std::ranges::stable_sort(moments, {}, &Moment::time_s);
  Moments found{joined(moments), 0};
  for (Moment& moment : found.all) {
    if (moment.told.empty()) moment.told.push_back(what_changed(moment.kind));
  }
  if (found.all.size() > kMost) {
    found.left_out = found.all.size() - kMost;
    found.all.resize(kMost);
  }
  return found;
}

}  // namespace armature::report
