// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/abort_code.hpp"

#include <array>
#include <cstdio>

namespace armature::canopen {

const char* meaning_of(AbortCode code) noexcept {
  switch (code) {
    case AbortCode::kNone:
      return "no error";
    case AbortCode::kToggleBit:
      return "the toggle bit did not alternate";
    case AbortCode::kTimeout:
      return "the other side did not answer in time";
    case AbortCode::kUnknownCommand:
      return "unknown or unexpected SDO command";
    case AbortCode::kBlockSize:
      return "invalid block size";
    case AbortCode::kSequenceNumber:
      return "invalid sequence number in a block";
    case AbortCode::kChecksum:
      return "wrong checksum of a block";
    case AbortCode::kOutOfMemory:
      return "out of memory";
    case AbortCode::kUnsupportedAccess:
      return "unsupported access to the object";
    case AbortCode::kWriteOnly:
      return "the object can only be written";
    case AbortCode::kReadOnly:
      return "the object can only be read";
    case AbortCode::kNoObject:
      return "no such object";
    case AbortCode::kNotMappable:
      return "the object cannot be mapped to a PDO";
    case AbortCode::kPdoTooLong:
      return "the mapped objects do not fit into the PDO";
    case AbortCode::kIncompatibleParameter:
      return "the parameter does not go with others";
    case AbortCode::kIncompatibleDevice:
      return "the device does not go with this access";
    case AbortCode::kHardware:
      return "an error of the hardware";
    case AbortCode::kWrongLength:
      return "the length does not match the object's type";
    case AbortCode::kTooLong:
      return "more bytes than the object's type has";
    case AbortCode::kTooShort:
      return "fewer bytes than the object's type has";
    case AbortCode::kNoSubindex:
      return "no such subindex";
    case AbortCode::kInvalidValue:
      return "invalid value";
    case AbortCode::kValueTooHigh:
      return "the value is too high";
    case AbortCode::kValueTooLow:
      return "the value is too low";
    case AbortCode::kMaximumBelowMinimum:
      return "the maximum is below the minimum";
    case AbortCode::kNoResource:
      return "a resource is not available";
    case AbortCode::kGeneral:
      return "general error";
    case AbortCode::kNotStored:
      return "the data cannot be stored";
    case AbortCode::kLocalControl:
      return "the device is controlled locally";
    case AbortCode::kDeviceState:
      return "the device's state does not allow it";
    case AbortCode::kNoDictionary:
      return "the device has no object dictionary";
    case AbortCode::kNoData:
      return "there is no data";
  }
  return "a code that CiA 301 does not have";
}

std::string to_text(AbortCode code) {
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), "0x%08X", static_cast<unsigned>(code));
  return std::string(number.data()) + ", " + meaning_of(code);
}

}  // namespace armature::canopen
