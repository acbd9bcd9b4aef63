// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/report/trace.hpp"

namespace armature::report {

/// A part of each cycle, and how long it took elsewhere (paper 1, figure 20).
struct Phase {
  std::string name;
  std::vector<std::string> components{};  ///< whose steps are its computing
  std::string after{};                    ///< only from this component's first step in a cycle on
  std::string before{};                   ///< only until this one's; empty: no bound
  std::string bus{};  ///< where its time on the bus [us] is in report.json, as a
                      ///< JSON pointer; empty: it does not use the bus
  std::optional<double> elsewhere_us{};
};

/// Of the cycles of all runs in a folder.
struct Phases {
  std::string elsewhere;  ///< whose the other times are
  std::vector<Phase> all;
};

/// The phases in a text of JSON, docs/report.md says how they are written; empty of an empty text.
/// @param diagnostics  what is wrong in which phase, and what was expected
Phases parse_phases(const std::string& text, const std::string& file,
                    base::Diagnostics& diagnostics);

/// How long its components took in a cycle [us], without what they called: the median of the
/// busiest thread's cycles with steps. None: no component of it ran.
std::optional<double> computing_of(const Phase& phase, const StepTrace& trace);

}  // namespace armature::report
