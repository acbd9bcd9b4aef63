// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "drives/canopen/eds.hpp"
#include "drives/canopen/pdo.hpp"
#include "drives/cia402/prepare_drive.hpp"

namespace armature::cia402 {

/// What a host sends to a drive in each cycle: control word and the mode's target.
std::vector<canopen::Pdo> receive_pdos(const DriveWish& wish);
/// What the drive answers: status word, position and torque; with velocity, it and the error code.
std::vector<canopen::Pdo> transmit_pdos(const DriveWish& wish);

/// Compares what a host wants of a drive with the EDS of its maker, without the drive: identity,
/// mode, whether what is written at the start is within limits, and whether each object of a cycle
/// is there, has its bits and may be mapped.
/// @param file  of the EDS, for messages
/// @return false after an error; each names the drive, the object, what was expected and found
bool check_eds(const canopen::Eds& eds, const std::string& file, const DriveWish& wish,
               base::Diagnostics& diagnostics);

}  // namespace armature::cia402
