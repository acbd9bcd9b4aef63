// SPDX-License-Identifier: Apache-2.0
#pragma once

// The commands of the program, one function each; every one returns the exit code.

#include <string>

#include "armature/cli/arguments.hpp"
#include "armature/cli/console.hpp"

namespace armature::cli {

/// Runs a deployment until its time is up, it is stopped, or a fault or reaction ends it.
int run(const RunArguments& arguments, Console& console);

/// Commands an application of another process line by line.
int browse(const BrowseArguments& arguments, const Console& console);

/// Finds everything that can be known before start.
int check(const CheckArguments& arguments, const Console& console);

/// Draws the wiring.
int graph(const GraphArguments& arguments, const Console& console);

/// Lists component models, or describes one.
int models(const ModelsArguments& arguments, const Console& console);

/// Rewrites a deployment in the other file's format.
int convert(const std::string& from, const std::string& to, const Console& console);

/// Shows what runs left in a folder, as one HTML page.
int report(const ReportArguments& arguments, const Console& console);

/// Makes a component library to start from, in the current folder.
int new_component(const std::string& name, const Console& console);

}  // namespace armature::cli
