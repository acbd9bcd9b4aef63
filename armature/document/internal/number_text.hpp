// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/types/type.hpp"

/// Numbers as users write them: `0.5`, `10 ms`, `0x7f`, `inf`.
namespace armature::document {

/// Reads a number, with or without a unit, as one of the number type `type` in `unit`, into `at`.
/// @return what is wrong with it, empty if nothing; `at` is then as it was
std::string parse_number(std::string_view text, const types::Type& type, std::string_view unit,
                         void* at);

/// What a user should write for a scalar: `a number in V/rad`, `a whole number`, `text`.
std::string expected_text(const types::Type& type, std::string_view unit);

}  // namespace armature::document
