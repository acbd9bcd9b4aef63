// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace armature::ride {

inline constexpr std::size_t kWord = 8;

/// Whether eight bytes of ASCII come first: a long text takes an eighth of the time.
constexpr bool is_ascii_word(std::string_view text) {
  if (text.size() < kWord) return false;
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < kWord; ++i) {
    word |= std::uint64_t{static_cast<unsigned char>(text[i])} << (8 * i);
  }
  return (word & 0x8080808080808080u) == 0;
}

/// Whether `text` is UTF-8 as RFC 3629 has it: no overlong form, no surrogate, nothing above
/// U+10FFFF.
/// @rt nonblocking, no allocation, O(bytes)
constexpr bool is_utf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    if (is_ascii_word(text.substr(at))) {
      at += kWord;
      continue;
    }
    const auto byte = [&](std::size_t i) {
      return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
    };
    const unsigned first = byte(0);
    if (first < 0x80) {
      ++at;
      continue;
    }
    const std::size_t size = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (first < 0xc2 || first > 0xf4) return false;
    // The second byte is where overlong forms, surrogates and too large numbers show.
    const unsigned lowest = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned highest = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (byte(1) < lowest || byte(1) > highest) return false;
    for (std::size_t i = 2; i < size; ++i) {
      if ((byte(i) & 0xc0) != 0x80) return false;
    }
    at += size;
  }
  return true;
}

}  // namespace armature::ride
