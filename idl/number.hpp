// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "idl/model.hpp"

namespace armature::idl {

std::string to_text(const Whole& number);

/// One more; of the greatest `unsigned long` itself, which no enum holds.
Whole next(const Whole& number);

/// Decimal digits with a sign or without; nothing if it is something else or too large.
std::optional<Whole> parse_whole(std::string_view text);

/// A finite number in decimal, with a fraction and an exponent or without.
std::optional<double> parse_real(std::string_view text);

/// What a type can hold; `type` is a whole number.
struct WholeLimits {
  Whole least;
  Whole greatest;
};
WholeLimits limits_of(Basic type);

}  // namespace armature::idl
