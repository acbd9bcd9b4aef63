// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace armature::bundle::internal {

/// How a program ended, and what it has written to its outputs.
struct Ran {
  int code = -1;  ///< -1: it could not be started, and `output` says why
  std::string output;
};

/// Runs a program to its end.
/// @param arguments  the program's path, then its arguments
Ran run_program(std::vector<std::string> arguments);

}  // namespace armature::bundle::internal
