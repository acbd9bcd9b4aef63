// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/runner/run_options.hpp"

namespace armature::runner::internal {

/// What the command line of a generated program says.
struct ProgramOptions {
  RunOptions run;
  bool json = false;
  bool help = false;
};

/// The error says which word is wrong.
base::Result<ProgramOptions> parse_options(const std::vector<std::string>& words);

/// What `--help` prints.
std::string help_of(const std::string& program);

}  // namespace armature::runner::internal
