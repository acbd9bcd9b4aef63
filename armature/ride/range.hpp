// SPDX-License-Identifier: Apache-2.0
#pragma once

// What rcidl's output says of ranges: `[range(0, 255)]` in the interface language.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "armature/ride/codec.hpp"

namespace armature::ride {

namespace internal {

/// A `char` is a number from -128 to 127, whatever the processor thinks of it.
template <typename T>
using Bound = std::conditional_t<std::is_same_v<T, char>, signed char, T>;

}  // namespace internal

/// True if `value` is not below `low` and not above `high`; NaN never is.
/// @rt nonblocking, no allocation
template <Scalar T>
constexpr bool within(T value, internal::Bound<T> low, internal::Bound<T> high) {
  const auto bounded = static_cast<internal::Bound<T>>(value);
  return bounded >= low && bounded <= high;
}
/// True if each element is.
/// @rt nonblocking, no allocation, O(elements)
template <typename T>
constexpr bool within(const std::vector<T>& values, internal::Bound<T> low,
                      internal::Bound<T> high) {
  return std::all_of(values.begin(), values.end(),
                     [&](T value) { return within(value, low, high); });
}
template <typename T, std::size_t N>
constexpr bool within(const std::array<T, N>& values, internal::Bound<T> low,
                      internal::Bound<T> high) {
  return std::all_of(values.begin(), values.end(),
                     [&](T value) { return within(value, low, high); });
}

/// True if each struct has its members in their ranges, by its own `in_range(const S&)`.
/// @rt nonblocking, no allocation, O(elements)
template <typename Structs>
bool all_in_range(const Structs& structs) {
  return std::all_of(structs.begin(), structs.end(),
                     [](const auto& each) { return in_range(each); });
}

/// What to tell of a parameter that is not `within` its range: `parameter a is 300, expected 0 to
/// 255`.
template <typename T>
std::string outside(std::string_view parameter, const T& value, std::string_view range) {
  std::string text = "parameter " + std::string(parameter);
  if constexpr (std::is_arithmetic_v<T>) {
    text += " is " + std::to_string(value);
  } else {
    text += " has an element outside its range";
  }
  return text + ", expected " + std::string(range);
}

}  // namespace armature::ride
