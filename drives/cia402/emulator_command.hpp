// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "drives/cia402/emulated_bus.hpp"

namespace armature::cia402 {

/// What an operator of the emulator may type, one command a line.
std::string emulator_commands();

/// Does what a line says: a fault of a drive, or its end.
/// @return what there is to tell; an error names the command and what was expected
base::Result<std::string> give_command(EmulatedBus& drives, const std::string& line,
                                       base::Time now);

/// How a drive is, in a line: `node 1: operation enabled, CSP, 0.123 rad, 0.5 rad/s, 1.2 N m`.
std::string describe(const EmulatedDrive& drive);

}  // namespace armature::cia402
