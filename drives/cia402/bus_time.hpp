// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "armature/base/time.hpp"
#include "drives/cia402/prepare_drive.hpp"

namespace armature::cia402 {

/// The most bits that a data frame with an identifier of 11 bits takes, with stuff bits and the
/// pause behind it: 55 + 10 n (R. Davis et al., Controller Area Network (CAN) schedulability
/// analysis: refuted, revisited and revised, Real-Time Systems 35, 2007, equation 2).
constexpr int most_frame_bits(std::size_t bytes) noexcept {
  return 55 + 10 * static_cast<int>(bytes);
}

/// How long the bus is busy at most with what a cycle of these drives sends: targets, SYNC,
/// answers, and the part of heartbeats that falls into it.
/// @param bit_rate  bits per second, > 0
base::Duration cycle_bus_time(std::span<const DriveWish> drives, std::uint32_t bit_rate);

}  // namespace armature::cia402
