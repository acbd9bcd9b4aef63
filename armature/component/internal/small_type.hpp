// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "armature/types/type.hpp"

namespace armature::component::internal {

/// What `is_small` is for a type that is known by its description only.
inline bool is_small_type(const types::Type& type) {
  constexpr std::size_t kLargestSmall = 256;
  return type.fixed_size() && type.size <= kLargestSmall && type.alignment <= sizeof(void*);
}

}  // namespace armature::component::internal
