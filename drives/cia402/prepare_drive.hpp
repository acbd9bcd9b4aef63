// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "drives/canopen/device.hpp"
#include "drives/canopen/sdo_channel.hpp"
#include "drives/cia402/drive_group.hpp"

namespace armature::cia402 {

/// The heartbeat of a host, by which its drives know that it is there.
struct HostHeartbeat {
  canopen::NodeId node = 127;
  base::Duration period{};   ///< above 0
  base::Duration timeout{};  ///< without one for so long, drives react by their 0x1029 and 0x6007
};

/// How a drive homes by itself, in mode HM. Motion of the driving shaft.
struct HomingWish {
  std::int8_t method = 37;    ///< 0x6098; below 0: its maker's
  double speed = 0.0;         ///< [rad/s], until it finds the mark (0x6099:01)
  double slow_speed = 0.0;    ///< [rad/s], until it finds its edge or the index (0x6099:02)
  double acceleration = 0.0;  ///< [rad/s^2] (0x609A)
  double offset = 0.0;        ///< [rad], that it says where it finds home (0x607C)
};

/// What a host expects of a drive, and how it wants it to be.
struct DriveWish {
  canopen::NodeId node = 1;
  std::string name;
  std::optional<canopen::Identity> identity = {};  ///< numbers that are 0 are not compared
  Mode mode = Mode::kCyclicPosition;               ///< CSP, CSV or CST
  PositionUnit unit = PositionUnit::kIncrements;
  base::Duration cycle = std::chrono::milliseconds(2);        ///< between two SYNCs
  base::Duration heartbeat = std::chrono::milliseconds(100);  ///< of the drive; 0: none
  std::optional<HostHeartbeat> host = {};  ///< that the drive watches (0x1016:01)
  std::optional<HomingWish> homing = {};   ///< its mode is in an RPDO then
  bool with_velocity = false;              ///< a second TPDO has its velocity and error code
};

/// Reads who the drive is and what its units are, compares it with `wish`, and makes its PDOs,
/// heartbeats, SYNC period and mode; PDOs are read again. It has to be pre-operational.
/// @return how it takes part in a `DriveGroup`; none after errors, each of which names the drive,
///         the object, what was expected and what was found
std::optional<DriveConfig> prepare_drive(canopen::SdoChannel& channel, const DriveWish& wish,
                                         base::Diagnostics& diagnostics);

/// The factor group that the drive has. What it lacks is 1, as CiA 402 has it; only rated torque
/// and current have to be there.
base::Result<Factors> read_factors(canopen::SdoChannel& channel);

}  // namespace armature::cia402
