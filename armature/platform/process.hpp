// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace armature::platform {

/// The kernel's version text, which names its preemption model.
std::string kernel_version();

/// Ends the process at once: nothing is flushed, no destructor runs. For the way out when a thread
/// hangs.
[[noreturn]] void exit_now(int status);

}  // namespace armature::platform
