// SPDX-License-Identifier: Apache-2.0
#pragma once

// Values between what an operator types and reads, and the text that goes to another process.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/inspect/describe.hpp"

namespace armature::browser::internal {

/// A value as it is typed, `{1, 2}`, `array(1, 2)`, `{x = 1, y = 2}`, `'left'`, as the text
/// that files have: `[1, 2]`, `{x: 1, y: 2}`, `left`. What is neither list nor text stays as it is.
base::Result<std::string> as_in_files(std::string_view typed);

/// `Generator:moveTo({1, 1}, 10)`.
struct TypedCall {
  std::string component;
  std::string operation;
  std::vector<std::string> arguments;  ///< as files have them
};
/// True if `line` looks like a call: `Name:name(`.
bool is_call(std::string_view line);
/// The error says what is not as it should be.
base::Result<TypedCall> parse_call(std::string_view line);

/// A value of a type for people: shorter numbers, the first elements of a long list, units of the
/// members of structs.
/// @param type    its name
/// @param fields  of the structs that may be in it
std::string for_people(std::string_view text, const std::string& type,
                       const std::vector<inspect::FieldDescription>& fields,
                       std::size_t most_elements);

}  // namespace armature::browser::internal
