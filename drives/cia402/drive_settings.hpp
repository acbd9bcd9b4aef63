// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "armature/base/result.hpp"
#include "drives/canopen/object.hpp"
#include "drives/cia402/prepare_drive.hpp"

namespace armature::cia402 {

/// Whose heartbeat a device watches, and for how long it may be missing.
constexpr canopen::Address kConsumedHeartbeat{0x1016, 1};

/// An object that a host writes when it prepares a drive.
struct Setting {
  canopen::Address address;
  canopen::DataType type = canopen::DataType::kUnsigned32;
  std::int64_t value = 0;
};

/// What a drive is told beside its PDOs: SYNC period, heartbeats both ways, interpolation time and
/// mode. An error says which of them has no form.
base::Result<std::vector<Setting>> settings_of(const DriveWish& wish);

}  // namespace armature::cia402
