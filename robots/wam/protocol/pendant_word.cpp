// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/protocol/pendant_word.hpp"

#include <algorithm>

namespace armature::wam {
namespace {

struct Pattern {
  char shown;
  std::uint8_t segments;
};
constexpr auto kPatterns = std::to_array<Pattern>({{'0', 0x3f},
                                                   {'1', 0x06},
                                                   {'2', 0x5b},
                                                   {'3', 0x4f},
                                                   {'4', 0x66},
                                                   {'5', 0x6d},
                                                   {'6', 0x7d},
                                                   {'7', 0x07},
                                                   {'A', 0x77},
                                                   {'E', 0x79},
                                                   {'H', 0x76},
                                                   {'L', 0x38}});

std::uint32_t segments_of(char shown) {
  const auto found = std::ranges::find(kPatterns, shown, &Pattern::shown);
  return found == kPatterns.end() ? 0u : found->segments;
}

char shown_by(std::uint32_t segments) {
  const auto found = std::ranges::find(kPatterns, segments, &Pattern::segments);
  return found == kPatterns.end() ? '?' : found->shown;
}

constexpr bool is_level(std::uint32_t bits) { return bits == 1 || bits == 2 || bits == 4; }

}  // namespace

std::int32_t pendant_value(const PendantWord& word) {
  std::uint32_t bits = static_cast<std::uint32_t>(word.key) << 26 |
                       (word.activate_lamp ? 1u << 25 : 0u) | (word.idle_lamp ? 1u << 24 : 0u) |
                       segments_of(word.display) << 16;
  for (std::size_t i = 0; i < kMonitors; ++i) {
    bits |= static_cast<std::uint32_t>(word.levels[i]) << 3 * i;
  }
  return static_cast<std::int32_t>(bits);
}

std::optional<PendantWord> parse_pendant(std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  PendantWord word;
  word.key = static_cast<PendantKey>(bits >> 26 & 3u);
  word.activate_lamp = (bits & 1u << 25) != 0;
  word.idle_lamp = (bits & 1u << 24) != 0;
  word.display = shown_by(bits >> 16 & 0xffu);
  for (std::size_t i = 0; i < kMonitors; ++i) {
    const std::uint32_t level = bits >> 3 * i & 7u;
    if (!is_level(level)) return std::nullopt;
    word.levels[i] = static_cast<Level>(level);
  }
  return word;
}

const char* to_text(Monitor monitor) {
  switch (monitor) {
    case Monitor::kVelocity:
      return "velocity";
    case Monitor::kTorque:
      return "torque";
    case Monitor::kVoltage:
      return "voltage";
    case Monitor::kHeartbeat:
      return "heartbeat";
    case Monitor::kOther:
      return "other";
  }
  return "?";
}

const char* to_text(Level level) {
  switch (level) {
    case Level::kSafe:
      return "safe";
    case Level::kWarning:
      return "warning";
    case Level::kFault:
      return "fault";
  }
  return "?";
}

}  // namespace armature::wam
