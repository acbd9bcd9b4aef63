// SPDX-License-Identifier: Apache-2.0
// What bringing up many components costs for each of them: the control cycle with as many joints as
// make that number, which has four connections, subscriptions and bound operations for each.
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <malloc.h>

#include "armature/deploy/deployment.hpp"
#include "armature/exec/application.hpp"
#include "armature/platform/clock.hpp"
#include "benchmarks/allocations.hpp"
#include "benchmarks/control_cycle/cycle.hpp"
#include "benchmarks/simulated.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

constexpr double kBound = 1.2;
constexpr std::int64_t kRounds = 31;
constexpr int kFew = 100;
constexpr int kFewRepeats = 10;
constexpr int kMost = 10000;
constexpr const char* kDeployment = ARMATURE_SOURCE_DIR "/benchmarks/control_cycle/cycle.yaml";

/// What was measured for each component.
struct Cost {
  double amount = 0.0;
  double allocations = 0.0;
};
using Measure = std::function<Cost(int components)>;

int joints_for(int components) { return (components - 6) / 3; }

void demand(const base::Diagnostics& diagnostics) {
  if (!diagnostics.ok()) throw std::runtime_error(diagnostics.to_text());
}

/// Microseconds and allocations of `work` for each of so many components.
template <typename Work>
Cost cost_of(std::size_t components, const Work& work) {
  const std::uint64_t allocated = allocations();
  const base::Time begin = platform::monotonic_now();
  work();
  const base::Duration duration = platform::monotonic_now() - begin;
  const auto each = static_cast<double>(components);
  return {static_cast<double>(duration.count()) / 1000.0 / each,
          static_cast<double>(allocations() - allocated) / each};
}

/// Checks and starts an application that is there already.
Cost start(int components) {
  exec::Application application(make_cycle(joints_for(components), one_thread()), simulated());
  return cost_of(application.blueprint().components.size(), [&] { demand(application.start()); });
}

/// Reads a deployment file, makes the components, and checks.
Cost load(int components) {
  deploy::DeploymentOptions options;
  options.library_folders = {ARMATURE_LIBRARIES};
  options.document.overrides = {"joints=" + std::to_string(joints_for(components))};
  deploy::Deployment deployment;
  Cost cost = cost_of(1, [&] { deployment = deploy::load_deployment(kDeployment, options); });
  demand(deployment.diagnostics);
  const auto each = static_cast<double>(deployment.blueprint.components.size());
  return {cost.amount / each, cost.allocations / each};
}

double heap_bytes() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

/// Bytes of the heap that a started application occupies.
Cost remember(int components) {
  const double before = heap_bytes();
  exec::Application application(make_cycle(joints_for(components), one_thread()), simulated());
  demand(application.start());
  const auto each = static_cast<double>(application.blueprint().components.size());
  return {(heap_bytes() - before) / each, 0.0};
}

double few(const Measure& measure) {
  double sum = 0.0;
  for (int i = 0; i < kFewRepeats; ++i) sum += measure(kFew).amount;
  return sum / kFewRepeats;
}

/// Measures many components and, in turn with them, few.
Result measure_beside_few(benchmark::State& state, int components, const Measure& measure) {
  Result result;
  std::vector<double> values;
  std::vector<double> references;
  std::vector<double> allocated;
  for ([[maybe_unused]] auto round : state) {
    const Cost cost = measure(components);
    values.push_back(cost.amount);
    allocated.push_back(cost.allocations);
    if (components != kFew) references.push_back(few(measure));
    state.SetIterationTime(cost.amount * components * 1e-6);
  }
  result.value = median(values);
  result.allocations = median(allocated);
  if (components != kFew) result.reference = median(references);
  return result;
}

void add(const Suite& suite, const std::string& name, const char* unit, std::int64_t rounds,
         const Measure& measure, std::optional<Bound> bound = std::nullopt) {
  for (const int components : {kFew, 1000, kMost}) {
    suite.add(name + "/" + std::to_string(components), rounds, [=](benchmark::State& state) {
      Result result = measure_beside_few(state, components, measure);
      result.unit = unit;
      if (result.allocations == 0.0) result.allocations.reset();
      if (components == kMost) result.bound = bound;
      publish(state, result);
    });
  }
}

}  // namespace

void add_deployments(const Suite& suite) {
  add(suite, "start_per_component", "us", kRounds, start, ratio_at_most(kBound));
  add(suite, "load_per_component", "us", kRounds, load);
  add(suite, "memory_per_component", "bytes", 1, remember);
}

}  // namespace armature::benchmarks
