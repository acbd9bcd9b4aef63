// SPDX-License-Identifier: Apache-2.0
#include "armature/can/packets.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "armature/can/internal/shared_bus_messages.hpp"

namespace armature::can {
namespace {

using internal::FromBusMessage;
using internal::SharedFrame;
using internal::ToBusMessage;

/// Linux's `can_frame`.
struct KernelFrame {
  std::uint32_t id = 0;
  std::uint8_t size = 0;
  std::uint8_t unused[3] = {};
  std::uint8_t data[Frame::kMostData] = {};
};
static_assert(sizeof(KernelFrame) == 16);

template <typename Message>
Packets::Bytes copied(const Message& message) {
  const auto bytes = internal::bytes_of(message);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

Packets Packets::of(const std::string& bus, std::uint32_t bit_rate, const Filter& filter) {
  constexpr std::string_view kVirtual = "virtual:";
  Packets packets;
  if (!bus.starts_with(kVirtual)) {
    packets.address = bus;
    packets.size = sizeof(KernelFrame);
    packets.id = offsetof(KernelFrame, id);
    packets.data = offsetof(KernelFrame, data);
    return packets;
  }
  BusOptions options;
  options.filters.push_back(filter);
  packets.socket_file = true;
  packets.address = bus.substr(kVirtual.size());
  packets.hello = internal::hello_of(options, bit_rate);
  packets.time_sent = offsetof(ToBusMessage, time_ns);
  packets.size = sizeof(FromBusMessage);
  packets.kind = offsetof(FromBusMessage, kind);
  packets.frame_kind = static_cast<std::uint32_t>(internal::FromBus::kFrame);
  packets.id = offsetof(FromBusMessage, frame) + offsetof(SharedFrame, id);
  packets.extended = offsetof(FromBusMessage, frame) + offsetof(SharedFrame, extended);
  packets.data = offsetof(FromBusMessage, frame) + offsetof(SharedFrame, data);
  return packets;
}

Packets::Bytes Packets::to_send(const Frame& frame) const {
  if (socket_file) {
    ToBusMessage message;
    message.frame = internal::to_shared(frame, false);
    return copied(message);
  }
  KernelFrame message;
  message.id = frame.id;
  message.size = frame.size;
  std::ranges::copy(frame.data, message.data);
  return copied(message);
}

}  // namespace armature::can
