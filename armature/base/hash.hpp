// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace armature::base {

/// 32-bit FNV-1a, the hash that identifies types and operations in files and on the wire.
constexpr std::uint32_t fnv1a(std::string_view text, std::uint32_t hash = 0x811c9dc5u) {
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x01000193u;
  }
  return hash;
}

}  // namespace armature::base
