// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_protocol.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace armature::janus {
namespace {

constexpr std::uint32_t kFunctionBits = 0x780;
constexpr std::uint32_t kNumberBits = 0x07f;
constexpr double kFullScale = 32767.0;
constexpr std::uint8_t kIndexFlag = 1u << 0;
constexpr std::uint8_t kActuatorFlag = 1u << 1;
constexpr std::uint8_t kBrakeFlag = 1u << 2;
constexpr std::uint8_t kFaultFlag = 1u << 3;
constexpr std::uint8_t kWatchdogFlag = 1u << 4;

/// Writes little-endian numbers one after the other.
class Writer {
 public:
  Writer(AicFunction function, int number) { frame_.id = identifier(function, number); }

  template <typename T>
  Writer& put(T value) {
    const auto bits = static_cast<std::make_unsigned_t<T>>(value);
    for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
      frame_.data[frame_.size++] = static_cast<std::uint8_t>(bits >> 8 * byte);
    }
    return *this;
  }
  can::Frame frame() const { return frame_; }

 private:
  can::Frame frame_;
};

/// A little-endian number of a frame.
template <typename T>
T number_at(const can::Frame& frame, std::size_t begin) {
  std::make_unsigned_t<T> bits = 0;
  for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
    bits = static_cast<std::make_unsigned_t<T>>(
        bits | static_cast<std::make_unsigned_t<T>>(frame.data[begin + byte]) << 8 * byte);
  }
  return static_cast<T>(bits);
}

constexpr std::uint8_t flag(bool set, std::uint8_t bit) { return set ? bit : std::uint8_t{0}; }

bool is_state(std::uint8_t code) { return code <= static_cast<std::uint8_t>(AicState::kFault); }

/// Whether the protocol has such a number for the function.
bool number_fits(AicFunction function, int number) {
  switch (function) {
    case AicFunction::kSync:
      return number == 0;
    case AicFunction::kMotorGroup:
      return number <= group_of(kMostCards);
    default:
      return number >= 1;
  }
}

}  // namespace

std::optional<AicAddress> address_of(const can::Frame& frame) {
  if (frame.extended || frame.kind != can::FrameKind::kData) return std::nullopt;
  const auto function = static_cast<AicFunction>(frame.id & kFunctionBits);
  const int number = static_cast<int>(frame.id & kNumberBits);
  if (frame.id > identifier(AicFunction::kHeartbeat, kMostCards) ||
      !number_fits(function, number)) {
    return std::nullopt;
  }
  return AicAddress{function, number};
}

const char* to_text(AicState state) {
  switch (state) {
    case AicState::kStarted:
      return "started";
    case AicState::kOff:
      return "off";
    case AicState::kOn:
      return "on";
    case AicState::kWatchdog:
      return "watchdog";
    case AicState::kFault:
      return "fault";
  }
  return "?";
}

const char* to_text(AicEmergency emergency) {
  switch (emergency) {
    case AicEmergency::kOverCurrent:
      return "over-current";
    case AicEmergency::kWatchdog:
      return "watchdog";
    case AicEmergency::kEncoder:
      return "encoder";
    case AicEmergency::kSupply:
      return "supply";
  }
  return "?";
}

std::int16_t motor_value(double share) {
  if (std::isnan(share)) return 0;
  return static_cast<std::int16_t>(std::lround(std::clamp(share, -1.0, 1.0) * kFullScale));
}

double motor_share(std::int16_t value) { return std::max(value / kFullScale, -1.0); }

can::Frame emergency_frame(int card, const Emergency& emergency) {
  return Writer(AicFunction::kEmergency, card)
      .put(static_cast<std::uint8_t>(emergency.code))
      .put(static_cast<std::uint8_t>(emergency.state))
      .frame();
}

can::Frame sync_frame(std::uint8_t counter) {
  return Writer(AicFunction::kSync, 0).put(counter).frame();
}

can::Frame command_frame(int card, AicCommand command) {
  return Writer(AicFunction::kCommand, card).put(static_cast<std::uint8_t>(command)).frame();
}

can::Frame watchdog_frame(int card, std::uint16_t milliseconds) {
  return Writer(AicFunction::kCommand, card)
      .put(static_cast<std::uint8_t>(AicCommand::kWatchdog))
      .put(milliseconds)
      .frame();
}

