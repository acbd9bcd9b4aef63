// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace armature::platform {

/// Memory in whole pages that is the system's again as soon as it is let go of: what large and
/// short-lived things took does not stay with the process.
/// @param at      what an earlier call gave, or nullptr
/// @param before  its size [byte], 0 for nullptr
/// @param after   the size that is wanted [byte]; 0 lets go of it
/// @return where it is now, with its bytes as they were; nullptr if there is no memory (then `at`
///   is as it was) or `after` is 0
/// @thread any
void* resize_pages(void* at, std::size_t before, std::size_t after) noexcept;

}  // namespace armature::platform
