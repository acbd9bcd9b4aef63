// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"
#include "armature/component/host.hpp"
#include "armature/component/outcome.hpp"

namespace armature::controllers {

/// Stands before the hardware and measures the interval between samples: beyond 20 % off the period
/// for three in a row, or 50 % once, they come otherwise than everything is computed for.
///
/// How late a thread wakes says nothing about its period, so an interval is counted in cycles of
/// the thread that determines the period: a Sample that comes twice in a cycle, or not in each, is
/// wrong, and cycles that this thread skips are its own matter (`overrun`). Where nobody periodic
/// determines it, the clock measures: in simulated time exactly, in real time three in a row count
/// that are wrong to the same side, but not what comes at once since the thread was held up. In
/// another thread than that of the period, only simulated time measures.
class SampleWatch {
 public:
  /// @param period  > 0
  void begin(base::Duration period);

  /// A sample is taken now.
  /// @return why it may not go on
  /// @rt nonblocking, no allocation
  /// @thread that of `sampled`
  std::optional<component::Reason> sample(const component::Component& sampled) {
    if (is_exact(sampled)) [[likely]]
      return std::nullopt;
    return judge(sampled);
  }

 private:
  enum class Measure : std::uint8_t { kUnknown, kNothing, kCycles, kExactClock, kClock };

  /// Exactly a period after the one before, as nearly all are: to see that costs a subtraction.
  bool is_exact(const component::Component& sampled) {
    if (measure_ <= Measure::kNothing) return measure_ == Measure::kNothing;
    const base::Duration now = now_of(sampled, measure_);
    if (now - last_ != period_ || wrong_in_a_row_ != 0) return false;
    last_ = now;
    return true;
  }
  std::optional<component::Reason> judge(const component::Component& sampled);
  static Measure measure_of(const component::Component& sampled);
  static base::Duration now_of(const component::Component& sampled, Measure measure) {
    if (measure != Measure::kCycles) return sampled.time().time_since_epoch();
    const component::ExecutionContext& context = component::Host::context(sampled);
    return static_cast<std::int64_t>(context.cycle) * context.period;
  }
  void count(double off, bool any_side);
  component::Reason reason(base::Duration interval) const;

  base::Duration period_{};
  base::Duration last_{};   ///< once the measure is known
  int wrong_in_a_row_ = 0;  ///< < 0: too short ones
  Measure measure_ = Measure::kUnknown;
};

}  // namespace armature::controllers