can::Frame sensor_frame(int card, const SensorReport& report) {
  const auto flags = static_cast<std::uint8_t>(
      flag(report.index, kIndexFlag) | flag(report.actuator_on, kActuatorFlag) |
      flag(report.brake_released, kBrakeFlag) | flag(report.fault, kFaultFlag) |
      flag(report.watchdog_tripped, kWatchdogFlag));
  return Writer(AicFunction::kSensor, card)
      .put(report.counts)
      .put(flags)
      .put(report.counter)
      .put(report.current_ma)
      .frame();
}

can::Frame motor_frame(int card, std::int16_t value) {
  return Writer(AicFunction::kMotor, card).put(value).frame();
}

can::Frame motor_group_frame(int group, const GroupValues& values) {
  Writer writer(AicFunction::kMotorGroup, group);
  for (const std::int16_t value : values) writer.put(value);
  return writer.frame();
}

can::Frame request_frame(int card) { return Writer(AicFunction::kRequest, card).frame(); }

can::Frame heartbeat_frame(int card, const Heartbeat& heartbeat) {
  return Writer(AicFunction::kHeartbeat, card)
      .put(static_cast<std::uint8_t>(heartbeat.state))
      .put(heartbeat.firmware_version)
      .put(heartbeat.uptime_s)
      .frame();
}

std::optional<Emergency> parse_emergency(const can::Frame& frame) {
  if (frame.size != 2 || !is_state(frame.data[1])) return std::nullopt;
  if (frame.data[0] < static_cast<std::uint8_t>(AicEmergency::kOverCurrent) ||
      frame.data[0] > static_cast<std::uint8_t>(AicEmergency::kSupply)) {
    return std::nullopt;
  }
  return Emergency{static_cast<AicEmergency>(frame.data[0]), static_cast<AicState>(frame.data[1])};
}

std::optional<SensorReport> parse_sensor(const can::Frame& frame) {
  if (frame.size != 8) return std::nullopt;
  const std::uint8_t flags = frame.data[4];
  SensorReport report;
  report.counts = number_at<std::int32_t>(frame, 0);
  report.index = (flags & kIndexFlag) != 0;
  report.actuator_on = (flags & kActuatorFlag) != 0;
  report.brake_released = (flags & kBrakeFlag) != 0;
  report.fault = (flags & kFaultFlag) != 0;
  report.watchdog_tripped = (flags & kWatchdogFlag) != 0;
  report.counter = frame.data[5];
  report.current_ma = number_at<std::int16_t>(frame, 6);
  return report;
}

std::optional<Heartbeat> parse_heartbeat(const can::Frame& frame) {
  if (frame.size != 5 || !is_state(frame.data[0])) return std::nullopt;
  return Heartbeat{static_cast<AicState>(frame.data[0]), number_at<std::uint16_t>(frame, 1),
                   number_at<std::uint16_t>(frame, 3)};
}

std::optional<AicCommand> parse_command(const can::Frame& frame) {
  if (frame.size == 0 || frame.data[0] < static_cast<std::uint8_t>(AicCommand::kActuatorOn) ||
      frame.data[0] > static_cast<std::uint8_t>(AicCommand::kIdentify)) {
    return std::nullopt;
  }
  const auto command = static_cast<AicCommand>(frame.data[0]);
  const int size = command == AicCommand::kWatchdog ? 3 : 1;
  return frame.size == size ? std::optional(command) : std::nullopt;
}

std::optional<std::int16_t> parse_motor(const can::Frame& frame) {
  if (frame.size != 2) return std::nullopt;
  return number_at<std::int16_t>(frame, 0);
}

std::optional<GroupValues> parse_motor_group(const can::Frame& frame) {
  if (frame.size != 8) return std::nullopt;
  GroupValues values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = number_at<std::int16_t>(frame, 2 * i);
  return values;
}

std::optional<std::uint16_t> parse_watchdog(const can::Frame& frame) {
  if (parse_command(frame) != AicCommand::kWatchdog) return std::nullopt;
  const auto milliseconds = number_at<std::uint16_t>(frame, 1);
  return milliseconds > 0 ? std::optional(milliseconds) : std::nullopt;
}

}  // namespace armature::janus
