// SPDX-License-Identifier: Apache-2.0
// Measured execution times and their file.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "armature/analysis/schedule.hpp"
#include "armature/component/component.hpp"
#include "armature/component/host.hpp"
#include "armature/document/document.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"
#include "armature/platform/clock.hpp"

namespace armature::analysis {

using namespace document;
namespace {

using Times = std::map<std::string, ExecutionTime, std::less<>>;

/// The file has no times of zero.
base::Duration duration_of(std::uint64_t ticks) {
  const double ns = std::ceil(static_cast<double>(ticks) * platform::tick_period_ns());
  return std::max(base::Duration(1), base::Duration(static_cast<std::int64_t>(ns)));
}

ExecutionTime time_of(const rt::DistributionSummary& ticks) {
  constexpr double kNearlyAll = 0.999;
  return {ticks.count, duration_of(ticks.percentile(kNearlyAll)), duration_of(ticks.most)};
}

Value tree_of(const Times& times) {
  Value map = make_map();
  for (const auto& [name, time] : times) {
    Value one = make_map();
    one.entries.push_back({"cycles", make_text(std::to_string(time.cycles)), {}, {}});
    one.entries.push_back({"p999", make_text(to_text(time.p999)), {}, {}});
    one.entries.push_back({"max", make_text(to_text(time.most)), {}, {}});
    map.entries.push_back({name, std::move(one), {}, {}});
  }
  return map;
}

ExecutionTime read_time(const Property& entry, base::Diagnostics& diagnostics) {
  const ValueReader reader("execution time of '" + entry.name + "'", diagnostics);
  constexpr int kMostCycles = 2'000'000'000;
  Fields fields(entry.value, reader);
  ExecutionTime time;
  if (const Value* cycles = fields.take("cycles")) {
    time.cycles = static_cast<std::uint64_t>(
        reader.whole_number(*cycles, "cycles", 0, kMostCycles).value_or(0));
  }
  const Value* p999 = fields.take("p999");
  const Value* most = fields.take("max");
  if (p999 == nullptr) {
    reader.error(entry.where, "it has no 'p999'", "for example {p999: 12 us}");
  } else {
    time.p999 = reader.duration(*p999, "p999").value_or(base::Duration::zero());
  }
  time.most = time.p999;
  if (most != nullptr) assign(reader.duration(*most, "max"), time.most);
  fields.refuse_others();
  return time;
}

Times read_all(const Value* map, const ValueReader& reader) {
  Times times;
  if (map == nullptr) return times;
  if (map->kind != Value::Kind::kMap) {
    reader.error(map->where, "expected a map of names");
    return times;
  }
  for (const Property& entry : map->entries) {
    times[entry.name] = read_time(entry, reader.diagnostics());
  }
  return times;
}

}  // namespace

ExecutionTimes measured_times(const exec::Application& application) {
  ExecutionTimes times;
  times.application = application.blueprint().name;
  for (const exec::ThreadStatistics& thread : application.thread_statistics()) {
    if (thread.cycle_ticks.count > 0) times.threads[thread.name] = time_of(thread.cycle_ticks);
  }
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    const rt::DistributionSummary ticks =
        component::Host::execution_ticks(*entry.component).summary();
    if (ticks.count > 0) times.components[entry.component->name()] = time_of(ticks);
  }
  return times;
}

std::string write_times(const ExecutionTimes& times) {
  Value map = make_map();
  map.entries.push_back({"application", make_text(times.application), {}, {}});
  map.entries.push_back({"threads", tree_of(times.threads), {}, {}});
  map.entries.push_back({"components", tree_of(times.components), {}, {}});
  return "# Execution times of a cycle: 99.9 % of the measured cycles took at most p999.\n" +
         block_text(map);
}

ExecutionTimes parse_times(std::string_view text, const std::string& name,
                           base::Diagnostics& diagnostics) {
  const Value tree = parse_yaml(text, name, {}, diagnostics);
  const ValueReader reader("execution times", diagnostics);
  Fields fields(tree, reader);
  ExecutionTimes times;
  if (const Value* application = fields.take("application")) {
    assign(reader.text(*application, "application"), times.application);
  }
  times.threads = read_all(fields.take("threads"), reader);
  times.components = read_all(fields.take("components"), reader);
  fields.refuse_others();
  return times;
}

}  // namespace armature::analysis
