// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace armature::base {

using Duration = std::chrono::nanoseconds;

/// Marks time points of an application's clock, monotonic or simulated; it cannot be asked for
/// "now" because only the application knows which of the two it runs on.
struct ApplicationClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<ApplicationClock>;
  static constexpr bool is_steady = true;
};

/// A point on the application's clock, in nanoseconds since that clock's start.
using Time = ApplicationClock::time_point;

constexpr Time time_from_ns(std::int64_t ns) { return Time{Duration{ns}}; }
constexpr std::int64_t to_ns(Time time) { return time.time_since_epoch().count(); }

/// `by` after `time`, at most the end of time: a limit of `Duration::max()` never passes.
constexpr Time later(Time time, Duration by) {
  return time > Time{} && by > Time::max() - time ? Time::max() : time + by;
}

/// `10 ms`, `1.5 s`, `250 us`: exact, in the largest unit that needs no exponent.
std::string to_text(Duration duration);

}  // namespace armature::base
