// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/observing/cycle_records.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/platform/clock.hpp"

namespace armature::exec::internal {
namespace {

using component::CycleRecord;

RecordedCycle content_of(const CycleRecord& record) {
  const double tick_ns = platform::tick_period_ns();
  const auto between = [tick_ns](std::uint64_t from, std::uint64_t to) {
    return base::Duration(std::llround(static_cast<double>(to - from) * tick_ns));
  };
  RecordedCycle cycle;
  cycle.number = record.number();
  cycle.time = record.time();
  cycle.length = between(record.begin(), record.end());
  cycle.left_out = record.left_out();
  for (std::size_t i = 0; i < record.count(); ++i) {
    const CycleRecord::Step& step = record.step(i);
    cycle.steps.push_back(
        {step.component, between(record.begin(), step.begin), between(step.begin, step.end)});
  }
  return cycle;
}

base::Error unknown_thread(std::string_view name, const Plan& plan) {
  std::vector<std::string> names;
  for (const ThreadPlan& one : plan.threads) names.push_back(one.name);
  return base::Error{"unknown thread " + base::quoted(std::string(name)) +
                     base::suggestion_in_brackets(std::string(name), names)};
}

}  // namespace

base::Result<RecordedCycle> CycleRecords::look(std::string_view thread) {
  const auto found = std::ranges::find(plan_.threads, thread, &ThreadPlan::name);
  if (found == plan_.threads.end()) return unknown_thread(thread, plan_);
  const auto index = static_cast<Index>(found - plan_.threads.begin());
  Place& place = places_[index];
  if (place.asked && place.record->full()) {
    place.last = content_of(*place.record);
    place.asked = false;
  }
  if (!place.asked) {
    if (const auto asked = ask(index, place); !asked) return base::Error{asked.error()};
  }
  return place.last;
}

/// To a thread that did not take the record in time it still belongs: it may come to it.
base::Result<void> CycleRecords::ask(Index thread, Place& place) {
  const ThreadPlan& plan = plan_.threads[thread];
  if (plan.members.empty()) {
    return base::Error{"the thread " + base::quoted(plan.name) + " runs no component"};
  }
  if (place.record == nullptr) place.record = std::make_shared<CycleRecord>(kMostSteps);
  place.record->empty();
  place.asked = true;
  component::Component& first = *blueprint_.components[plan.members.front()].component;
  Engine& engine = *engines_[thread];
  const auto ask = [&engine, record = place.record] { engine.record_next_cycle(*record); };
  if (!executor_.run_in_thread_of(first, ask)) return base::Error{not_answered(first)};
  return {};
}

std::vector<std::shared_ptr<CycleRecord>> CycleRecords::give_away() {
  std::vector<std::shared_ptr<CycleRecord>> all;
  for (auto& [thread, place] : places_) all.push_back(std::move(place.record));
  places_.clear();
  return all;
}

}  // namespace armature::exec::internal
