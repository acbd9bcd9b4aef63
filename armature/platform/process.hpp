// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::platform {

/// The kernel's version text, which names its preemption model.
std::string kernel_version();

/// The machine's name, its system and processor: `robot, Linux 6.1.0 x86_64`.
std::string machine_text();

/// Ends the process at once: nothing is flushed, no destructor runs. For the way out when a thread
/// hangs.
[[noreturn]] void exit_now(int status);

/// Starts this program again, in this process, with variables added to its environment; returns
/// only if that failed. Threads and memory of now are gone.
/// @param arguments  as `main` got them
base::Error start_again(const std::vector<std::string>& arguments,
                        const std::vector<std::pair<std::string, std::string>>& environment);

}  // namespace armature::platform
