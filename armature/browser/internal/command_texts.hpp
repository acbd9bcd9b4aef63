// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/browser/internal/display.hpp"
#include "armature/inspect/status.hpp"

namespace armature::browser::internal {

/// `Generator.moveTo: done`, `...: failed: the axis is stuck`, `...: under way; ...`.
std::string fate_text(const Paper& paper, const inspect::CommandStatus& command);

/// `Generator.moveTo  42 % (Ctrl-C cancels)`; empty for none.
std::string progress_text(const std::vector<inspect::CommandStatus>& commands);

}  // namespace armature::browser::internal
