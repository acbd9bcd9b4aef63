// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/cob_id.hpp"

namespace armature::canopen {
namespace {

Origin of_function(std::uint32_t function, NodeId node) noexcept {
  switch (function) {
    case 0x1:
      return {Service::kEmergency, node};
    case 0x3:
    case 0x5:
    case 0x7:
    case 0x9:
      return {Service::kTransmitPdo, node, static_cast<std::uint8_t>((function - 1) / 2)};
    case 0x4:
    case 0x6:
    case 0x8:
    case 0xa:
      return {Service::kReceivePdo, node, static_cast<std::uint8_t>((function - 2) / 2)};
    case 0xb:
      return {Service::kSdoResponse, node};
    case 0xc:
      return {Service::kSdoRequest, node};
    case 0xe:
      return {Service::kHeartbeat, node};
    default:
      return {};
  }
}

}  // namespace

Origin origin_of(const can::Frame& frame) noexcept {
  if (frame.kind != can::FrameKind::kData || frame.extended) return {};
  if (frame.id == cob_id::kNmt) return {Service::kNmt};
  if (frame.id == cob_id::kSync) return {Service::kSync};
  if (frame.id == cob_id::kTime) return {Service::kTime};
  const auto node = static_cast<NodeId>(frame.id & kLastNode);
  if (!is_node(node)) return {};
  return of_function(frame.id >> 7, node);
}

}  // namespace armature::canopen
