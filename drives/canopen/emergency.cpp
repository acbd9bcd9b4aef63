// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/emergency.hpp"

#include <algorithm>
#include <cstdio>
#include <span>

#include "drives/canopen/little_endian.hpp"

namespace armature::canopen {
namespace {

struct EmergencyMeaning {
  std::uint16_t mask;
  std::uint16_t code;
  const char* meaning;
};

/// The narrowest first.
constexpr std::array kEmergencyMeanings = {
    EmergencyMeaning{0xffff, 0x2310, "overcurrent at the output"},
    EmergencyMeaning{0xffff, 0x2320, "short circuit or earth leakage at the output"},
    EmergencyMeaning{0xffff, 0x3210, "the voltage of the DC link is too high"},
    EmergencyMeaning{0xffff, 0x3220, "the voltage of the DC link is too low"},
    EmergencyMeaning{0xffff, 0x4310, "the drive is too hot"},
    EmergencyMeaning{0xffff, 0x5441, "a contact of the emergency stop is open"},
    EmergencyMeaning{0xffff, 0x7121, "the motor is blocked"},
    EmergencyMeaning{0xffff, 0x7305, "error of the first incremental sensor"},
    EmergencyMeaning{0xffff, 0x8110, "CAN overrun, frames were lost"},
    EmergencyMeaning{0xffff, 0x8120, "the CAN controller is error passive"},
    EmergencyMeaning{0xffff, 0x8130, "a heartbeat is missing"},
    EmergencyMeaning{0xffff, 0x8140, "recovered from bus-off"},
    EmergencyMeaning{0xffff, 0x8150, "CAN-ID collision"},
    EmergencyMeaning{0xffff, 0x8210, "a PDO was too short and not processed"},
    EmergencyMeaning{0xffff, 0x8220, "a PDO was too long"},
    EmergencyMeaning{0xffff, 0x8240, "SYNC has an unexpected length"},
    EmergencyMeaning{0xffff, 0x8250, "an expected PDO did not arrive"},
    EmergencyMeaning{0xffff, 0x8611, "the following error is too large"},
    EmergencyMeaning{0xffff, 0x8700, "the synchronisation was lost"},
    EmergencyMeaning{0xff00, 0x0000, "no error, or all errors are gone"},
    EmergencyMeaning{0xff00, 0x1000, "generic error"},
    EmergencyMeaning{0xff00, 0x2100, "current at the input of the device"},
    EmergencyMeaning{0xff00, 0x2200, "current inside the device"},
    EmergencyMeaning{0xff00, 0x2300, "current at the output of the device"},
    EmergencyMeaning{0xff00, 0x3100, "mains voltage"},
    EmergencyMeaning{0xff00, 0x3200, "voltage inside the device"},
    EmergencyMeaning{0xff00, 0x3300, "output voltage"},
    EmergencyMeaning{0xff00, 0x4100, "ambient temperature"},
    EmergencyMeaning{0xff00, 0x4200, "temperature of the device"},
    EmergencyMeaning{0xff00, 0x4300, "temperature of the drive"},
    EmergencyMeaning{0xff00, 0x5400, "power section"},
    EmergencyMeaning{0xff00, 0x6100, "software inside the device"},
    EmergencyMeaning{0xff00, 0x6200, "the user's software"},
    EmergencyMeaning{0xff00, 0x6300, "data set"},
    EmergencyMeaning{0xff00, 0x7100, "power module of the drive"},
    EmergencyMeaning{0xff00, 0x7300, "sensor"},
    EmergencyMeaning{0xff00, 0x8100, "communication"},
    EmergencyMeaning{0xff00, 0x8200, "protocol"},
    EmergencyMeaning{0xff00, 0x8300, "torque control"},
    EmergencyMeaning{0xff00, 0x8400, "velocity control"},
    EmergencyMeaning{0xff00, 0x8500, "position control"},
    EmergencyMeaning{0xff00, 0x8600, "positioning"},
    EmergencyMeaning{0xff00, 0x9000, "external error"},
    EmergencyMeaning{0xff00, 0xf000, "additional functions"},
    EmergencyMeaning{0xff00, 0xff00, "specific to the device, see its manual"},
    EmergencyMeaning{0xf000, 0x2000, "current"},
    EmergencyMeaning{0xf000, 0x3000, "voltage"},
    EmergencyMeaning{0xf000, 0x4000, "temperature"},
    EmergencyMeaning{0xf000, 0x5000, "hardware of the device"},
    EmergencyMeaning{0xf000, 0x6000, "software of the device"},
    EmergencyMeaning{0xf000, 0x7000, "additional modules"},
    EmergencyMeaning{0xf000, 0x8000, "monitoring"},
};

}  // namespace

can::Frame emergency_frame(const Emergency& emergency) noexcept {
  std::array<std::uint8_t, 8> bytes{};
  store(std::span(bytes).first(2), emergency.code);
  bytes[2] = emergency.error_register;
  std::ranges::copy(emergency.manufacturer, bytes.begin() + 3);
  return can::data_frame(cob_id::emergency(emergency.node), bytes);
}

std::optional<Emergency> parse_emergency(const can::Frame& frame) noexcept {
  const Origin origin = origin_of(frame);
  if (origin.service != Service::kEmergency || frame.size != 8) return std::nullopt;
  Emergency emergency{.node = origin.node,
                      .code = static_cast<std::uint16_t>(load(frame.bytes().first(2))),
                      .error_register = frame.data[2]};
  std::copy_n(frame.data.begin() + 3, emergency.manufacturer.size(),
              emergency.manufacturer.begin());
  return emergency;
}

const char* meaning_of_emergency(std::uint16_t code) noexcept {
  const auto* const found = std::ranges::find_if(
      kEmergencyMeanings,
      [code](const EmergencyMeaning& each) { return (code & each.mask) == each.code; });
  return found == kEmergencyMeanings.end() ? "a code that the standards do not have"
                                           : found->meaning;
}

std::string to_text(const Emergency& emergency) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "node %u reports 0x%04X, %s (error register 0x%02X)",
                static_cast<unsigned>(emergency.node), static_cast<unsigned>(emergency.code),
                meaning_of_emergency(emergency.code),
                static_cast<unsigned>(emergency.error_register));
  return text.data();
}

}  // namespace armature::canopen
