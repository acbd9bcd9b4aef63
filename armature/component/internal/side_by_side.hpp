// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace armature::component::internal {

/// Memory for components and their ports. What is allocated one after the other lies side by side,
/// away from all other memory, so that a cycle of many components touches few pages.
/// @thread any
void* allocate_side_by_side(std::size_t size);
void free_side_by_side(void* at, std::size_t size);

}  // namespace armature::component::internal
