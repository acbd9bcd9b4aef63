// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "armature/report/trace.hpp"

namespace armature::report {

/// What happened in one cycle (paper 1, figure 20).
struct Timeline {
  /// A stretch of time in which a component ran.
  struct Bar {
    double begin_us = 0.0;  ///< since the cycle's begin
    double length_us = 0.0;
  };
  /// The bars of one component in one thread.
  struct Lane {
    std::string component;
    std::string thread;
    std::vector<Bar> bars;  ///< in the order of their begin
  };
  std::vector<Lane> lanes;  ///< in the order in which they come into play
  double length_us = 0.0;   ///< of the cycle in its thread
  double end_us = 0.0;      ///< of the last bar, which may be another thread's
  std::size_t cycles = 0;   ///< of that thread in the trace
};

/// Finds a cycle to show. Of the thread that had the most to do it is the cycle of median length
/// among those with steps; what other threads did until its next cycle, without a pause of half a
/// period, belongs to it. Empty, if nothing has steps.
Timeline find_timeline(const StepTrace& trace);

}  // namespace armature::report
