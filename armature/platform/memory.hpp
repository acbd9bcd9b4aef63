// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "armature/base/result.hpp"

namespace armature::platform {

/// Locks all present and future memory of the process, so that no page fault delays a real-time
/// thread; the error says how to get the permission.
base::Result<void> lock_memory();
void unlock_memory();

/// Bytes of physical memory that the process occupies now.
std::size_t resident_bytes();

}  // namespace armature::platform
