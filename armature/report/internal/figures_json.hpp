// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "armature/report/internal/json.hpp"
#include "armature/report/run_folder.hpp"

/// Parts of report.json that the page has as well.
namespace armature::report::internal {

Json or_null(const std::optional<double>& value);
Json figures_of(const Joint& joint);
Json figures_of(const Velocity& velocity);
Json figures_of(const Effort& effort);
Json moments_of(const Moments& moments);
/// run.json as it is; null: there is none.
Json summary_of(const Run& run);
/// The time of a cycle on the bus; null: nobody measured it.
Json cycle_of(const Runs& runs);
/// What another program found; null: nothing.
Json found_of(const Runs& runs);
/// What of that is for the page alone, and not in report.json.
inline constexpr const char* kShownOnly[] = {"curves", "ways", "pictures"};
/// All of report.json.
Json report_of(const Runs& runs);

}  // namespace armature::report::internal
