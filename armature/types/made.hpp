// SPDX-License-Identifier: Apache-2.0
#pragma once

// Types that are known when a program runs, not when it is compiled: of an interface that a file
// describes. They are laid out as C++ lays them out, so a struct that C++ describes by the same
// name and fields is the same type (`same_type`).
//
// The same description gives the same type each time, which lives as long as the program.
// @thread any

#include <cstddef>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/types/type.hpp"

namespace armature::types {

/// The most bytes of an array or a struct that is made while the program runs.
inline constexpr std::size_t kLargestMade = 4096;

/// A field of a struct that is made.
struct MadeField {
  std::string name;
  const Type* type = nullptr;
  std::string unit{};
  std::string doc{};
};

/// A struct of at least one field. The error: a field holds a text or list that grows, the struct
/// has more than kLargestMade bytes, or a size that 128 before it did not have.
base::Result<const Type*> made_struct(const std::string& name,
                                      const std::vector<MadeField>& fields);

/// `count` elements, at least one; the errors are those of a struct.
base::Result<const Type*> made_array(const Type& element, std::size_t count);

/// A list of numbers, bools, enumerations or texts; the error: of anything else.
base::Result<const Type*> made_vector(const Type& element);

/// An enumeration that is stored as `underlying`; one of its values is 0.
const Type& made_enum(const std::string& name, const Type& underlying,
                      const std::vector<Enumerator>& enumerators);

}  // namespace armature::types
