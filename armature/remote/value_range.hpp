// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "armature/types/type.hpp"

namespace armature::remote {

/// Numbers of one type, one behind the other within a value, that are all between two others. NaN
/// is outside of every range.
struct ValueRange {
  std::size_t argument;  ///< which value: among the members of an event; 0 for a port
  std::size_t offset;    ///< of the first within the value
  std::size_t count;
  types::Value low;  ///< of the numbers' type
  types::Value high;

  /// @param value  of the type that has them
  bool holds(const void* value) const;
};

}  // namespace armature::remote
