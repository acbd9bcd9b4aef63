// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::report {

/// What ran when, of a trace of `armature run --trace`, in Chrome's format: complete events ("X")
/// of the category `cycle`, and of the category `step` for what components did, named after them.
struct StepTrace {
  /// A stretch of time on the application's clock.
  struct Event {
    std::string name;
    double begin_us = 0.0;
    double length_us = 0.0;
    long long thread = 0;

    double end_us() const { return begin_us + length_us; }
  };

  std::vector<Event> steps;  ///< by their begin, as the next
  std::vector<Event> cycles;
  std::map<long long, std::string> threads;

  /// Those that begin between the two times, the second not included [us].
  std::span<const Event> steps_between(double begin_us, double end_us) const;
};

/// Reads a trace; one that was cut off is read as far as it goes.
/// @param file  the name for errors, which say what was expected
base::Result<StepTrace> parse_trace(const std::string& text, const std::string& file);

/// A cycle, and what other threads did until the next one.
struct TracedCycle {
  StepTrace::Event cycle;
  double next_us = 0.0;  ///< when the thread's next cycle begins; its own end, if it is the last
  bool whole = false;    ///< it has steps, and a next one that ends it, or is the only one
};

/// The cycles of the thread that had the most to do, by their begin; empty if nothing has steps.
std::vector<TracedCycle> cycles_of_busiest(const StepTrace& trace);

}  // namespace armature::report
