// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace armature::canopen {

/// Why an SDO transfer was given up (CiA 301, 7.2.4.3.17); others are possible.
enum class AbortCode : std::uint32_t {
  kNone = 0,  ///< it was not
  kToggleBit = 0x0503'0000,
  kTimeout = 0x0504'0000,
  kUnknownCommand = 0x0504'0001,
  kBlockSize = 0x0504'0002,
  kSequenceNumber = 0x0504'0003,
  kChecksum = 0x0504'0004,
  kOutOfMemory = 0x0504'0005,
  kUnsupportedAccess = 0x0601'0000,
  kWriteOnly = 0x0601'0001,
  kReadOnly = 0x0601'0002,
  kNoObject = 0x0602'0000,
  kNotMappable = 0x0604'0041,
  kPdoTooLong = 0x0604'0042,
  kIncompatibleParameter = 0x0604'0043,
  kIncompatibleDevice = 0x0604'0047,
  kHardware = 0x0606'0000,
  kWrongLength = 0x0607'0010,
  kTooLong = 0x0607'0012,
  kTooShort = 0x0607'0013,
  kNoSubindex = 0x0609'0011,
  kInvalidValue = 0x0609'0030,
  kValueTooHigh = 0x0609'0031,
  kValueTooLow = 0x0609'0032,
  kMaximumBelowMinimum = 0x0609'0036,
  kNoResource = 0x060a'0023,
  kGeneral = 0x0800'0000,
  kNotStored = 0x0800'0020,
  kLocalControl = 0x0800'0021,
  kDeviceState = 0x0800'0022,
  kNoDictionary = 0x0800'0023,
  kNoData = 0x0800'0024,
};

/// What the code means, in words; of an unknown one, nothing but that.
const char* meaning_of(AbortCode code) noexcept;
/// `0x06020000, no such object`.
std::string to_text(AbortCode code);

}  // namespace armature::canopen
