// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "armature/report/run_folder.hpp"

namespace armature::report {

/// With the code of the page less than the 3 MB that a phone opens and a mail carries.
inline constexpr std::size_t kMostPageData = 2'700'000;

/// The applications that ran; of runs without a summary the folder's name.
std::string title_of(const Runs& runs);

/// What the page shows, as JSON that may stand within HTML: the figures of report.json, timelines,
/// summaries, and curves with as many points as a screen can show.
/// @param most  [bytes] curves are thinned until all fits, each to a hundred points at least
std::string page_json(const Runs& runs, std::size_t most = kMostPageData);

}  // namespace armature::report
