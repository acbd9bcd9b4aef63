// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "armature/can/frame.hpp"

namespace armature::wam {

// What the pucks, the safety board and their host say to each other, frame by frame: see
// PROTOCOL.md. Everything here is nonblocking and allocates nothing.

constexpr std::uint32_t kBitRate = 1'000'000;
constexpr int kHostNode = 0;
constexpr int kBoardNode = 10;
constexpr int kLastNode = 31;
constexpr std::size_t kMostMotors = 7;
constexpr std::size_t kTorquesPerFrame = 4;

/// Groups of nodes; a frame to a group is for all that are in it.
enum class Group : std::uint8_t {
  kAll = 0,             ///< all but the safety board
  kLowerArm = 1,        ///< pucks 1 to 4, and their torques
  kWrist = 2,           ///< pucks 5 to 7, and their torques
  kPositions = 3,       ///< where motor positions are sent to: host and safety board
  kArm = 4,             ///< pucks 1 to 7
  kReplies = 6,         ///< where all other values are sent to: the host
  kJointPositions = 7,  ///< where positions of joint encoders are sent to: the host
};

/// Who sends a frame and whom it is for.
struct Address {
  int from = kHostNode;
  int to = 0;          ///< a node, or a group's number
  bool group = false;  ///< what `to` is

  friend bool operator==(const Address&, const Address&) = default;
};

constexpr Address to_node(int node) { return {kHostNode, node, false}; }
constexpr Address to_group(Group group) { return {kHostNode, static_cast<int>(group), true}; }
constexpr Address from_node(int node, Group group) { return {node, static_cast<int>(group), true}; }

/// @param address  with nodes 0 to 31
constexpr std::uint32_t identifier(const Address& address) {
  return (address.group ? 0x400u : 0u) | static_cast<std::uint32_t>(address.from) << 5 |
         static_cast<std::uint32_t>(address.to);
}
/// None for what is no data frame with 11 bits.
std::optional<Address> address_of(const can::Frame& frame);

/// STAT of a puck.
enum class PuckStatus : std::uint8_t {
  kReset = 0,  ///< the monitor runs, the main firmware does not
  kError = 1,
  kReady = 2,
};

/// MODE of a motor puck.
enum class PuckMode : std::uint8_t {
  kIdle = 0,  ///< torques are ignored, the motor's terminals braked
  kDuty = 1,
  kTorque = 2,  ///< torques are obeyed
  kPid = 3,
  kVelocity = 4,
  kTrapezoidal = 5,
};

/// MODE of the safety board.
enum class BoardMode : std::uint8_t {
  kEstop = 0,   ///< the pucks have no power
  kIdle = 1,    ///< they have, and ignore torques
  kActive = 2,  ///< they obey torques
};

constexpr int kKindMask = 0x1f;  ///< of ROLE: what the device is
constexpr int kMotorRole = 0;
constexpr int kSafetyRole = 2;
constexpr int kAbsoluteEncoder = 0x0100;  ///< of ROLE: options
constexpr int kJointEncoder = 0x4000;

// ---- Values: GET, SET and answers

/// A GET or SET, or an answer, which looks like a SET.
struct Message {
  bool set = false;
  int number = 0;          ///< of the property, 0 to 127
  std::int32_t value = 0;  ///< of a SET

  friend bool operator==(const Message&, const Message&) = default;
};

/// How many bytes the value of a SET or an answer has.
enum class Width { kTwo, kFour };

can::Frame get_frame(const Address& address, int number);
/// What does not fit into two bytes loses its upper bits.
can::Frame set_frame(const Address& address, int number, std::int32_t value,
                     Width width = Width::kFour);
can::Frame reply_frame(int node, int number, std::int32_t value, Width width);

/// By the data alone; none for lengths that neither has, and for a SET whose second byte is not 0.
std::optional<Message> parse_message(const can::Frame& frame);
/// The value of property `number`; none if the frame is not just that.
std::optional<std::int32_t> parse_reply(const can::Frame& frame, int number);

// ---- Positions

/// Of a motor, and of the joint's encoder where the puck has one; 22 bits each, in counts.
struct Positions {
  std::int32_t motor = 0;
  std::optional<std::int32_t> joint;

  friend bool operator==(const Positions&, const Positions&) = default;
};
constexpr std::int32_t kMostCounts = (1 << 21) - 1;
constexpr std::int32_t kLeastCounts = -(1 << 21);
/// The upper two bits of a position's first byte: what pucks send is not certain, what they mean
/// is not known, and whoever reads positions ignores them.
enum class PositionFlags : std::uint8_t { kNone = 0x00, kUpper = 0x80 };

/// What does not fit into 22 bits loses its upper bits.
can::Frame position_frame(int node, const Positions& positions,
                          PositionFlags flags = PositionFlags::kUpper);
can::Frame joint_position_frame(int node, std::int32_t counts,
                                PositionFlags flags = PositionFlags::kUpper);
/// None unless the frame has three bytes, or six with that of the joint.
std::optional<Positions> parse_positions(const can::Frame& frame);

// ---- Torques

using Torques = std::array<std::int16_t, kTorquesPerFrame>;
constexpr std::int16_t kMostTorque = 8191;

/// Puck units as they go over the wire: rounded down, at most 8191 either way; what is no number
/// is 0.
std::int16_t torque_value(double units);
/// @param number   of the property T in this firmware
/// @param torques  -8192 to 8191
can::Frame torque_frame(Group group, int number, const Torques& torques);
/// None unless it has eight bytes and begins with a SET of property `number`.
std::optional<Torques> parse_torques(const can::Frame& frame, int number);

}  // namespace armature::wam
