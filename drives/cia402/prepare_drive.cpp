// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/prepare_drive.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "drives/cia402/cycle_pdos.hpp"
#include "drives/cia402/drive_settings.hpp"
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

/// `0x6040:00, 0x607A:00`.
std::string mapping_text(const canopen::Pdo& pdo) {
  std::string text;
  for (const canopen::MappedObject& object : pdo.objects) {
    text += (text.empty() ? "" : ", ") + to_text(object.address);
  }
  return text.empty() ? "no object" : text;
}

/// A mapping that was there before is not written, and has to be there again.
void keep_mapping(PdoDirection direction, const std::vector<canopen::Pdo>& pdos,
                  std::vector<canopen::SdoStep>& steps) {
  unsigned number = 0;
  for (const canopen::Pdo& pdo : pdos) {
    const std::uint16_t mapping = canopen::mapping_index(direction, ++number);
    const auto count = static_cast<std::uint32_t>(pdo.objects.size());
    steps.push_back({{mapping, 0}, 1, count, false});
    for (std::uint8_t i = 0; i < count; ++i) {
      const Address entry{mapping, static_cast<std::uint8_t>(i + 1)};
      steps.push_back({entry, 4, canopen::mapping_entry(pdo.objects[i]), false});
    }
  }
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
    if (supported) compare_mode(static_cast<std::uint32_t>(*supported), wish_.mode);
    if (supported && wish_.homing) {
      compare_mode(static_cast<std::uint32_t>(*supported), Mode::kHoming);
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
    const auto settings = settings_of(wish_);
    if (!settings) return error(settings.error());
    for (const Setting& setting : settings.value()) {
      const auto written = channel_.write(setting.address, setting.type, setting.value);
      const bool watches = setting.address == kConsumedHeartbeat;
      if (!written) error(written.error(), watches ? "leave out the host's heartbeat" : "");
    }
  }

  /// How it homes, in its own units.
  void write_homing(const Scaling& scaling) {
    if (!wish_.homing) return;
    const HomingWish& homing = *wish_.homing;
    const std::array<Setting, 5> settings = {
        {{object::kHomingMethod, DataType::kInteger8, homing.method},
         {object::kHomingSpeed, DataType::kUnsigned32, scaling.raw_velocity(homing.speed)},
         {object::kHomingSlowSpeed, DataType::kUnsigned32, scaling.raw_velocity(homing.slow_speed)},
         {object::kHomingAcceleration, DataType::kUnsigned32,
          scaling.raw_velocity(homing.acceleration)},
         {object::kHomeOffset, DataType::kInteger32, scaling.raw_position(homing.offset)}}};
    for (const Setting& setting : settings) {
      const auto written = channel_.write(setting.address, setting.type, setting.value);
      if (!written) {
        error(written.error(), "choose another homing method or speed, or leave out homing_method");
      }
    }
  }

  /// A drive that has the object and does nothing when it loses its host is told to fault. What
  /// others do is theirs, and has to be the same after they lost their power.
  void have_it_stop_without_host(std::vector<canopen::SdoStep>& steps) {
    if (!wish_.host) return;
    constexpr Address kOption = object::kAbortConnection;
    constexpr int kFault = 1;
    auto found = channel_.read(kOption, DataType::kInteger16);
    if (!found) return;
    base::Result<void> written;
    if (found.value() == 0) {
      written = channel_.write(kOption, DataType::kInteger16, kFault);
      found = channel_.read(kOption, DataType::kInteger16);
    }
    if (found && found.value() != 0) {
      steps.push_back({kOption, 2, static_cast<std::uint16_t>(found.value()), false});
      return;
    }
    error("object 0x6007:00 is 0, so it goes on moving when it loses its host: " +
              (written ? "it does not keep another value" : written.error()),
          "set it to 1, fault, with its maker's tool, or leave out the host's heartbeat");
  }

  void write_pdos(const DriveConfig& config) {
    write_pdos(PdoDirection::kReceive, config.receive);
    write_pdos(PdoDirection::kTransmit, config.transmit);
  }

  /// Who it is now, so that nobody else is prepared in its place.
  void keep_identity(std::vector<canopen::SdoStep>& steps) {
    for (std::uint8_t sub = 1; sub <= 4; ++sub) {
      const Address address{0x1018, sub};
      const auto found = channel_.read(address, DataType::kUnsigned32);
      if (found) steps.push_back({address, 4, static_cast<std::uint32_t>(found.value()), false});
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
  void compare_mode(std::uint32_t supported, Mode wanted) {
    if ((supported & supported_bit(wanted)) != 0) return;
    error("it does not support mode " + std::string(to_text(wanted)),
          "it has: " + supported_text(supported));
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

  /// Some drives take a mapping, and keep their own.
  void write_pdos(PdoDirection direction, const std::vector<canopen::Pdo>& pdos) {
    unsigned number = 0;
    for (const canopen::Pdo& wanted : pdos) {
      ++number;
      const auto written = canopen::write_pdo(channel_, direction, number, wanted);
      const auto found = canopen::read_pdo(channel_, direction, number);
      if (!found || found.value().objects != wanted.objects) {
        error(std::string(to_text(direction)) + " " + std::to_string(number) + " has " +
                  (found ? mapping_text(found.value()) : found.error()) + ", expected " +
                  mapping_text(wanted) + (written ? "" : ": " + written.error()),
              "map it so with its maker's tool, if this host may not");
      } else {
        keep(written);
      }
    }
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
  std::vector<canopen::SdoStep> steps;
  preparation.keep_identity(steps);
  channel.record(steps);
  DriveConfig config{.node = wish.node,
                     .name = wish.name,
                     .mode = wish.mode,
                     .scaling = *scaling,
                     .receive = receive_pdos(wish),
                     .transmit = transmit_pdos(wish),
                     .heartbeat_timeout = wish.heartbeat * kHeartbeatsToMiss};
  preparation.write_parameters();
  preparation.write_homing(*scaling);
  preparation.have_it_stop_without_host(steps);
  preparation.write_pdos(config);
  keep_mapping(PdoDirection::kReceive, config.receive, steps);
  keep_mapping(PdoDirection::kTransmit, config.transmit, steps);
  config.preparation = std::move(steps);
  diagnostics.append(own);
  if (!own.ok()) return std::nullopt;
  return config;
}

}  // namespace armature::cia402
