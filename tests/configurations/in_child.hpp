// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace armature::configurations {

/// What a child process wrote, or how it ended otherwise.
struct ChildEnd {
  std::string written;
  std::string problem;  ///< `it was killed by signal 11`; empty if it ended by itself
};

/// Runs `work` in a process of its own, with bounds for its memory and the processor's time, and
/// takes what it returns.
ChildEnd run_in_child(const std::function<std::string()>& work);

}  // namespace armature::configurations
