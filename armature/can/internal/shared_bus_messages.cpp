// SPDX-License-Identifier: Apache-2.0
#include "armature/can/internal/shared_bus_messages.hpp"

#include <algorithm>

namespace armature::can::internal {
namespace {

bool fits(const SharedFilter& filter) {
  const std::uint32_t most = filter.extended != 0 ? Frame::kMostExtended : Frame::kMostStandard;
  return filter.id <= most && filter.mask <= most;
}

bool is_capacity(std::uint32_t frames) { return frames >= 1 && frames <= kMostSharedCapacity; }

}  // namespace

SharedFrame to_shared(const Frame& frame, bool own) {
  SharedFrame shared;
  shared.id = frame.id;
  shared.kind = static_cast<std::uint8_t>(frame.kind);
  shared.extended = frame.extended ? 1 : 0;
  shared.size = frame.size;
  shared.own = own ? 1 : 0;
  shared.data = frame.data;
  return shared;
}

Frame from_shared(const SharedFrame& shared) {
  Frame frame;
  frame.id = shared.id;
  frame.extended = shared.extended != 0;
  frame.kind = static_cast<FrameKind>(
      std::min<std::uint8_t>(shared.kind, static_cast<std::uint8_t>(FrameKind::kError)));
  frame.size = shared.size;
  frame.data = shared.data;
  return frame;
}

std::vector<std::byte> hello_of(const BusOptions& options, std::uint32_t bit_rate) {
  const Hello hello{.bit_rate = bit_rate,
                    .send_capacity = static_cast<std::uint32_t>(options.send_capacity),
                    .receive_capacity = static_cast<std::uint32_t>(options.receive_capacity),
                    .own_frames = options.own_frames ? 1u : 0u,
                    .error_frames = options.error_frames ? 1u : 0u,
                    .filters = static_cast<std::uint32_t>(options.filters.size())};
  const auto head = bytes_of(hello);
  std::vector<std::byte> packet(head.begin(), head.end());
  for (const Filter& filter : options.filters) {
    const SharedFilter shared{filter.id, filter.mask, filter.extended ? 1u : 0u};
    const auto bytes = bytes_of(shared);
    packet.insert(packet.end(), bytes.begin(), bytes.end());
  }
  return packet;
}

bool parse_hello(std::span<const std::byte> packet, BusOptions& options, std::uint32_t& bit_rate) {
  if (packet.size() < sizeof(Hello)) return false;
  const auto hello = message_of<Hello>(packet);
  if (hello.magic != kSharedBusMagic || hello.version != kSharedBusVersion || hello.bit_rate == 0 ||
      !is_capacity(hello.send_capacity) || !is_capacity(hello.receive_capacity) ||
      hello.filters > kMostSharedFilters ||
      packet.size() != sizeof(Hello) + hello.filters * sizeof(SharedFilter)) {
    return false;
  }
  bit_rate = hello.bit_rate;
  options.send_capacity = hello.send_capacity;
  options.receive_capacity = hello.receive_capacity;
  options.own_frames = hello.own_frames != 0;
  options.error_frames = hello.error_frames != 0;
  for (std::size_t i = 0; i < hello.filters; ++i) {
    const auto filter =
        message_of<SharedFilter>(packet.subspan(sizeof(Hello) + i * sizeof(SharedFilter)));
    if (!fits(filter)) return false;
    options.filters.push_back({filter.id, filter.mask, filter.extended != 0});
  }
  return true;
}

}  // namespace armature::can::internal
