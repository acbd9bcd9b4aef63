// SPDX-License-Identifier: Apache-2.0
#include "armature/document/internal/number_text.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <system_error>

#include "armature/base/result.hpp"
#include "armature/base/unit.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/types/enum.hpp"

namespace armature::document {
namespace {

using types::Kind;

/// Any 64-bit integer, signed or not, or one that is larger.
struct Whole {
  bool negative = false;
  std::uint64_t magnitude = 0;
  bool too_large = false;
};

template <typename Number, typename... Base>
std::optional<Number> parse_all(std::string_view text, Base... base) {
  Number number{};
  const auto [end, problem] =
      std::from_chars(text.data(), text.data() + text.size(), number, base...);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string number_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// As YAML and C++ spell it.
std::optional<double> parse_infinity(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  if (text != "inf" && text != ".inf") return std::nullopt;
  const double infinity = std::numeric_limits<double>::infinity();
  return negative ? -infinity : infinity;
}

base::Result<double> parse_real(std::string_view text, std::string_view unit) {
  if (const auto plain = parse_all<double>(text); plain && std::isfinite(*plain)) return *plain;
  if (const auto infinity = parse_infinity(text)) return *infinity;
  const base::Result<base::Quantity> quantity = base::parse_quantity(text);
  if (!quantity) return base::Error{quantity.error()};
  const auto& [value, written_unit] = quantity.value();
  if (written_unit.empty()) return value;
  if (unit.empty()) {
    return base::Error{in_quotes(text) + " has the unit " + in_quotes(written_unit) +
                       ", but a plain number is expected"};
  }
  const base::Result<double> converted = base::convert(value, written_unit, unit);
  if (!converted) return base::Error{in_quotes(text) + ": " + converted.error()};
  return converted.value();
}

std::optional<Whole> parse_plain_whole(std::string_view text) {
  const bool negative = text.starts_with('-');
  std::string_view digits = text.substr(negative ? 1 : 0);
  const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
  if (hexadecimal) digits.remove_prefix(2);
  const auto magnitude = parse_all<std::uint64_t>(digits, hexadecimal ? 16 : 10);
  if (magnitude) return Whole{negative, *magnitude};
  const std::string_view all = hexadecimal ? "0123456789abcdefABCDEF" : "0123456789";
  if (digits.empty() || digits.find_first_not_of(all) != std::string_view::npos)
    return std::nullopt;
  return Whole{negative, 0, true};
}

base::Result<Whole> parse_whole(std::string_view text, std::string_view unit) {
  if (const auto plain = parse_plain_whole(text)) return *plain;
  const base::Result<double> real = parse_real(text, unit);
  if (!real) return base::Error{real.error()};
  const double value = real.value();
  constexpr double kLargestExact = 9007199254740992.0;  // 2^53: every whole number up to it
  if (std::trunc(value) != value || std::abs(value) > kLargestExact) {
    const std::string same = number_text(value);
    const bool converted = same != text && !unit.empty();
    return base::Error{"expected a whole number, found " + in_quotes(text) +
                       (converted ? ", which is " + same + " " + std::string(unit) : "")};
  }
  return Whole{value < 0, static_cast<std::uint64_t>(std::abs(value))};
}

template <typename Integer>
std::string store_whole(std::string_view text, std::string_view unit, void* at) {
  const base::Result<Whole> parsed = parse_whole(text, unit);
  if (!parsed) return parsed.error();
  using Limits = std::numeric_limits<Integer>;
  const auto [negative, magnitude, too_large] = parsed.value();
  const auto highest = static_cast<std::uint64_t>(Limits::max());
  const std::uint64_t lowest = Limits::is_signed ? highest + 1 : 0;
  if (too_large || magnitude > (negative ? lowest : highest)) {
    return in_quotes(text) + " is outside " + std::to_string(Limits::min()) + " .. " +
           std::to_string(Limits::max());
  }
  *static_cast<Integer*>(at) = static_cast<Integer>(negative ? 0 - magnitude : magnitude);
  return {};
}

template <typename Real>
std::string store_real(std::string_view text, std::string_view unit, void* at) {
  const base::Result<double> parsed = parse_real(text, unit);
  if (!parsed) return parsed.error();
  const double value = parsed.value();
  const bool too_large = std::isfinite(value) && std::abs(value) > std::numeric_limits<Real>::max();
  if (too_large) return in_quotes(text) + " is too large for a float";
  *static_cast<Real*>(at) = static_cast<Real>(value);
  return {};
}

}  // namespace

std::string parse_number(std::string_view text, const types::Type& type, std::string_view unit,
                         void* at) {
  text = trimmed(text);
  switch (type.kind) {
    case Kind::kInt8:
      return store_whole<std::int8_t>(text, unit, at);
    case Kind::kUint8:
      return store_whole<std::uint8_t>(text, unit, at);
    case Kind::kInt16:
      return store_whole<std::int16_t>(text, unit, at);
    case Kind::kUint16:
      return store_whole<std::uint16_t>(text, unit, at);
    case Kind::kInt32:
      return store_whole<std::int32_t>(text, unit, at);
    case Kind::kUint32:
      return store_whole<std::uint32_t>(text, unit, at);
    case Kind::kInt64:
      return store_whole<std::int64_t>(text, unit, at);
    case Kind::kUint64:
      return store_whole<std::uint64_t>(text, unit, at);
    case Kind::kFloat:
      return store_real<float>(text, unit, at);
    case Kind::kDouble:
      return store_real<double>(text, unit, at);
    default:
      return type.name + " is not a number type";
  }
}

std::string expected_text(const types::Type& type, std::string_view unit) {
  const std::string in_unit = unit.empty() ? "" : " in " + std::string(unit);
  switch (type.kind) {
    case Kind::kBool:
      return "true or false";
    case Kind::kEnum:
      return types::enumerator_list(type);
    case Kind::kText:
    case Kind::kFixedText:
      return "text";
    case Kind::kFloat:
    case Kind::kDouble:
      return "a number" + in_unit;
    default:
      return "a whole number" + in_unit;
  }
}

}  // namespace armature::document
