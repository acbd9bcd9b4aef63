// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/bus_time.hpp"

#include <cmath>
#include <vector>

#include "armature/can/frame.hpp"
#include "drives/cia402/cycle_pdos.hpp"

namespace armature::cia402 {
namespace {

double bits_of_pdos(const std::vector<canopen::Pdo>& pdos) {
  double bits = 0.0;
  for (const canopen::Pdo& pdo : pdos) {
    unsigned mapped = 0;
    for (const canopen::MappedObject& object : pdo.objects) mapped += object.bits;
    bits += most_frame_bits(canopen::bytes_of_bits(mapped));
  }
  return bits;
}

/// One byte each, in the share of a cycle.
double bits_of_heartbeats(base::Duration period, base::Duration cycle) {
  if (period <= base::Duration{}) return 0.0;
  return most_frame_bits(1) * (std::chrono::duration<double>(cycle) / period);
}

}  // namespace

base::Duration cycle_bus_time(std::span<const DriveWish> drives, std::uint32_t bit_rate) {
  double bits = most_frame_bits(0);
  for (const DriveWish& wish : drives) {
    bits += bits_of_pdos(receive_pdos(wish)) + bits_of_pdos(transmit_pdos(wish)) +
            bits_of_heartbeats(wish.heartbeat, wish.cycle);
  }
  if (!drives.empty() && drives.front().host) {
    bits += bits_of_heartbeats(drives.front().host->period, drives.front().cycle);
  }
  return can::bits_time(std::llround(bits), bit_rate);
}

}  // namespace armature::cia402
