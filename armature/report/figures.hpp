// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"
#include "armature/report/run_folder.hpp"

namespace armature::report {

/// report.json: the figures of each controller's joints and of the cycle on the bus, exact, for
/// programs. docs/report.md describes it.
std::string figures_json(const Runs& runs);

/// What the page shows, as JSON that may stand within HTML: the same figures, curves with as many
/// points as a screen can show, timelines and summaries.
std::string page_json(const Runs& runs);

}  // namespace armature::report
