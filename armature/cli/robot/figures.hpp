// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace armature::cli {

/// The nearest number with three figures.
inline double rounded(double number) {
  if (number == 0.0 || !std::isfinite(number)) return number;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(number))) - 2.0);
  return std::round(number / unit) * unit;
}

/// The nearest number with two figures that is not farther from 0.
inline double rounded_down(double number) {
  if (number == 0.0 || !std::isfinite(number)) return number;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(number))) - 1.0);
  return std::trunc(number / unit) * unit;
}

/// With six figures at most, and a dot whatever the system's language is: `0.5`, `1e-05`.
inline std::string figures_of(double number) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::general, 6);
  return {text.data(), end.ptr};
}

}  // namespace armature::cli
