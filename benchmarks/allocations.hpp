// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace armature::benchmarks {

/// Heap allocations of this process so far, by all threads, through `new` or `malloc`.
std::uint64_t allocations();

}  // namespace armature::benchmarks
