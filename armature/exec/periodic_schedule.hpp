// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "armature/base/time.hpp"

namespace armature::exec {

/// The account of a periodic thread: which cycles are due, which were run and which left out. Cycle
/// k is due at `begin + k * period`, k = 1, 2, ...; so at any time after `settle`,
/// (elapsed time) / period == cycles run + cycles skipped, exactly.
class PeriodicSchedule {
 public:
  /// What to do now.
  struct Due {
    std::uint64_t run = 0;      ///< cycles to run now
    std::uint64_t skipped = 0;  ///< cycles that are left out
    base::Duration lateness{};  ///< since the first of them was due
  };

  PeriodicSchedule(base::Duration period, bool catch_up) : period_(period), catch_up_(catch_up) {}

  /// Cycles come at these times, in their order, instead of once a period; none is late.
  /// @param times  not empty
  void follow(std::vector<base::Time> times) { recorded_ = std::move(times); }

  void begin(base::Time start) {
    next_ = recorded_.empty() ? start + period_ : recorded_.front();
    run_ = 0;
    skipped_ = 0;
    late_in_a_row_ = 0;
  }

  base::Time next() const { return next_; }

  /// Takes the account to `now`. If more than one cycle is due, all but one are skipped, or all are
  /// run if the policy is to catch up.
  /// @rt nonblocking
  Due settle(base::Time now) {
    if (now < next_) return {};
    if (!recorded_.empty()) return take_recorded();
    Due due;
    due.lateness = now - next_;
    const bool in_time = due.lateness < period_;  // mostly, and a division takes its time
    const auto cycles = in_time ? 1 : static_cast<std::uint64_t>(due.lateness / period_) + 1;
    due.run = catch_up_ ? cycles : 1;
    due.skipped = cycles - due.run;
    next_ += static_cast<std::int64_t>(cycles) * period_;
    run_ += due.run;
    skipped_ += due.skipped;
    late_in_a_row_ = cycles > 1 ? late_in_a_row_ + 1 : 0;
    return due;
  }

  std::uint64_t cycles_run() const { return run_; }
  std::uint64_t cycles_skipped() const { return skipped_; }
  /// Wake-ups in a row that came late by a period or more.
  int late_in_a_row() const { return late_in_a_row_; }

 private:
  Due take_recorded() {
    ++run_;
    next_ = run_ < recorded_.size() ? recorded_[run_] : base::Time::max();
    return {.run = 1};
  }

  base::Duration period_;
  bool catch_up_;
  std::vector<base::Time> recorded_;
  base::Time next_{};
  std::uint64_t run_ = 0;
  std::uint64_t skipped_ = 0;
  int late_in_a_row_ = 0;
};

}  // namespace armature::exec
