// SPDX-License-Identifier: Apache-2.0
// The load as a table for people.
#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include "armature/analysis/internal/load_text.hpp"
#include "armature/analysis/schedule.hpp"
#include "armature/base/text_table.hpp"

namespace armature::analysis {

using namespace document;
namespace {

using base::Row;
using internal::percent_text;
using internal::short_text;

constexpr const char* kUnknown = "?";

std::string scheduler_text(const exec::Activity& activity) {
  std::string text(exec::name_of(activity.scheduler));
  const bool fixed = activity.scheduler == exec::Activity::Scheduler::kRealtime;
  return fixed ? text + " " + std::to_string(activity.priority) : text;
}

std::string cpus_of(const exec::Activity& activity) {
  std::string text;
  for (const int cpu : activity.cpus) text += (text.empty() ? "" : ",") + std::to_string(cpu);
  return text.empty() ? "any" : text;
}

std::string cost_text(const ThreadLoad& load) {
  switch (load.source) {
    case ThreadLoad::Source::kDeclared:
      return short_text(load.cost) + " declared";
    case ThreadLoad::Source::kMeasured:
      return short_text(load.cost) + " measured";
    case ThreadLoad::Source::kUnknown:
      break;
  }
  return kUnknown;
}

Row row_of(const ThreadLoad& load) {
  const bool periodic = load.period > base::Duration::zero();
  const bool answers = load.response > base::Duration::zero();
  return {load.name,
          std::string(exec::name_of(load.activity.kind)),
          scheduler_text(load.activity),
          cpus_of(load.activity),
          periodic ? short_text(load.period) : kUnknown,
          cost_text(load),
          load.known() ? percent_text(load.utilisation()) : kUnknown,
          answers ? short_text(load.response) : kUnknown};
}

}  // namespace

namespace internal {

std::string percent_text(double share) {
  std::array<char, 32> text{};
  constexpr double kFine = 0.1;
  const char* const format = share < kFine ? "%.2f %%" : "%.1f %%";
  constexpr double kHundred = 100.0;
  std::snprintf(text.data(), text.size(), format, share * kHundred);
  return text.data();
}

std::string short_text(base::Duration duration) {
  struct Unit {
    double ns;
    const char* name;
  };
  constexpr std::array<Unit, 4> kUnits = {{{1e9, "s"}, {1e6, "ms"}, {1e3, "us"}, {1.0, "ns"}}};
  const auto ns = static_cast<double>(duration.count());
  const auto unit = std::find_if(kUnits.begin(), kUnits.end() - 1,
                                 [ns](const Unit& one) { return ns >= one.ns; });
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g %s", ns / unit->ns, unit->name);
  return text.data();
}

std::string cpus_text(const std::set<int>& cpus, const std::set<int>& all) {
  if (cpus == all && cpus.size() > 1) return std::to_string(cpus.size()) + " CPUs";
  std::string text;
  for (const int cpu : cpus) text += (text.empty() ? "" : ", ") + std::to_string(cpu);
  return (cpus.size() == 1 ? "CPU " : "CPUs ") + text;
}

}  // namespace internal

std::string Schedule::to_text() const {
  std::vector<Row> rows = {
      {"thread", "activity", "scheduler", "CPUs", "period", "time", "load", "answers within"}};
  for (const ThreadLoad& load : threads) rows.push_back(row_of(load));
  const auto unknown = std::count_if(threads.begin(), threads.end(),
                                     [](const ThreadLoad& load) { return !load.known(); });
  std::string text = base::table_text(rows) + "load: " + (unknown > 0 ? "at least " : "") +
                     internal::percent_text(utilisation()) + " of one CPU, of " +
                     std::to_string(cpus) + "\n";
  if (unknown > 0) {
    text += "not known for " + std::to_string(unknown) + (unknown == 1 ? " thread" : " threads") +
            ": declare a budget, or measure (run --write-times F, then check --times F)\n";
  }
  return text;
}

}  // namespace armature::analysis
