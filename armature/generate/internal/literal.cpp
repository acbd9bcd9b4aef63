// SPDX-License-Identifier: Apache-2.0
#include "armature/generate/internal/literal.hpp"

#include <cstdint>

#include "armature/types/elements.hpp"

namespace armature::generate::internal {
namespace {

using types::Kind;
using types::Type;

std::string_view name_of_scalar(Kind kind) {
  switch (kind) {
    case Kind::kBool:
      return "bool";
    case Kind::kInt8:
      return "std::int8_t";
    case Kind::kUint8:
      return "std::uint8_t";
    case Kind::kInt16:
      return "std::int16_t";
    case Kind::kUint16:
      return "std::uint16_t";
    case Kind::kInt32:
      return "int";
    case Kind::kUint32:
      return "std::uint32_t";
    case Kind::kInt64:
      return "std::int64_t";
    case Kind::kUint64:
      return "std::uint64_t";
    case Kind::kFloat:
      return "float";
    case Kind::kDouble:
      return "double";
    case Kind::kText:
      return "std::string";
    default:
      return {};
  }
}

bool is_floating(Kind kind) { return kind == Kind::kFloat || kind == Kind::kDouble; }

/// The smallest integers are an operator and a number that is too large.
bool is_smallest(std::string_view digits) {
  return digits == "-2147483648" || digits == "-9223372036854775808";
}

/// @param inside  braces that name its type
std::optional<std::string> scalar(const Type& type, const void* value, bool inside) {
  std::string text = types::to_text(type, value);
  if (type.kind == Kind::kText) return text_literal(text);
  if (is_floating(type.kind)) {
    if (text.find_first_of("ni") != std::string::npos) return std::nullopt;  // inf, nan
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return type.kind == Kind::kFloat ? text + 'f' : text;
  }
  if (is_smallest(text)) return std::nullopt;
  const bool wide = type.kind == Kind::kUint64 || type.kind == Kind::kUint32;
  if (wide) text += 'u';
  if (inside || type.kind == Kind::kBool || type.kind == Kind::kInt32) return text;
  return std::string(name_of_scalar(type.kind)) + '{' + text + '}';
}

}  // namespace

std::optional<std::string> literal(const Type& type, const void* value) {
  if (!name_of_scalar(type.kind).empty()) return scalar(type, value, false);
  if (type.kind != Kind::kVector && type.kind != Kind::kArray) return std::nullopt;
  const std::string element(name_of_scalar(type.element->kind));
  if (element.empty()) return std::nullopt;
  std::string text = type.kind == Kind::kVector
                         ? "std::vector<" + element + ">{"
                         : "std::array<" + element + ", " + std::to_string(type.count) + ">{";
  const std::size_t count = types::element_count(type, value);
  const std::byte* const first = types::elements(type, value);
  for (std::size_t i = 0; i < count; ++i) {
    const auto one = scalar(*type.element, first + i * type.element->size, true);
    if (!one) return std::nullopt;
    text += (i == 0 ? "" : ", ") + *one;
  }
  return text + '}';
}

std::string text_literal(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (byte < 0x20 || byte == 0x7f) {
      quoted += '\\';
      for (const int shift : {6, 3, 0}) quoted += static_cast<char>('0' + ((byte >> shift) & 7));
    } else {
      quoted += c;
    }
  }
  quoted += '"';
  if (text.find('\0') == std::string_view::npos) return quoted;
  return "std::string(" + quoted + ", " + std::to_string(text.size()) + ')';
}

std::string duration_literal(base::Duration duration) {
  struct Unit {
    std::int64_t ns;
    const char* name;
  };
  constexpr Unit kUnits[] = {{1'000'000'000, "s"}, {1'000'000, "ms"}, {1'000, "us"}};
  const std::int64_t ns = duration.count();
  for (const Unit& unit : kUnits) {
    if (ns % unit.ns == 0) return std::to_string(ns / unit.ns) + unit.name;
  }
  return std::to_string(ns) + "ns";
}

}  // namespace armature::generate::internal
