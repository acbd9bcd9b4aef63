// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/browser/internal/display.hpp"
#include "inspection_types.hpp"

namespace armature::browser::internal {

/// `Generator.moveTo: done`, `...: failed: the axis is stuck`, `...: under way; ...`.
std::string fate_text(const Paper& paper, const remote::CommandStatus& command);

/// `Generator.moveTo  42 % (Ctrl-C cancels)`; empty for none.
std::string progress_text(const std::vector<remote::CommandStatus>& commands);

}  // namespace armature::browser::internal
