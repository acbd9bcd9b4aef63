// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "armature/types/type.hpp"

namespace armature::types {

/// Where a number lies in a value, however vectors around it grow and move.
class NumberPlace {
 public:
  /// All numbers of `value`, in order: one of a scalar, several of lists and structs as they are
  /// now. Booleans are 0 and 1, enumerations their numbers; texts have none.
  static std::vector<NumberPlace> all_in(const Type& type, const void* value);

  /// What leads from the value to the number: empty, `[2]`, `.gains.kp`; lists count from 1.
  const std::string& path() const { return path_; }

  /// The number in `value`, which is of the type that the place was found in; NaN where a list is
  /// not so long.
  /// @rt nonblocking, no allocation, O(vectors around it)
  double read(const void* value) const noexcept;

 private:
  /// From a vector that lies at `offset` to one of its elements.
  struct Hop {
    std::size_t offset;
    const Type* vector;
    std::size_t index;
  };
  class Finder;

  std::vector<Hop> hops_;
  std::size_t offset_ = 0;  ///< behind the last hop
  const Type* scalar_ = nullptr;
  std::string path_;
};

}  // namespace armature::types
