// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"

namespace armature::report {

/// A figure that runs are to reach.
struct Goal {
  std::string name;
  std::string unit;
  std::string figure;  ///< where it is in report.json: a JSON pointer, /io/wam7/computing_us
  std::string over;    ///< another, by which the first is divided; empty: none
  std::optional<double> most;
  std::optional<double> least;  ///< either this or the other
};

/// The goals in a text of JSON, docs/report.md says how they are written; empty of an empty text.
/// @param diagnostics  what is wrong in which goal, and what was expected
std::vector<Goal> parse_goals(const std::string& text, const std::string& file,
                              base::Diagnostics& diagnostics);

/// What became of a goal.
struct Reached {
  std::optional<double> value;  ///< none: report.json does not have the figure
  bool reached = false;
};

/// @param report  the text of report.json
Reached look_up(const Goal& goal, const std::string& report);

}  // namespace armature::report
