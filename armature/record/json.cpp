// SPDX-License-Identifier: Apache-2.0
#include "armature/record/json.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "armature/base/utf8.hpp"
#include "armature/record/internal/json_text.hpp"

namespace armature::record {
namespace {

using types::Field;
using types::Kind;
using types::Type;

template <typename T>
void append_number(const void* value, std::string& to) {
  T number;
  std::memcpy(&number, value, sizeof number);
  std::array<char, 32> digits;
  to.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
}

template <typename T>
void append_float(const void* value, std::string& to) {
  T number;
  std::memcpy(&number, value, sizeof number);
  if (std::isfinite(number)) return append_number<T>(value, to);
  if (std::isnan(number)) {
    to += "null";
  } else {
    if (number < 0) to += '-';
    to += internal::kInfinity;
  }
}

void append_scalar(const Type& type, const void* value, std::string& to) {
  types::with_scalar(type.kind, [&](auto of) {
    using T = typename decltype(of)::type;
    if constexpr (std::is_same_v<T, bool>) {
      to += *static_cast<const bool*>(value) ? "true" : "false";
    } else if constexpr (std::is_floating_point_v<T>) {
      append_float<T>(value, to);
    } else {
      append_number<T>(value, to);
    }
  });
}

void append_value(const Type& type, const void* value, std::string& to);

void append_list(const Type& list, const void* value, std::string& to) {
  const std::size_t count = types::element_count(list, value);
  const std::byte* const first = types::elements(list, value);
  to += '[';
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) to += ',';
    append_value(*list.element, first + i * list.element->size, to);
  }
  to += ']';
}

void append_struct(const Type& type, const void* value, std::string& to) {
  to += '{';
  for (const Field& field : type.fields) {
    if (&field != &type.fields.front()) to += ',';
    internal::append_json_string(field.name, to);
    to += ':';
    append_value(*field.type, types::at_offset(value, field.offset), to);
  }
  to += '}';
}

void append_value(const Type& type, const void* value, std::string& to) {
  if (types::is_text(type)) return internal::append_json_string(type.text(value), to);
  if (types::is_list(type)) return append_list(type, value, to);
  if (type.kind == Kind::kStruct) return append_struct(type, value, to);
  if (type.kind == Kind::kEnum) {
    return internal::append_json_string(types::to_text(type, value), to);
  }
  append_scalar(type, value, to);
}

}  // namespace

namespace internal {

void append_json_string(std::string_view text, std::string& to) {
  constexpr std::string_view kHex = "0123456789abcdef";
  to += '"';
  for (std::size_t at = 0; at < text.size();) {
    const auto character = base::code_point_at(text, at);
    const std::size_t end = character ? character->end : at + 1;
    const auto byte = static_cast<unsigned char>(text[at]);
    if (!character) {
      to += '?';
    } else if (byte == '"' || byte == '\\') {
      to += '\\';
      to += text[at];
    } else if (byte < 0x20) {
      to += "\\u00";
      to += kHex[byte >> 4];
      to += kHex[byte & 15];
    } else {
      to += text.substr(at, end - at);
    }
    at = end;
  }
  to += '"';
}

}  // namespace internal

std::string to_json(const Type& type, const void* value) {
  std::string json;
  if (type.kind == Kind::kStruct) {
    append_value(type, value, json);
  } else {
    json += '{';
    internal::append_json_string(internal::kValueMember, json);
    json += ':';
    append_value(type, value, json);
    json += '}';
  }
  return json;
}

}  // namespace armature::record
