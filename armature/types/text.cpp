// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "armature/types/elements.hpp"
#include "armature/types/enum.hpp"
#include "armature/types/internal/text_reader.hpp"

namespace armature::types {
namespace {

template <typename T>
void append_number(const void* value, std::string& to) {
  T number;
  std::memcpy(&number, value, sizeof(number));
  if constexpr (std::is_floating_point_v<T>) {
    if (std::isnan(number)) number = std::numeric_limits<T>::quiet_NaN();
  }
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  to.append(digits.data(), end);
}

void append_scalar(const Type& type, const void* value, std::string& to) {
  if (type.kind == Kind::kEnum) {
    const std::string_view name = enumerator_name(type, value);
    if (name.empty()) return append_scalar(*type.underlying, value, to);
    to += name;
    return;
  }
  with_scalar(type.kind, [&](auto of) {
    using T = typename decltype(of)::type;
    if constexpr (std::is_same_v<T, bool>) {
      to += *static_cast<const bool*>(value) ? "true" : "false";
    } else {
      append_number<T>(value, to);
    }
  });
}

void append_quoted(std::string_view text, std::string& to) {
  constexpr std::string_view kHex = "0123456789abcdef";
  to += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      to += '\\';
      to += c;
    } else if (c == '\n') {
      to += "\\n";
    } else if (c == '\t') {
      to += "\\t";
    } else if (byte < 0x20 || byte == 0x7f) {
      to += "\\x";
      to += kHex[byte >> 4];
      to += kHex[byte & 15];
    } else {
      to += c;
    }
  }
  to += '"';
}

void append_value(const Type& type, const void* value, std::string& to);

void append_list(const Type& list, const void* value, std::string& to) {
  const std::size_t count = element_count(list, value);
  const std::byte* first = elements(list, value);
  to += '[';
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) to += ", ";
    append_value(*list.element, first + i * list.element->size, to);
  }
  to += ']';
}

void append_struct(const Type& type, const void* value, std::string& to) {
  to += '{';
  for (const Field& field : type.fields) {
    if (&field != &type.fields.front()) to += ", ";
    to += field.name;
    to += ": ";
    append_value(*field.type, at_offset(value, field.offset), to);
  }
  to += '}';
}

void append_value(const Type& type, const void* value, std::string& to) {
  if (is_text(type)) return append_quoted(type.text(value), to);
  if (is_list(type)) return append_list(type, value, to);
  if (type.kind == Kind::kStruct) return append_struct(type, value, to);
  append_scalar(type, value, to);
}

}  // namespace

std::string to_text(const Type& type, const void* value) {
  std::string text;
  if (is_text(type)) {
    text = type.text(value);
  } else {
    append_value(type, value, text);
  }
  return text;
}

base::Result<void> from_text(const Type& type, std::string_view text, void* value) {
  internal::TextReader check(text);
  if (!check.read_whole(type, nullptr)) return base::Error{check.problem()};
  internal::TextReader(text).read_whole(type, value);
  return {};
}

}  // namespace armature::types
