// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/sample_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/component/host.hpp"
#include "armature/controllers/base/sampling_period.hpp"

namespace armature::controllers {
namespace {

constexpr int kMostWrong = 3;
constexpr double kWrong = 0.2;  // of the period
constexpr double kVeryWrong = 0.5;
/// By the clock, what a thread was held up with comes at once.
constexpr double kOfABacklog = 0.9;

}  // namespace

void SampleWatch::begin(base::Duration period) {
  period_ = period;
  measure_ = Measure::kUnknown;
  wrong_in_a_row_ = 0;
}

std::optional<component::Reason> SampleWatch::judge(const component::Component& sampled) {
  const bool is_first = measure_ == Measure::kUnknown;
  measure_ = measure_of(sampled);
  if (measure_ == Measure::kNothing) return std::nullopt;
  const base::Duration now = now_of(sampled, measure_);
  const base::Duration interval = now - std::exchange(last_, now);
  if (is_first) return std::nullopt;
  const double off = base::to_seconds(interval) / base::to_seconds(period_) - 1.0;
  const bool exact = measure_ != Measure::kClock;
  if (!exact && off < -kOfABacklog) return std::nullopt;
  count(off, exact);
  const bool wrong =
      std::abs(wrong_in_a_row_) >= kMostWrong || (exact && std::abs(off) >= kVeryWrong);
  return wrong ? std::optional(reason(interval)) : std::nullopt;
}

/// Of those that are too long and too short, one after the other, the clock says nothing.
void SampleWatch::count(double off, bool any_side) {
  if (std::abs(off) <= kWrong) {
    wrong_in_a_row_ = 0;
  } else if (any_side || off > 0.0) {
    wrong_in_a_row_ = std::max(wrong_in_a_row_, 0) + 1;
  } else {
    wrong_in_a_row_ = std::min(wrong_in_a_row_, 0) - 1;
  }
}

SampleWatch::Measure SampleWatch::measure_of(const component::Component& sampled) {
  const component::ExecutionContext& context = component::Host::context(sampled);
  const component::Component* const owner = sampled.pace().owner;
  const bool own_thread = owner != nullptr && &component::Host::context(*owner) == &context;
  if (own_thread && context.period > base::Duration::zero()) return Measure::kCycles;
  if (context.simulated) return Measure::kExactClock;
  return owner == nullptr ? Measure::kClock : Measure::kNothing;
}

component::Reason SampleWatch::reason(base::Duration interval) const {
  component::Reason why("it is sampled after ");
  append_duration(why, interval).append(", but its period is ");
  return append_duration(why, period_);
}

}  // namespace armature::controllers
