// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "armature/types/internal/elements.hpp"
#include "armature/types/internal/text_reader.hpp"

namespace armature::types {
namespace {

using internal::at_offset;
using internal::element_count;
using internal::elements;
using internal::is_list;
using internal::is_text;

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
  switch (type.kind) {
    case Kind::kBool:
      to += *static_cast<const bool*>(value) ? "true" : "false";
      return;
    case Kind::kInt8:
      return append_number<std::int8_t>(value, to);
    case Kind::kUint8:
      return append_number<std::uint8_t>(value, to);
    case Kind::kInt16:
      return append_number<std::int16_t>(value, to);
    case Kind::kUint16:
      return append_number<std::uint16_t>(value, to);
    case Kind::kInt32:
      return append_number<std::int32_t>(value, to);
    case Kind::kUint32:
      return append_number<std::uint32_t>(value, to);
    case Kind::kInt64:
      return append_number<std::int64_t>(value, to);
    case Kind::kUint64:
      return append_number<std::uint64_t>(value, to);
    case Kind::kFloat:
      return append_number<float>(value, to);
    case Kind::kDouble:
      return append_number<double>(value, to);
    default:
      return;
  }
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
