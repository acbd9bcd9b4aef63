// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "armature/base/time.hpp"
#include "armature/types/type.hpp"

namespace armature::generate::internal {

/// A value as an expression of exactly its C++ type: `400.0`, `std::uint8_t{2}`, `"text"`,
/// `std::vector<double>{1.0, 2.0}`. Nothing for a value of a type that C++ needs a library's header
/// for (structs, enumerations), or that no literal has (an infinity).
std::optional<std::string> literal(const types::Type& type, const void* value);

/// `"text"` with its escapes; with NUL characters `std::string("text", size)`.
std::string text_literal(std::string_view text);

/// `10ms`, in the largest unit that is exact.
std::string duration_literal(base::Duration duration);

}  // namespace armature::generate::internal
