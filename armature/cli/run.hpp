// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/cli/arguments.hpp"
#include "armature/cli/console.hpp"

namespace armature::cli {

/// Runs a deployment until its time is up, it is stopped, or a fault or reaction ends it.
/// @return the exit code
int run(const RunArguments& arguments, Console& console);

}  // namespace armature::cli
