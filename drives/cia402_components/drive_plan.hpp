// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/controllers/base/joint_command.hpp"
#include "armature/types/enum.hpp"
#include "drives/canopen/eds.hpp"
#include "drives/cia402/prepare_drive.hpp"

namespace armature::cia402 {

/// How a drive is commanded: CST, CSV or CSP.
enum class CyclicMode : std::uint8_t { kTorque, kVelocity, kPosition };
ARMATURE_ENUM(CyclicMode, kTorque, kVelocity, kPosition);

Mode mode_of(CyclicMode mode);
controllers::JointCommand command_of(CyclicMode mode);

/// One drive as its deployment declares it: what the bus says of all, and what is its own.
struct DrivePlan {
  DriveWish wish;
  CyclicMode mode = CyclicMode::kPosition;
  std::string eds_file;               ///< empty: none
  std::optional<canopen::Eds> eds{};  ///< that file, once it was read

  std::optional<canopen::Address> temperature{};
  double temperature_scale = 1.0;      ///< [K], what one in that object is
  double temperature_offset = 273.15;  ///< [K], what 0 in it is

  /// Who the drive has to be; 0 where it does not matter.
  void expect(int vendor, int product);
  /// Reads the EDS and compares the wish with it, without the drive.
  void read_eds(base::Diagnostics& diagnostics);
};

}  // namespace armature::cia402
