// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/abort_code.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace armature::canopen {

namespace {

struct CodeMeaning {
  AbortCode code;
  const char* meaning;
};

constexpr std::array kCodeMeanings = {
    CodeMeaning{AbortCode::kNone, "no error"},
    CodeMeaning{AbortCode::kToggleBit, "the toggle bit did not alternate"},
    CodeMeaning{AbortCode::kTimeout, "the other side did not answer in time"},
    CodeMeaning{AbortCode::kUnknownCommand, "unknown or unexpected SDO command"},
    CodeMeaning{AbortCode::kBlockSize, "invalid block size"},
    CodeMeaning{AbortCode::kSequenceNumber, "invalid sequence number in a block"},
    CodeMeaning{AbortCode::kChecksum, "wrong checksum of a block"},
    CodeMeaning{AbortCode::kOutOfMemory, "out of memory"},
    CodeMeaning{AbortCode::kUnsupportedAccess, "unsupported access to the object"},
    CodeMeaning{AbortCode::kWriteOnly, "the object can only be written"},
    CodeMeaning{AbortCode::kReadOnly, "the object can only be read"},
    CodeMeaning{AbortCode::kNoObject, "no such object"},
    CodeMeaning{AbortCode::kNotMappable, "the object cannot be mapped to a PDO"},
    CodeMeaning{AbortCode::kPdoTooLong, "the mapped objects do not fit into the PDO"},
    CodeMeaning{AbortCode::kIncompatibleParameter, "the parameter does not go with others"},
    CodeMeaning{AbortCode::kIncompatibleDevice, "the device does not go with this access"},
    CodeMeaning{AbortCode::kHardware, "an error of the hardware"},
    CodeMeaning{AbortCode::kWrongLength, "the length does not match the object's type"},
    CodeMeaning{AbortCode::kTooLong, "more bytes than the object's type has"},
    CodeMeaning{AbortCode::kTooShort, "fewer bytes than the object's type has"},
    CodeMeaning{AbortCode::kNoSubindex, "no such subindex"},
    CodeMeaning{AbortCode::kInvalidValue, "invalid value"},
    CodeMeaning{AbortCode::kValueTooHigh, "the value is too high"},
    CodeMeaning{AbortCode::kValueTooLow, "the value is too low"},
    CodeMeaning{AbortCode::kMaximumBelowMinimum, "the maximum is below the minimum"},
    CodeMeaning{AbortCode::kNoResource, "a resource is not available"},
    CodeMeaning{AbortCode::kGeneral, "general error"},
    CodeMeaning{AbortCode::kNotStored, "the data cannot be stored"},
    CodeMeaning{AbortCode::kLocalControl, "the device is controlled locally"},
    CodeMeaning{AbortCode::kDeviceState, "the device's state does not allow it"},
    CodeMeaning{AbortCode::kNoDictionary, "the device has no object dictionary"},
    CodeMeaning{AbortCode::kNoData, "there is no data"},
};

}  // namespace

const char* meaning_of(AbortCode code) noexcept {
  const auto known = std::ranges::find(kCodeMeanings, code, &CodeMeaning::code);
  return known == kCodeMeanings.end() ? "a code that CiA 301 does not have" : known->meaning;
}

std::string to_text(AbortCode code) {
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), "0x%08X", static_cast<unsigned>(code));
  return std::string(number.data()) + ", " + meaning_of(code);
}

}  // namespace armature::canopen
