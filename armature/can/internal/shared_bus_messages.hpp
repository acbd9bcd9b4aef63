// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "armature/can/bus.hpp"
#include "armature/can/frame.hpp"

// What BusServer and SharedBus say to each other: packets between processes of one machine, so
// numbers are as the machine has them. Nothing that comes is believed: sizes, kinds and values are
// checked before anything is done with them.

namespace armature::can::internal {

constexpr std::uint32_t kSharedBusMagic = 0x4e414341;  // "ACAN"
constexpr std::uint32_t kSharedBusVersion = 1;
constexpr std::size_t kMostSharedFilters = 512;
constexpr std::size_t kMostSharedCapacity = 4096;

enum class ToBus : std::uint32_t { kFrame = 1, kRestart = 2 };
enum class FromBus : std::uint32_t { kWelcome = 1, kFrame = 2, kStatus = 3 };

struct SharedFrame {
  std::uint32_t id = 0;
  std::uint8_t kind = 0;
  std::uint8_t extended = 0;
  std::uint8_t size = 0;
  std::uint8_t own = 0;
  std::array<std::uint8_t, Frame::kMostData> data{};
};

struct SharedFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0;
  std::uint32_t extended = 0;
};

/// The first packet of a client, followed by its filters.
struct Hello {
  std::uint32_t magic = kSharedBusMagic;
  std::uint32_t version = kSharedBusVersion;
  std::uint32_t bit_rate = 0;
  std::uint32_t send_capacity = 0;
  std::uint32_t receive_capacity = 0;
  std::uint32_t own_frames = 0;
  std::uint32_t error_frames = 0;
  std::uint32_t filters = 0;
};

struct ToBusMessage {
  ToBus kind = ToBus::kFrame;
  std::uint32_t unused = 0;
  std::int64_t time_ns = 0;  ///< when it was sent, on the monotonic clock
  SharedFrame frame;
};

/// How a client's station is since the connection was made; with every packet to it.
struct StationStatus {
  std::uint64_t finished = 0;  ///< frames of the client that wait no more
  std::uint64_t discarded = 0;
  std::uint64_t lost = 0;
  std::uint64_t error_frames = 0;
  std::uint64_t bus_offs = 0;
  std::uint32_t state = 0;
  std::uint32_t unused = 0;

  friend bool operator==(const StationStatus&, const StationStatus&) = default;
};

struct FromBusMessage {
  FromBus kind = FromBus::kStatus;
  std::uint32_t magic = kSharedBusMagic;
  std::int64_t time_ns = 0;  ///< of a frame's end
  SharedFrame frame;
  StationStatus status;
};

template <typename Message>
std::span<const std::byte> bytes_of(const Message& message) {
  static_assert(std::has_unique_object_representations_v<Message>);
  return std::as_bytes(std::span(&message, 1));
}

/// @param bytes  at least as many as the message has
template <typename Message>
Message message_of(std::span<const std::byte> bytes) {
  static_assert(std::is_trivially_copyable_v<Message>);
  Message message;
  std::memcpy(&message, bytes.data(), sizeof message);
  return message;
}

SharedFrame to_shared(const Frame& frame, bool own);
/// What is out of range is cut off to what fits: whether it can be sent is for the bus to say.
Frame from_shared(const SharedFrame& shared);

/// A client's first packet.
std::vector<std::byte> hello_of(const BusOptions& options, std::uint32_t bit_rate);
/// False if the packet is none.
bool parse_hello(std::span<const std::byte> packet, BusOptions& options, std::uint32_t& bit_rate);

}  // namespace armature::can::internal
