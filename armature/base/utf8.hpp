// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace armature::base {

/// The code point that begins at `at`, and where the next one begins; nothing if it is not UTF-8.
struct CodePoint {
  char32_t value;
  std::size_t end;
};
std::optional<CodePoint> code_point_at(std::string_view text, std::size_t at);

/// The first byte that is not UTF-8; `text.size()` if all of it is.
std::size_t valid_utf8_length(std::string_view text);

/// Whether `text` is UTF-8 as RFC 3629 has it: no overlong form, no surrogate, nothing above
/// U+10FFFF.
/// @rt nonblocking, no allocation, O(bytes)
bool is_utf8(std::string_view text);

/// Whether `byte` of UTF-8 belongs to the character of the byte before.
constexpr bool continues_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// How many characters UTF-8 has, where each counts one, wide and combining ones too.
std::size_t character_count(std::string_view text);

/// How many columns valid UTF-8 takes on a terminal: wide characters take two, combining ones none.
std::size_t columns_of(std::string_view text);

}  // namespace armature::base
