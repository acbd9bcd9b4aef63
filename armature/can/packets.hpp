// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/can/bus.hpp"

namespace armature::can {

/// A bus of `make_bus` as the packets that it takes and gives, for a process that has nothing of
/// this library.
struct Packets {
  using Bytes = std::vector<std::byte>;

  bool socket_file = false;              ///< else a raw socket of an interface
  std::string address;                   ///< the socket file, or the name of the interface
  Bytes hello;                           ///< said first; empty: nothing
  std::optional<std::size_t> time_sent;  ///< where a packet to the bus has its time, i64 ns
  std::size_t size = 0;                  ///< of a packet from the bus
  std::optional<std::size_t> kind;       ///< where that has its kind, u32
  std::uint32_t frame_kind = 0;          ///< which says that it is a frame
  std::size_t id = 0;                    ///< where it has the identifier, u32
  std::optional<std::size_t> extended;   ///< where it says that this has 29 bits, u8
  std::size_t data = 0;                  ///< where it has eight bytes of data

  /// @param filter  of what the process receives
  static Packets of(const std::string& bus, std::uint32_t bit_rate, const Filter& filter);
  /// @param frame  a data frame of 11 bits
  Bytes to_send(const Frame& frame) const;
};

}  // namespace armature::can
