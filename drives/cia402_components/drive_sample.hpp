// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/types/struct.hpp"
#include "drives/cia402/power.hpp"

namespace armature::cia402 {

/// The status word of a drive, bit by bit (CiA 402-2, 0x6041).
struct DriveStatus {
  bool ready_to_switch_on = false;
  bool switched_on = false;
  bool operation_enabled = false;
  bool fault = false;
  bool voltage_enabled = false;
  bool quick_stop = false;  ///< it stops quickly; the bit is inverted
  bool switch_on_disabled = false;
  bool warning = false;
  bool remote = false;
  bool target_reached = false;
  bool internal_limit = false;
  bool follows = false;  ///< the targets of its cyclic mode
  bool following_error = false;
};
ARMATURE_STRUCT(DriveStatus, ready_to_switch_on, switched_on, operation_enabled, fault,
                voltage_enabled, quick_stop, switch_on_disabled, warning, remote, target_reached,
                internal_limit, follows, following_error);

/// @rt nonblocking, no allocation
constexpr DriveStatus status_of(std::uint16_t word) noexcept {
  const auto has = [word](std::uint16_t bit) { return (word & bit) != 0; };
  return {.ready_to_switch_on = has(status_bit::kReadyToSwitchOn),
          .switched_on = has(status_bit::kSwitchedOn),
          .operation_enabled = has(status_bit::kOperationEnabled),
          .fault = has(status_bit::kFault),
          .voltage_enabled = has(status_bit::kVoltageEnabled),
          .quick_stop = has(status_bit::kOperationEnabled) && !has(status_bit::kQuickStop),
          .switch_on_disabled = has(status_bit::kSwitchOnDisabled),
          .warning = has(status_bit::kWarning),
          .remote = has(status_bit::kRemote),
          .target_reached = has(status_bit::kTargetReached),
          .internal_limit = has(status_bit::kInternalLimit),
          .follows = has(status_bit::kFollowsCommand),
          .following_error = has(status_bit::kFollowingError)};
}

/// What a drive said of itself lately, when its host looked.
struct DriveSample {
  bool no_bus = false;      ///< the bus is off or down, or the host does not run
  bool fresh = false;       ///< it has answered since the look before
  bool unprepared = false;  ///< it lost its power, and was not prepared since then
  double position = 0.0;    ///< [rad] of the driving shaft
  double velocity = 0.0;    ///< [rad/s]
  double effort = 0.0;      ///< [Nm]
  int power = -1;           ///< PowerState, -1: unknown
  int status = 0;           ///< its word
  int silent_cycles = 0;
  int error_code = 0;  ///< of its emergency, else of 0x603F
  bool lost = false;   ///< its heartbeat is missing
  bool has_current = false;
  double current = 0.0;  ///< [A]
  bool has_temperature = false;
  double temperature = 0.0;  ///< [K]
  bool obeys = true;         ///< in mode torque: it gives the torque that it was told
  bool frozen = false;       ///< likewise: its values are the same to the bit, and should not be
  int homing = 0;            ///< HomingStage
};
ARMATURE_STRUCT(DriveSample, no_bus, fresh, unprepared, position, velocity, effort, power, status,
                silent_cycles, error_code, lost, has_current, current, has_temperature, temperature,
                obeys, frozen, homing);

}  // namespace armature::cia402
