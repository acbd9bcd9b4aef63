// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "armature/base/result.hpp"
#include "armature/cli/new_folder.hpp"

namespace armature::cli {

/// What drives the joints of a new robot.
enum class DriveKind : std::uint8_t {
  kCia402,  ///< drives on CANopen, which the component library `cia402` speaks to: no C++
  kCan,     ///< a protocol on CAN that is to be changed into the drives' own
  kNone,    ///< a class in place of the drives, which is to be changed
};

/// A robot to be written.
struct RobotWish {
  std::string name;  ///< `MyArm` or `my_arm`
  std::size_t joints = 1;
  DriveKind drive = DriveKind::kNone;
  std::string urdf{};  ///< a file with its description; empty: a serial arm is written
};

inline constexpr std::size_t kMostNewJoints = 7;

/// Writes a robot that moves in simulation into a new folder below `parent`: description,
/// deployment, gains, a script, a test and the classes of its drives. Refused, with nothing
/// written, for a name that is taken or no C++ identifier, a folder that exists, a description that
/// does not fit or cannot be read.
base::Result<NewFolder> make_robot(const RobotWish& wish, const std::string& parent);

}  // namespace armature::cli
