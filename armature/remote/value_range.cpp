// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/value_range.hpp"

#include <algorithm>
#include <span>

#include "armature/types/elements.hpp"

namespace armature::remote {

bool ValueRange::holds(const void* value) const {
  return types::with_scalar(low.type().kind, [&]<typename T>(std::type_identity<T>) {
    const T least = *static_cast<const T*>(low.data());
    const T greatest = *static_cast<const T*>(high.data());
    const std::span all(static_cast<const T*>(types::at_offset(value, offset)), count);
    return std::ranges::all_of(all, [&](T one) { return one >= least && one <= greatest; });
  });
}

}  // namespace armature::remote
