// SPDX-License-Identifier: Apache-2.0
// How often what may break breaks, and a table of what came of it.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "tests/campaign/runs.hpp"

namespace armature::wam {

/// Cycles of which the black box of a fault has states and commands.
constexpr std::size_t kCyclesKept = 500;

/// What all runs of a breakage had at most.
struct CampaignFigures : campaign::Account {
  double step = 0.0;
  double torque = 0.0;
  double moved = 0.0;
  double sinking = 0.0;
  std::optional<std::size_t> cycles_kept;  ///< the least, before a fault
};
std::map<std::string, CampaignFigures>& campaign_table();

/// Of the deployment whose turn it is.
const char* campaign_file(int run, bool with_wrist);

/// Calls `run` with the number of each run, which is its seed, within a test. A run that fails does
/// not keep the others from being made.
void make_runs(const std::string& name, const std::function<void(int)>& run);

}  // namespace armature::wam
