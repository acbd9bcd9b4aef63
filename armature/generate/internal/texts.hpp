// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/generate/internal/main_text.hpp"

namespace armature::generate::internal {

/// `application` as a name of a program and a target of CMake: letters, digits, `-` and `_`.
std::string name_of_program(std::string_view application);

/// Builds the program against an installed Armature.
std::string build_text(const Facts& facts);

/// What it is, how it is built and what it needs.
std::string readme_text(const Facts& facts, bool on_hardware);

}  // namespace armature::generate::internal
