// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/mode.hpp"

#include <array>

namespace armature::cia402 {
namespace {

constexpr std::array kModes = {Mode::kProfilePosition, Mode::kProfileVelocity, Mode::kHoming,
                               Mode::kCyclicPosition,  Mode::kCyclicVelocity,  Mode::kCyclicTorque};

}  // namespace

const char* to_text(Mode mode) noexcept {
  switch (mode) {
    case Mode::kNone:
      return "none";
    case Mode::kProfilePosition:
      return "PP";
    case Mode::kProfileVelocity:
      return "PV";
    case Mode::kHoming:
      return "HM";
    case Mode::kCyclicPosition:
      return "CSP";
    case Mode::kCyclicVelocity:
      return "CSV";
    case Mode::kCyclicTorque:
      return "CST";
  }
  return "unknown";
}

std::optional<Mode> parse_mode(const std::string& name) noexcept {
  for (const Mode mode : kModes) {
    if (name == to_text(mode)) return mode;
  }
  return std::nullopt;
}

std::string supported_text(std::uint32_t supported) {
  std::string text;
  for (const Mode mode : kModes) {
    if ((supported & supported_bit(mode)) == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(to_text(mode));
  }
  return text.empty() ? "none" : text;
}

}  // namespace armature::cia402
