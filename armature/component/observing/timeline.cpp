// SPDX-License-Identifier: Apache-2.0
#include "armature/component/observing/timeline.hpp"

#include "armature/rt/ticks.hpp"

namespace armature::component {
namespace {

// What things cost the observed thread, the caches that they use included; timeline_on/N of the
// benchmarks shows whether these are right.
constexpr double kStretchCostNs = 30.0;
constexpr double kStepCostNs = 150.0;

std::int64_t in_ticks(double ns) {
  return static_cast<std::int64_t>(ns / rt::tick_period_ns()) + 1;
}

}  // namespace

Timeline::Timeline(const Limits& limits)
    : burst_(in_ticks(static_cast<double>(limits.burst.count()))),
      stretch_cost_(in_ticks(kStretchCostNs)),
      step_cost_(in_ticks(kStepCostNs)),
      share_(limits.share),
      budget_(burst_),
      ring_(limits.capacity, rt::WhenFull::kDropNewest, Entry{}) {}

void Timeline::open(std::uint16_t thread, base::Time now, std::uint64_t tick) noexcept {
  if (earned_until_ == 0) earned_until_ = tick;
  const auto elapsed = static_cast<double>(tick - std::exchange(earned_until_, tick));
  // A cycle that cost more than the burst is paid for like any other, later.
  const std::int64_t most = std::max(burst_, 2 * (stretch_cost_ + steps_cost_));
  budget_ = std::min(most, budget_ + static_cast<std::int64_t>(elapsed * share_));
  Entry entry;
  entry.kind = Entry::Kind::kOpen;
  entry.thread = thread;
  entry.missing = missing_;
  entry.begin = tick;
  entry.time = now;
  kept_ = budget_ >= stretch_cost_ && push(entry);
  missing_ = kept_ ? 0 : missing_ + 1;
}

void Timeline::close(std::uint64_t tick, std::uint64_t number, base::Time cycle_time, bool cycle,
                     bool detailed) noexcept {
  if (!std::exchange(kept_, false)) return;
  finish_step();
  const std::int64_t steps_cost = std::exchange(steps_, 0) * step_cost_;
  if (detailed && cycle) steps_cost_ = steps_cost;
  budget_ -= stretch_cost_ + steps_cost;
  Entry entry;
  entry.kind = Entry::Kind::kClose;
  entry.cycle = cycle;
  entry.detailed = detailed;
  entry.begin = number;
  entry.end = tick;
  entry.time = cycle_time;
  push(entry);
}

bool Timeline::push(const Entry& entry) noexcept {
  if (ring_.push(entry) == rt::PushResult::kTaken) {
    ++pushed_;
    return true;
  }
  dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  return false;
}

}  // namespace armature::component
