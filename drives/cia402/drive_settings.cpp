// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/drive_settings.hpp"

#include <chrono>
#include <string>

#include "drives/cia402/objects.hpp"

namespace armature::cia402 {
namespace {

using canopen::DataType;

std::int64_t milliseconds_of(base::Duration duration) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(duration).count();
}

/// 0x60C2 in the largest unit that needs at most a byte.
base::Result<void> add_interpolation(std::int64_t cycle_us, std::vector<Setting>& settings) {
  std::int64_t value = cycle_us;
  int exponent = -6;
  while (value % 10 == 0 && value > 0 && exponent < 0) {
    value /= 10;
    ++exponent;
  }
  if (value > 255) {
    return base::Error{"its interpolation time 0x60C2 has no form for a cycle of " +
                       std::to_string(cycle_us) +
                       " us (choose a cycle of at most three digits, such as 2 ms)"};
  }
  settings.push_back({object::kInterpolationTime, DataType::kUnsigned8, value});
  settings.push_back({object::kInterpolationExponent, DataType::kInteger8, exponent});
  return {};
}

}  // namespace

base::Result<std::vector<Setting>> settings_of(const DriveWish& wish) {
  const auto cycle_us = std::chrono::duration_cast<std::chrono::microseconds>(wish.cycle).count();
  std::vector<Setting> settings = {
      {{0x1006, 0}, DataType::kUnsigned32, cycle_us},
      {{0x1017, 0}, DataType::kUnsigned16, milliseconds_of(wish.heartbeat)}};
  if (wish.host) {
    settings.push_back({kConsumedHeartbeat, DataType::kUnsigned32,
                        std::int64_t{wish.host->node} << 16 | milliseconds_of(wish.host->timeout)});
  }
  if (wish.mode == Mode::kCyclicPosition) {
    if (auto added = add_interpolation(cycle_us, settings); !added) {
      return base::Error{added.error()};
    }
  }
  settings.push_back({object::kMode, DataType::kInteger8, static_cast<int>(wish.mode)});
  return settings;
}

}  // namespace armature::cia402
