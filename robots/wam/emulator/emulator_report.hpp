// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "robots/wam/emulator/running_emulator.hpp"

namespace armature::wam {

/// `{"time":1.5,"mode":"idle","monitors":{"velocity":"safe",...},...}`; EMULATOR.md has all of it.
/// @param time  in seconds since the emulator was started
std::string json_line(const EmulatorState& state, double time);

/// What a terminal shows all the time: the safety board, the joints, the motors.
constexpr std::size_t kStatusLines = 3;
/// @param frames_per_second  on the bus
std::array<std::string, kStatusLines> status_lines(const EmulatorState& state,
                                                   double frames_per_second);

/// Tells people what changes.
class EmulatorChanges {
 public:
  /// A line for each change since the state before, with the time.
  std::vector<std::string> take(const EmulatorState& state, double time);

 private:
  std::optional<EmulatorState> before_;
};

}  // namespace armature::wam
