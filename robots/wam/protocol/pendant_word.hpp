// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace armature::wam {

// The safety board's property PEN: what its pendant shows, and what it supervises. Everything here
// is nonblocking and allocates nothing.

/// What the board supervises.
enum class Monitor : std::uint8_t { kVelocity, kTorque, kVoltage, kHeartbeat, kOther };
constexpr std::size_t kMonitors = 5;

enum class Level : std::uint8_t { kSafe = 1, kWarning = 2, kFault = 4 };

/// The key that is being pressed.
enum class PendantKey : std::uint8_t { kEstop = 0, kActivate = 1, kIdle = 2, kNone = 3 };

struct PendantWord {
  PendantKey key = PendantKey::kNone;
  bool activate_lamp = false;
  bool idle_lamp = false;
  /// Of the seven segments: 0 to 7, A, E, H or L; a question mark for any other pattern.
  char display = '0';
  std::array<Level, kMonitors> levels{Level::kSafe, Level::kSafe, Level::kSafe, Level::kSafe,
                                      Level::kSafe};

  Level level(Monitor monitor) const { return levels[static_cast<std::size_t>(monitor)]; }
  friend bool operator==(const PendantWord&, const PendantWord&) = default;
};

/// @param word  with a display of the twelve that have a pattern; others are shown dark
std::int32_t pendant_value(const PendantWord& word);
/// None if a monitor is neither safe nor warns nor has a fault: boards with old firmware use the
/// word otherwise.
std::optional<PendantWord> parse_pendant(std::int32_t value);

const char* to_text(Monitor monitor);
const char* to_text(Level level);

}  // namespace armature::wam
