// SPDX-License-Identifier: Apache-2.0
#pragma once

// What rcidl's output says of ranges: `[range(0, 255)]` in the interface language.

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "armature/ride/codec.hpp"
#include "armature/types/type.hpp"

namespace armature::ride {

namespace internal {

/// A `char` is a number from -128 to 127, whatever the processor thinks of it.
template <typename T>
using Bound = std::conditional_t<std::is_same_v<T, char>, signed char, T>;

/// What a range is of: a number, or the elements of an array.
template <typename T>
struct ElementOf {
  using Type = T;
};
template <typename T>
struct ElementOf<std::vector<T>> {
  using Type = T;
};
template <typename T, std::size_t N>
struct ElementOf<std::array<T, N>> {
  using Type = T;
};

/// As short as it can be said.
template <Scalar T>
std::string digits_of(T value) {
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), Bound<T>(value)).ptr;
  return {digits, end};
}

template <Scalar T>
std::string range_of(T low, T high) {
  return digits_of(low) + " to " + digits_of(high);
}

/// `Pose.x`
inline std::string name_of_member(const types::Type& type, const void* structure,
                                  const void* member) {
  const auto offset =
      static_cast<const std::byte*>(member) - static_cast<const std::byte*>(structure);
  const auto field =
      std::ranges::find(type.fields, static_cast<std::size_t>(offset), &types::Field::offset);
  return type.name + "." + std::string(field == type.fields.end() ? "?" : field->name);
}

}  // namespace internal

/// Of a value with a range, or of the elements of an array.
template <typename T>
using BoundOf = internal::Bound<typename internal::ElementOf<T>::Type>;

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

/// What to tell of a value that is not `within` its range: ` is 300, expected 0 to 255`.
template <typename T>
std::string outside(const T& value, std::string_view range) {
  std::string text = " has an element outside its range";
  if constexpr (Scalar<T>) text = " is " + internal::digits_of(value);
  return text + ", expected " + std::string(range);
}
/// The same of a parameter: `parameter a is 300, expected 0 to 255`.
template <typename T>
std::string outside(std::string_view parameter, const T& value, std::string_view range) {
  return "parameter " + std::string(parameter) + outside(value, range);
}

template <typename T, typename Low, typename High>
bool Decoder::expect_within(const char* parameter, const T& value, Low low, High high) {
  const auto least = static_cast<BoundOf<T>>(low);
  const auto most = static_cast<BoundOf<T>>(high);
  if (ride::within(value, least, most)) return true;
  problem_ = outside(parameter, value, internal::range_of(least, most));
  return fail();
}

template <typename T, typename Low, typename High, typename S>
bool Decoder::within(const T& member, Low low, High high, const S& structure) {
  const auto least = static_cast<BoundOf<T>>(low);
  const auto most = static_cast<BoundOf<T>>(high);
  if (ride::within(member, least, most)) return true;
  problem_ = "member " + internal::name_of_member(types::type_of<S>(), &structure, &member) +
             outside(member, internal::range_of(least, most));
  return fail();
}

}  // namespace armature::ride
