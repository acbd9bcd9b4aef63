// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "armature/base/result.hpp"
#include "robots/wam/emulator/arm_motors.hpp"
#include "robots/wam/emulator/emulator.hpp"

namespace armature::wam {

/// The emulated arm and who can act on it.
struct EmulatedArm {
  Emulator& emulator;
  ArmMotors& motors;
  const ArmNumbers& numbers;
};

/// What an operator does to the emulated arm, or what breaks.
struct EmulatorCommand {
  void (*act)(const EmulatedArm& arm, const EmulatorCommand& command) = nullptr;
  std::size_t motor = 0;  ///< whose puck, from 0
  double value = 0.0;     ///< in the unit of the command
  /// Has frames sent again, which a bus without a time of its own does too fast to be simulated.
  bool needs_bit_rate = false;

  /// @thread the one that advances the emulator
  void apply(const EmulatedArm& arm) const { act(arm, *this); }
};

/// `idle`, `fault puck 3 silent`, `fault board delay 5`, ...: a line of `emulator_commands()`.
/// An error says what was expected.
/// @param motors  of the arm, 4 or 7
base::Result<EmulatorCommand> parse_emulator_command(std::string_view line, std::size_t motors);

/// All of them, a line each with what it does.
std::string emulator_commands();

}  // namespace armature::wam
