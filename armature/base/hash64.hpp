// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace armature::base {

/// 64-bit FNV-1a, by which a content is known again.
constexpr std::uint64_t fnv1a_64(std::string_view content) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : content) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x00000100000001b3u;
  }
  return hash;
}

/// The same as 16 hexadecimal digits.
inline std::string hash64_text(std::string_view content) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const std::uint64_t hash = fnv1a_64(content);
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(hash >> shift) & 15];
  return text;
}

}  // namespace armature::base
