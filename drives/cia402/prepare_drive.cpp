// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/prepare_drive.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "drives/cia402/cycle_pdos.hpp"
#include "drives/cia402/objects.hpp"

namespace armature::cia402 {
namespace {

using canopen::Address;
using canopen::DataType;
using canopen::PdoDirection;

/// As many periods without a heartbeat are a loss.
constexpr int kHeartbeatsToMiss = 3;

std::string hexadecimal(std::int64_t number) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "0x%llX", static_cast<unsigned long long>(number));
  return text.data();
}

/// One drive on its way to a configuration; errors go to the diagnostics, with its name.
class Preparation {
 public:
  Preparation(canopen::SdoChannel& channel, const DriveWish& wish, base::Diagnostics& diagnostics)
      : channel_(channel), wish_(wish), diagnostics_(diagnostics) {}

  /// Whether it answers, and is who it should be.
  bool compare() {
    const auto type = read({0x1000, 0}, DataType::kUnsigned32);
    if (!type) return false;
    if ((*type & 0xffff) != 402) {
      error("object 0x1000:00 is " + hexadecimal(*type) + ", which is no drive by CiA 402",
            "look for the node's number");
      return false;
    }
    if (wish_.identity) compare_identity(*wish_.identity);
    const auto supported = read(object::kSupportedModes, DataType::kUnsigned32);
    if (supported && (*supported & supported_bit(wish_.mode)) == 0) {
      error("it does not support mode " + std::string(to_text(wish_.mode)),
            "it has: " + supported_text(static_cast<std::uint32_t>(*supported)));
    }
    return diagnostics_.ok();
  }

  std::optional<Scaling> read_scaling() {
    const auto factors = read_factors(channel_);
    if (!factors) {
      error(factors.error());
      return std::nullopt;
    }
    auto scaling = Scaling::make(factors.value(), wish_.unit);
    if (scaling) return scaling.value();
    error(scaling.error());
    return std::nullopt;
  }

  void write_parameters() {
    using std::chrono::duration_cast;
    const auto cycle_us = duration_cast<std::chrono::microseconds>(wish_.cycle).count();
    const auto heartbeat_ms = duration_cast<std::chrono::milliseconds>(wish_.heartbeat).count();
    write({0x1006, 0}, DataType::kUnsigned32, cycle_us);
    write({0x1017, 0}, DataType::kUnsigned16, heartbeat_ms);
    write_interpolation(cycle_us);
    write(object::kMode, DataType::kInteger8, static_cast<int>(wish_.mode));
  }

  void write_pdos(const DriveConfig& config) {
    for (unsigned i = 0; i < config.receive.size(); ++i) {
      keep(canopen::write_pdo(channel_, PdoDirection::kReceive, i + 1, config.receive[i]));
    }
    for (unsigned i = 0; i < config.transmit.size(); ++i) {
      keep(canopen::write_pdo(channel_, PdoDirection::kTransmit, i + 1, config.transmit[i]));
    }
  }

 private:
  void error(const std::string& what, const char* hint = "") {
    diagnostics_.error({}, prefix() + what, std::string(hint));
  }
  void error(const std::string& what, const std::string& hint) {
    diagnostics_.error({}, prefix() + what, hint);
  }
  std::string prefix() const {
    return "drive '" + wish_.name + "', node " + std::to_string(wish_.node) + ": ";
  }
  void keep(const base::Result<void>& result) {
    if (!result) error(result.error());
  }
  std::optional<std::int64_t> read(Address address, DataType type) {
    const auto value = channel_.read(address, type);
    if (value) return value.value();
    error(value.error());
    return std::nullopt;
  }
  void write(Address address, DataType type, std::int64_t value) {
    keep(channel_.write(address, type, value));
  }

  void compare_identity(const canopen::Identity& wanted) {
    const std::array<std::pair<const char*, std::uint32_t>, 4> numbers = {
        {{"vendor", wanted.vendor},
         {"product", wanted.product},
         {"revision", wanted.revision},
         {"serial number", wanted.serial}}};
    for (std::uint8_t i = 0; i < numbers.size(); ++i) {
      const auto& [what, number] = numbers[i];
      if (number == 0) continue;
      const auto found = read({0x1018, static_cast<std::uint8_t>(i + 1)}, DataType::kUnsigned32);
      if (!found || *found == number) continue;
      error(std::string(what) + " is " + hexadecimal(*found) + ", expected " + hexadecimal(number),
            "another drive has this node's number, or it was exchanged");
    }
  }

  /// 0x60C2 in the largest unit that needs at most a byte.
  void write_interpolation(std::int64_t cycle_us) {
    if (wish_.mode != Mode::kCyclicPosition) return;
    std::int64_t value = cycle_us;
    int exponent = -6;
    while (value % 10 == 0 && value > 0 && exponent < 0) {
      value /= 10;
      ++exponent;
    }
    if (value > 255) {
      error("its interpolation time 0x60C2 has no form for a cycle of " + std::to_string(cycle_us) +
                " us",
            "choose a cycle of at most three digits, such as 2 ms");
      return;
    }
    write(object::kInterpolationTime, DataType::kUnsigned8, value);
    write(object::kInterpolationExponent, DataType::kInteger8, exponent);
  }

  canopen::SdoChannel& channel_;
  const DriveWish& wish_;
  base::Diagnostics& diagnostics_;
};

}  // namespace

base::Result<Factors> read_factors(canopen::SdoChannel& channel) {
  Factors factors;
  const std::array<std::pair<Address, std::uint32_t*>, 6> optional = {
      {{object::kEncoderIncrements, &factors.encoder_increments},
       {object::kEncoderRevolutions, &factors.motor_revolutions},
       {object::kGearMotor, &factors.gear_motor},
       {object::kGearShaft, &factors.gear_shaft},
       {object::kFeed, &factors.feed},
       {object::kFeedShaft, &factors.feed_shaft}}};
  for (const auto& [address, place] : optional) {
    const auto value = channel.read(address, DataType::kUnsigned32);
    if (value) *place = static_cast<std::uint32_t>(value.value());
  }
  const std::array<std::pair<Address, std::uint32_t*>, 2> needed = {
      {{object::kRatedTorque, &factors.rated_torque_mNm},
       {object::kRatedCurrent, &factors.rated_current_mA}}};
  for (const auto& [address, place] : needed) {
    const auto value = channel.read(address, DataType::kUnsigned32);
    if (!value) return base::Error{value.error()};
    *place = static_cast<std::uint32_t>(value.value());
  }
  if (const auto polarity = channel.read(object::kPolarity, DataType::kUnsigned8)) {
    factors.polarity = static_cast<std::uint8_t>(polarity.value());
  }
  return factors;
}

std::optional<DriveConfig> prepare_drive(canopen::SdoChannel& channel, const DriveWish& wish,
                                         base::Diagnostics& diagnostics) {
  base::Diagnostics own;
  Preparation preparation(channel, wish, own);
  std::optional<Scaling> scaling;
  if (preparation.compare()) scaling = preparation.read_scaling();
  if (!scaling) {
    diagnostics.append(own);
    return std::nullopt;
  }
  DriveConfig config{.node = wish.node,
                     .name = wish.name,
                     .mode = wish.mode,
                     .scaling = *scaling,
                     .receive = receive_pdos(wish),
                     .transmit = transmit_pdos(wish),
                     .heartbeat_timeout = wish.heartbeat * kHeartbeatsToMiss};
  preparation.write_parameters();
  preparation.write_pdos(config);
  diagnostics.append(own);
  if (!own.ok()) return std::nullopt;
  return config;
}

}  // namespace armature::cia402
