// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "armature/can/frame.hpp"
#include "drives/canopen/cob_id.hpp"

namespace armature::canopen {

/// Bits of a device's error register, object 0x1001.
namespace error_register {
constexpr std::uint8_t kGeneric = 0x01;
constexpr std::uint8_t kCurrent = 0x02;
constexpr std::uint8_t kVoltage = 0x04;
constexpr std::uint8_t kTemperature = 0x08;
constexpr std::uint8_t kCommunication = 0x10;
constexpr std::uint8_t kProfile = 0x20;
constexpr std::uint8_t kManufacturer = 0x80;
}  // namespace error_register

/// Codes that this library's devices send, or its users look for (CiA 301, table 26; CiA 402-2).
namespace emergency_code {
constexpr std::uint16_t kNoError = 0x0000;
constexpr std::uint16_t kGeneric = 0x1000;
constexpr std::uint16_t kOvercurrent = 0x2310;
constexpr std::uint16_t kOvervoltage = 0x3210;
constexpr std::uint16_t kUndervoltage = 0x3220;
constexpr std::uint16_t kTemperature = 0x4310;
constexpr std::uint16_t kFeedback = 0x7300;
constexpr std::uint16_t kCanOverrun = 0x8110;
constexpr std::uint16_t kHeartbeatLost = 0x8130;
constexpr std::uint16_t kBusOffRecovered = 0x8140;
constexpr std::uint16_t kPdoTooShort = 0x8210;
constexpr std::uint16_t kSyncLength = 0x8240;
constexpr std::uint16_t kPdoTimeout = 0x8250;
constexpr std::uint16_t kFollowingError = 0x8611;
constexpr std::uint16_t kSyncLost = 0x8700;
}  // namespace emergency_code

/// What a device says when something has gone wrong in it, or `kNoError` when all is well again.
struct Emergency {
  NodeId node = 0;
  std::uint16_t code = 0;
  std::uint8_t error_register = 0;
  std::array<std::uint8_t, 5> manufacturer{};

  friend bool operator==(const Emergency&, const Emergency&) = default;
};

/// @rt nonblocking, no allocation
can::Frame emergency_frame(const Emergency& emergency) noexcept;
/// None if the frame is none.
/// @rt nonblocking, no allocation
std::optional<Emergency> parse_emergency(const can::Frame& frame) noexcept;
/// What the code means, as closely as the standards say: of an unknown code, what its class is.
/// @rt nonblocking, no allocation
const char* meaning_of_emergency(std::uint16_t code) noexcept;
/// `node 3 reports 0x2310, overcurrent at the output (error register 0x03)`.
std::string to_text(const Emergency& emergency);

}  // namespace armature::canopen
