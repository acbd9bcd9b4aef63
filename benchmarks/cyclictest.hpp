// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/base/time.hpp"

namespace armature::benchmarks {

/// Cyclictest (Debian package rt-tests) is installed and may run with this priority.
bool cyclictest_runs(int priority);

/// Runs one thread of cyclictest, memory locked, and returns its latencies [ns], sorted. Throws if
/// it does not run.
/// @param priority  of SCHED_FIFO; 0: the ordinary scheduler
std::vector<double> run_cyclictest(base::Duration period, base::Duration duration, int priority);

/// The same by a loop of our own that sleeps until absolute times, where cyclictest is missing.
std::vector<double> run_sleeping_loop(base::Duration period, base::Duration duration, int priority);

}  // namespace armature::benchmarks
