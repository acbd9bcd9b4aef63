// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {

/// What a motor puck has told about itself.
struct PuckRecord {
  int node = 0;
  int version = 0;  ///< of its main firmware
  int role = 0;
  std::int32_t counts_per_turn = 0;  ///< CTS
  std::int32_t units_per_nm = 0;     ///< IPNM: a torque of 1 Nm at the motor
  std::int32_t most_torque = 0;      ///< MT, puck units
  int slot = 0;                      ///< PIDX: its place in torque frames, 1 to 4
  std::array<int, 3> groups{};       ///< GRPA, GRPB, GRPC

  friend bool operator==(const PuckRecord&, const PuckRecord&) = default;
};

/// An arm that is ready for its cycle.
struct WamRecord {
  std::size_t motors = 0;  ///< 4 or 7
  std::array<PuckRecord, kMostMotors> pucks{};
  int board_version = 0;
  bool zeroed = false;  ///< positions are those of the arm
  // Numbers that the cycle needs.
  int position_number = 0;    ///< P, the same of all pucks
  int torque_number = 0;      ///< T
  int motor_mode_number = 0;  ///< MODE
  int board_mode_number = 0;  ///< MODE of the safety board
  int pendant_number = 0;     ///< PEN
  int zero_number = 0;        ///< ZERO of the safety board

  friend bool operator==(const WamRecord&, const WamRecord&) = default;
};

/// What is wrong with a device, and how to mend it.
struct Mistake {
  std::string message;
  std::string hint;
};

/// Whether a node with this ROLE and STAT is a motor puck that works.
std::optional<Mistake> check_motor(int node, int role, int status);
/// Whether the puck is set up so that the cycle's frames do with it what they say.
std::optional<Mistake> check_puck(const PuckRecord& puck);

}  // namespace armature::wam
