// SPDX-License-Identifier: Apache-2.0
#include "armature/record/internal/utf8.hpp"

#include <algorithm>

namespace armature::record::internal {
namespace {

/// What the first byte says; 0 for one that begins no character.
std::size_t announced_length(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

/// Longer than need be, a surrogate, or beyond the last character: the second byte tells.
bool second_byte_fits(unsigned char first, unsigned char second) {
  if (first == 0xE0) return second >= 0xA0;
  if (first == 0xED) return second < 0xA0;
  if (first == 0xF0) return second >= 0x90;
  return first != 0xF4 || second < 0x90;
}

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

}  // namespace

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = announced_length(first);
  if (length > text.size()) return 0;
  if (length < 2) return length;
  const bool fits = second_byte_fits(first, static_cast<unsigned char>(text[1]));
  return fits && std::ranges::all_of(text.substr(1, length - 1), continues) ? length : 0;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace armature::record::internal
