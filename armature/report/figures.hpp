// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/report/run_folder.hpp"

namespace armature::report {

/// report.json: the figures of each controller's joints and of the cycle on the bus, exact, for
/// programs. docs/report.md describes it.
std::string figures_json(const Runs& runs);

}  // namespace armature::report
