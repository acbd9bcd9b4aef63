// SPDX-License-Identifier: Apache-2.0
#include "armature/report/run_summary.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "armature/base/seconds.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/file.hpp"
#include "armature/report/internal/json.hpp"
#include "armature/report/moment_kind.hpp"

namespace armature::report {
namespace {

std::string_view name_of(exec::RunEnd end) {
  switch (end) {
    case exec::RunEnd::kTimeUp:
      return "time up";
    case exec::RunEnd::kStopRequested:
      return "stopped as asked";
    case exec::RunEnd::kFaulted:
      return "a fault";
    case exec::RunEnd::kStoppedByReaction:
      return "a safety reaction";
    case exec::RunEnd::kConditionMet:
      return "condition met";
  }
  return "unknown";
}

/// In microseconds.
Json distribution(const rt::DistributionSummary& summary, double unit_us) {
  const auto in_us = [&](std::uint64_t value) { return static_cast<double>(value) * unit_us; };
  return {{"median", in_us(summary.percentile(0.5))},
          {"p99_9", in_us(summary.percentile(0.999))},
          {"most", in_us(summary.most)}};
}

Json thread_summary(const exec::ThreadStatistics& thread, const exec::ThreadPlan& plan,
                    base::Duration duration) {
  Json one{{"name", thread.name}};
  if (plan.activity.kind == exec::Activity::Kind::kPeriodic) {
    one["period_s"] = base::to_seconds(plan.activity.period);
    one["cycles_due"] = duration / plan.activity.period;
  }
  if (plan.activity.priority > 0) one["priority"] = plan.activity.priority;
  one["cycles_run"] = thread.cycles_run;
  one["cycles_skipped"] = thread.cycles_skipped;
  one["log_lines_dropped"] = thread.log_lines_dropped;
  one["cycle_us"] = distribution(thread.cycle_ticks, platform::tick_period_ns() * 1e-3);
  if (thread.latency_ns.count > 0) one["late_us"] = distribution(thread.latency_ns, 1e-3);
  return one;
}

Json threads_of(const exec::Application& application, base::Duration duration) {
  Json threads = Json::array();
  const auto statistics = application.thread_statistics();
  for (std::size_t i = 0; i < statistics.size(); ++i) {
    if (statistics[i].cycles_run == 0) continue;
    threads.push_back(thread_summary(statistics[i], application.plan().threads[i], duration));
  }
  return threads;
}

/// Attributes that are whole numbers, count by the rules of the house, and are of interest if they
/// are not 0: lost answers, dropped samples, limited efforts.
Json counters_of(const exec::Application& application) {
  Json counters = Json::object();
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    for (const component::PropertyBase* item :
         component::interface_of(*entry.component).properties) {
      if (item->persistent()) continue;
      const std::string name = entry.component->name() + '.' + std::string(item->name());
      long long value = 0;
      if (types::same_type(item->type(), types::type_of<int>())) {
        value = *static_cast<const int*>(item->data());
      } else if (types::same_type(item->type(), types::type_of<std::uint64_t>())) {
        value = static_cast<long long>(*static_cast<const std::uint64_t*>(item->data()));
      }
      if (value != 0) counters[name] = {{"value", value}, {"doc", item->doc()}};
    }
  }
  return counters;
}

Json verdict_of(const exec::Application& application) {
  Json lines = Json::array();
  for (const exec::Verdict::Line& line : application.verdict().lines) {
    lines.push_back({{"subject", line.subject},
                     {"requested", line.requested},
                     {"granted", line.granted},
                     {"refusals", line.refusals}});
  }
  return lines;
}

Json casualties_of(const exec::Application& application) {
  Json all = Json::array();
  for (const exec::Casualty& one : application.casualties()) {
    all.push_back({{"component", one.component},
                   {"state", component::name_of(one.state)},
                   {"reason", one.reason}});
  }
  return all;
}

Json complaints_of(const RunFacts& facts) {
  Json all = Json::array();
  for (const rt::LogRecord& record : facts.complaints) {
    all.push_back({{"time_s", base::to_seconds(record.time - facts.begin)},
                   {"level", rt::name_of(record.level)},
                   {"component", record.component.view()},
                   {"message", record.message()}});
  }
  return all;
}

Json moments_of(const RunFacts& facts) {
  Json all = Json::array();
  for (const rt::LogRecord& record : facts.moments) {
    const std::string message = record.message();
    const auto kind = moment_told_by(message);
    if (!kind) continue;
    all.push_back({{"time_s", base::to_seconds(record.time - facts.begin)},
                   {"kind", name_of(*kind)},
                   {"component", record.component.view()},
                   {"message", message}});
  }
  return all;
}

/// What the page draws as lines, whether somebody recorded it or not.
Json limits_of(const exec::Application& application) {
  constexpr std::array<std::string_view, 3> kNames = {"MaxVelocity", "MaxTorque", "MaxVoltage"};
  Json limits = Json::object();
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    for (const component::PropertyBase* item :
         component::interface_of(*entry.component).properties) {
      if (std::ranges::find(kNames, item->name()) == kNames.end()) continue;
      const std::string name = entry.component->name() + '.' + std::string(item->name());
      if (types::same_type(item->type(), types::type_of<double>())) {
        limits[name] = *static_cast<const double*>(item->data());
      } else if (types::same_type(item->type(), types::type_of<std::vector<double>>())) {
        limits[name] = *static_cast<const std::vector<double>*>(item->data());
      }
    }
  }
  return limits;
}

}  // namespace

base::Result<void> write_run_summary(const std::string& folder, const RunFacts& facts,
                                     const exec::Application& application) {
  const Json summary{{"application", application.blueprint().name},
                     {"deployment", facts.deployment},
                     {"time", facts.simulated ? "simulated" : "real"},
                     {"duration_s", base::to_seconds(facts.duration)},
                     {"wall_time_s", base::to_seconds(facts.wall_time)},
                     {"end", name_of(facts.end)},
                     {"exit_code", facts.exit_code},
                     {"components", application.blueprint().components.size()},
                     {"faults", application.faults()},
                     {"reactions", application.reactions()},
                     {"casualties", casualties_of(application)},
                     {"threads", threads_of(application, facts.duration)},
                     {"counters", counters_of(application)},
                     {"verdict", verdict_of(application)},
                     {"complaints", complaints_of(facts)},
                     {"complaints_left_out", facts.complaints_left_out},
                     {"begin_s", base::to_seconds(facts.begin.time_since_epoch())},
                     {"moments", moments_of(facts)},
                     {"moments_left_out", facts.moments_left_out},
                     {"limits", limits_of(application)},
                     {"lines_lost", facts.lines_lost}};
  const std::string path = folder + '/' + kSummaryFile;
  return platform::write_file(path,
                              summary.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace armature::report
