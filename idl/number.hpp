// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "idl/model.hpp"

namespace armature::idl {

/// A whole number between the least `long` and the greatest `unsigned long`.
struct Whole {
  bool negative = false;
  std::uint64_t magnitude = 0;

  friend bool operator==(const Whole&, const Whole&) = default;
  friend bool operator<(const Whole& a, const Whole& b) {
    if (a.negative != b.negative) return a.negative;
    return a.negative ? a.magnitude > b.magnitude : a.magnitude < b.magnitude;
  }
};

std::string to_text(const Whole& number);

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
