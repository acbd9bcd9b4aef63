// SPDX-License-Identifier: Apache-2.0
#include "idl/number.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace armature::idl {
namespace {

template <typename T>
std::optional<T> parse_all(std::string_view text) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  return value;
}

template <typename T>
WholeLimits limits() {
  const auto greatest = static_cast<std::uint64_t>(std::numeric_limits<T>::max());
  if constexpr (std::numeric_limits<T>::is_signed) return {{true, greatest + 1}, {false, greatest}};
  return {{false, 0}, {false, greatest}};
}

}  // namespace

std::string to_text(const Whole& number) {
  return (number.negative ? "-" : "") + std::to_string(number.magnitude);
}

Whole next(const Whole& number) {
  if (number.negative) return {number.magnitude > 1, number.magnitude - 1};
  const bool most = number.magnitude == std::numeric_limits<std::uint64_t>::max();
  return {false, number.magnitude + (most ? 0 : 1)};
}

std::optional<Whole> parse_whole(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const auto magnitude = parse_all<std::uint64_t>(text);
  constexpr std::uint64_t kMostBelowZero = std::uint64_t{1} << 63;
  if (!magnitude || (negative && *magnitude > kMostBelowZero)) return std::nullopt;
  return Whole{negative && *magnitude > 0, *magnitude};
}

std::optional<double> parse_real(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto value = parse_all<double>(text);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return value;
}

WholeLimits limits_of(Basic type) {
  switch (type) {
    case Basic::kChar:
      return limits<std::int8_t>();
    case Basic::kByte:
      return limits<std::uint8_t>();
    case Basic::kShort:
      return limits<std::int16_t>();
    case Basic::kUnsignedShort:
      return limits<std::uint16_t>();
    case Basic::kInt:
      return limits<std::int32_t>();
    case Basic::kUnsignedInt:
      return limits<std::uint32_t>();
    case Basic::kLong:
      return limits<std::int64_t>();
    default:
      return limits<std::uint64_t>();
  }
}

}  // namespace armature::idl
