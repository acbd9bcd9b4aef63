// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/can/frame.hpp"

namespace armature::canopen {

/// Of a device on the bus: 1 to 127; 0 stands for all of them.
using NodeId = std::uint8_t;
constexpr NodeId kEveryNode = 0;
constexpr NodeId kLastNode = 127;
constexpr bool is_node(unsigned id) { return id >= 1 && id <= kLastNode; }

/// What a frame is for, by the predefined connection set (CiA 301, 7.3.3).
enum class Service : std::uint8_t {
  kNmt,
  kSync,
  kEmergency,
  kTime,
  kTransmitPdo,  ///< the device sends it
  kReceivePdo,   ///< the device receives it
  kSdoResponse,
  kSdoRequest,
  kHeartbeat,
  kOther,  ///< nothing of CANopen, or with an identifier of its user's choice
};

/// Service, device and, of a PDO, its number from 1 to 4.
struct Origin {
  Service service = Service::kOther;
  NodeId node = kEveryNode;
  std::uint8_t pdo = 0;

  friend bool operator==(const Origin&, const Origin&) = default;
};

/// The identifiers of the predefined connection set.
namespace cob_id {
constexpr std::uint32_t kNmt = 0x000;
constexpr std::uint32_t kSync = 0x080;
constexpr std::uint32_t kTime = 0x100;
constexpr std::uint32_t emergency(NodeId node) { return 0x080u + node; }
/// @param pdo  1 to 4
constexpr std::uint32_t transmit_pdo(unsigned pdo, NodeId node) {
  return 0x080u + 0x100u * pdo + node;
}
constexpr std::uint32_t receive_pdo(unsigned pdo, NodeId node) {
  return 0x100u + 0x100u * pdo + node;
}
constexpr std::uint32_t sdo_response(NodeId node) { return 0x580u + node; }
constexpr std::uint32_t sdo_request(NodeId node) { return 0x600u + node; }
constexpr std::uint32_t heartbeat(NodeId node) { return 0x700u + node; }
}  // namespace cob_id

/// What the frame is by its identifier; only data frames with 11 bits are CANopen's.
/// @rt nonblocking, no allocation
Origin origin_of(const can::Frame& frame) noexcept;

}  // namespace armature::canopen
