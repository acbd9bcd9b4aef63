// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "armature/report/moment_kind.hpp"
#include "armature/report/signals.hpp"

namespace armature::report {

/// What happened at one time; what follows from it at once belongs to it.
struct Moment {
  double time_s = 0.0;                   ///< on the recording's axis
  MomentKind kind = MomentKind::kFault;  ///< the gravest
  std::vector<std::string> told;         ///< `WAM: fault: E-stop, ...`, in the order of time
};

/// What happened in a run, by time.
struct Moments {
  std::vector<Moment> all;   ///< by their time
  std::size_t left_out = 0;  ///< of more than a page can show
};

/// The moments in a run's summary, and those at which the signals `Joint{i}.Armed`, or `Armed{i}`
/// of another component, change: armed when all are, disarmed when the first is not any more.
/// @param summary  the text of run.json; empty: there is none
/// @param zero_s   when the recording's time 0 was on the clock of a real run [s]; else 0
Moments moments_of(const std::string& summary, const Signals& signals, double zero_s);

}  // namespace armature::report
