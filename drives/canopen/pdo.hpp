// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/frame.hpp"
#include "drives/canopen/object.hpp"

namespace armature::canopen {

/// From the device's side: it sends a transmit PDO, and receives a receive PDO.
enum class PdoDirection : std::uint8_t { kReceive, kTransmit };
const char* to_text(PdoDirection direction) noexcept;

/// An object in a PDO, and how many bits it has there.
struct MappedObject {
  Address address;
  std::uint8_t bits = 0;

  friend bool operator==(const MappedObject&, const MappedObject&) = default;
};

/// The number by which objects 0x1600 and 0x1A00 have it.
constexpr std::uint32_t mapping_entry(const MappedObject& object) {
  return std::uint32_t{object.address.index} << 16 | std::uint32_t{object.address.subindex} << 8 |
         object.bits;
}
constexpr MappedObject mapped_object(std::uint32_t entry) {
  return {{static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8 & 0xffu)},
          static_cast<std::uint8_t>(entry & 0xff)};
}

/// When a PDO is sent, or used (CiA 301, tables 70 and 76): 0 at the next SYNC after a change, n at
/// every nth SYNC, 254 and 255 at events.
namespace transmission {
constexpr std::uint8_t kAtSyncWhenChanged = 0;
constexpr std::uint8_t kAtEverySync = 1;
constexpr std::uint8_t kLastSynchronous = 240;
constexpr std::uint8_t kMakersEvent = 254;
constexpr std::uint8_t kProfilesEvent = 255;
constexpr bool is_synchronous(std::uint8_t type) { return type <= kLastSynchronous; }
constexpr bool is_event(std::uint8_t type) { return type >= kMakersEvent; }
}  // namespace transmission

/// A PDO as the communication and mapping parameters of a device describe it.
struct Pdo {
  std::uint32_t cob_id = 0;
  bool valid = false;
  std::uint8_t transmission = transmission::kProfilesEvent;
  std::uint16_t inhibit_100us = 0;  ///< least time between two [100 us]; 0: none
  std::uint16_t event_ms = 0;  ///< sent at least so often, or missed after it [ms]; 0: no timer
  std::vector<MappedObject> objects;  ///< from the lowest bit of the frame

  friend bool operator==(const Pdo&, const Pdo&) = default;
};

constexpr std::size_t kMostMappedObjects = 64;
constexpr unsigned kMostPdoBits = 64;

/// Bits that the objects take together.
/// @rt nonblocking, no allocation, O(objects)
unsigned mapped_bits(std::span<const MappedObject> objects) noexcept;

/// An error if the objects do not fit, or one of them has no bits.
base::Result<void> check_mapping(std::span<const MappedObject> objects);

/// The frame with the lowest bits of each value.
/// @param values  one for each object, in their order; of the missing ones 0 is sent
/// @param pdo     its mapping as `check_mapping` wants it
/// @rt nonblocking, no allocation, O(objects)
can::Frame pack(const Pdo& pdo, std::span<const std::uint64_t> values) noexcept;

/// What `frame` has for each object, as raw bits; see `sign_extended`.
/// @return false if the frame has another identifier or is too short; `values` are untouched then
/// @rt nonblocking, no allocation, O(objects)
bool unpack(const Pdo& pdo, const can::Frame& frame, std::span<std::uint64_t> values) noexcept;

/// Decides when an event-driven PDO may and must be sent: the inhibit time and the event timer.
class PdoTimer {
 public:
  PdoTimer() = default;
  explicit PdoTimer(const Pdo& pdo)
      : inhibit_(std::int64_t{pdo.inhibit_100us} * 100'000),
        event_(std::int64_t{pdo.event_ms} * 1'000'000) {}

  /// Whether it is sent now, which counts as sent.
  /// @param changed  since it was sent last
  /// @rt nonblocking, no allocation
  bool step(bool changed, base::Time now) noexcept;

 private:
  base::Duration inhibit_{};
  base::Duration event_{};
  std::optional<base::Time> sent_;
};

}  // namespace armature::canopen
