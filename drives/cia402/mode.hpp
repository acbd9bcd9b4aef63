// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace armature::cia402 {

/// Modes of operation with their numbers in 0x6060 and 0x6061; others are possible.
enum class Mode : std::int8_t {
  kNone = 0,
  kProfilePosition = 1,
  kProfileVelocity = 3,
  kHoming = 6,
  kCyclicPosition = 8,
  kCyclicVelocity = 9,
  kCyclicTorque = 10,
};

/// `CSP`, `CSV`, `CST`, `PP`, `PV`, `HM`.
const char* to_text(Mode mode) noexcept;
/// The mode of such a name.
std::optional<Mode> parse_mode(const std::string& name) noexcept;
/// The bit of a mode in supported drive modes, 0x6502; 0 for `kNone`.
constexpr std::uint32_t supported_bit(Mode mode) noexcept {
  const auto number = static_cast<int>(mode);
  return number >= 1 && number <= 32 ? std::uint32_t{1} << (number - 1) : 0;
}
/// All modes of a word of supported drive modes that this library knows, as text: `PP, CSP`.
std::string supported_text(std::uint32_t supported);

}  // namespace armature::cia402
