// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "armature/base/result.hpp"

namespace armature::platform {

/// Keeps all memory of the process, present and future, in place once it was touched, so that no
/// page fault delays a real-time thread again; freed memory is kept too, since giving it back to
/// the system interrupts all threads. The error says how to get the permission.
base::Result<void> lock_memory();
void unlock_memory();

/// Touches the memory that the process has code and data in, so that it is there when a real-time
/// thread needs it: a buffer that was reserved and never written, a function never called. Leaves
/// out what none of them uses: the stacks of all threads, and mappings above 256 MB.
void populate_memory();

/// Gives back the physical memory, locked or not, of the code of the loaded shared objects whose
/// file names begin with one of `libraries`: for code that no real-time thread runs. Whoever calls
/// it again waits until the system has read it from the file.
void release_code(std::span<const std::string_view> libraries);

/// Bytes of physical memory that the process occupies now.
std::size_t resident_bytes();

}  // namespace armature::platform
