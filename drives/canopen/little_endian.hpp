// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace armature::canopen {

/// The number whose bytes are `bytes`, least significant first; of more than eight, the first
/// eight.
constexpr std::uint64_t load(std::span<const std::uint8_t> bytes) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = std::min<std::size_t>(bytes.size(), 8); i > 0; --i) {
    value = value << 8 | bytes[i - 1];
  }
  return value;
}

/// Fills `bytes` with `value`, least significant first; beyond eight bytes with 0.
constexpr void store(std::span<std::uint8_t> bytes, std::uint64_t value) noexcept {
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(value & 0xff);
    value >>= 8;
  }
}

/// The lowest `bits` bits of 64.
/// @param bits  0 to 64
constexpr std::uint64_t low_bits(unsigned bits) noexcept {
  return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

/// The signed number that the lowest `bits` bits are, in two's complement.
/// @param bits  1 to 64
constexpr std::int64_t sign_extended(std::uint64_t raw, unsigned bits) noexcept {
  const std::uint64_t sign = std::uint64_t{1} << (bits - 1);
  raw &= low_bits(bits);
  return static_cast<std::int64_t>((raw ^ sign) - sign);
}

}  // namespace armature::canopen
