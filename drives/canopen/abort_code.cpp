// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/abort_code.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace armature::canopen {

namespace {

struct AbortMeaning {
  AbortCode code;
  const char* meaning;
};

constexpr std::array kAbortMeanings = {
    AbortMeaning{AbortCode::kNone, "no error"},
    AbortMeaning{AbortCode::kToggleBit, "the toggle bit did not alternate"},
    AbortMeaning{AbortCode::kTimeout, "the other side did not answer in time"},
    AbortMeaning{AbortCode::kUnknownCommand, "unknown or unexpected SDO command"},
    AbortMeaning{AbortCode::kBlockSize, "invalid block size"},
    AbortMeaning{AbortCode::kSequenceNumber, "invalid sequence number in a block"},
    AbortMeaning{AbortCode::kChecksum, "wrong checksum of a block"},
    AbortMeaning{AbortCode::kOutOfMemory, "out of memory"},
    AbortMeaning{AbortCode::kUnsupportedAccess, "unsupported access to the object"},
    AbortMeaning{AbortCode::kWriteOnly, "the object can only be written"},
    AbortMeaning{AbortCode::kReadOnly, "the object can only be read"},
    AbortMeaning{AbortCode::kNoObject, "no such object"},
    AbortMeaning{AbortCode::kNotMappable, "the object cannot be mapped to a PDO"},
    AbortMeaning{AbortCode::kPdoTooLong, "the mapped objects do not fit into the PDO"},
    AbortMeaning{AbortCode::kIncompatibleParameter, "the parameter does not go with others"},
    AbortMeaning{AbortCode::kIncompatibleDevice, "the device does not go with this access"},
    AbortMeaning{AbortCode::kHardware, "an error of the hardware"},
    AbortMeaning{AbortCode::kWrongLength, "the length does not match the object's type"},
    AbortMeaning{AbortCode::kTooLong, "more bytes than the object's type has"},
    AbortMeaning{AbortCode::kTooShort, "fewer bytes than the object's type has"},
    AbortMeaning{AbortCode::kNoSubindex, "no such subindex"},
    AbortMeaning{AbortCode::kInvalidValue, "invalid value"},
    AbortMeaning{AbortCode::kValueTooHigh, "the value is too high"},
    AbortMeaning{AbortCode::kValueTooLow, "the value is too low"},
    AbortMeaning{AbortCode::kMaximumBelowMinimum, "the maximum is below the minimum"},
    AbortMeaning{AbortCode::kNoResource, "a resource is not available"},
    AbortMeaning{AbortCode::kGeneral, "general error"},
    AbortMeaning{AbortCode::kNotStored, "the data cannot be stored"},
    AbortMeaning{AbortCode::kLocalControl, "the device is controlled locally"},
    AbortMeaning{AbortCode::kDeviceState, "the device's state does not allow it"},
    AbortMeaning{AbortCode::kNoDictionary, "the device has no object dictionary"},
    AbortMeaning{AbortCode::kNoData, "there is no data"},
};

}  // namespace

const char* meaning_of(AbortCode code) noexcept {
  const auto known = std::ranges::find(kAbortMeanings, code, &AbortMeaning::code);
  return known == kAbortMeanings.end() ? "a code that CiA 301 does not have" : known->meaning;
}

std::string to_text(AbortCode code) {
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), "0x%08X", static_cast<unsigned>(code));
  return std::string(number.data()) + ", " + meaning_of(code);
}

}  // namespace armature::canopen
