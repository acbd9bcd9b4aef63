// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "armature/base/time.hpp"
#include "armature/can/frame.hpp"

namespace armature::janus {

// What the AIC cards and their host say to each other, frame by frame: see PROTOCOL.md. Cards are
// numbered 1 to kMostCards. Everything here is nonblocking and allocates nothing.

constexpr int kMostCards = 127;
constexpr int kCardsPerGroup = 4;
constexpr std::uint32_t kBitRate = 1'000'000;
/// From the end of a request to the answer.
constexpr base::Duration kProcessingTime = std::chrono::microseconds(90);
constexpr base::Duration kHeartbeatPeriod = std::chrono::milliseconds(100);
constexpr base::Duration kDefaultWatchdog = std::chrono::milliseconds(100);
constexpr std::uint16_t kFirmwareVersion = 0x0100;

/// The upper four bits of an identifier; the lower seven are the card's number, or the group's.
enum class AicFunction : std::uint32_t {
  kEmergency = 0x000,
  kSync = 0x080,
  kCommand = 0x100,
  kSensor = 0x180,
  kMotor = 0x200,
  kMotorGroup = 0x280,
  kRequest = 0x300,
  kHeartbeat = 0x380,
};

constexpr std::uint32_t identifier(AicFunction function, int number) {
  return static_cast<std::uint32_t>(function) + static_cast<std::uint32_t>(number);
}

/// What a frame is for, and for which card, or group for kMotorGroup; 0 for kSync.
struct AicAddress {
  AicFunction function;
  int number;
};

/// None for what is no data frame with 11 bits, and for identifiers that the protocol does not use.
std::optional<AicAddress> address_of(const can::Frame& frame);

enum class AicCommand : std::uint8_t {
  kActuatorOn = 1,
  kActuatorOff = 2,  ///< also acknowledges a fault or the watchdog
  kBrakeApply = 3,
  kBrakeRelease = 4,
  kWatchdog = 5,  ///< with its time
  kIdentify = 6,  ///< answered by a heartbeat
};

enum class AicState : std::uint8_t {
  kStarted = 0,   ///< off, and not commanded on or off since power-up
  kOff = 1,       ///< the actuator is off
  kOn = 2,        ///< motor values are applied
  kWatchdog = 3,  ///< the host was silent: motor off, brake applied, until acknowledged
  kFault = 4,     ///< as told by the emergency frame: motor off, brake applied, until acknowledged
};

enum class AicEmergency : std::uint8_t {
  kOverCurrent = 1,
  kWatchdog = 2,
  kEncoder = 3,
  kSupply = 4,
};

const char* to_text(AicState state);
const char* to_text(AicEmergency emergency);

/// What the sensor frame has.
struct SensorReport {
  std::int32_t counts = 0;  ///< of the encoder, since the last report
  bool index = false;
  bool actuator_on = false;
  bool brake_released = false;
  bool fault = false;
  bool watchdog_tripped = false;
  std::uint8_t counter = 0;  ///< of reports: 0 for the first since power-up, then 1 to 255 in turn
  std::int16_t current_ma = 0;

  friend bool operator==(const SensorReport&, const SensorReport&) = default;
};

struct Heartbeat {
  AicState state = AicState::kStarted;
  std::uint16_t firmware_version = 0;
  std::uint16_t uptime_s = 0;  ///< stays at its largest value

  friend bool operator==(const Heartbeat&, const Heartbeat&) = default;
};

struct Emergency {
  AicEmergency code = AicEmergency::kOverCurrent;
  AicState state = AicState::kFault;

  friend bool operator==(const Emergency&, const Emergency&) = default;
};

/// Shares of the supply, -1 to 1, as they go over the wire; what is no number is 0.
std::int16_t motor_value(double share);
double motor_share(std::int16_t value);

constexpr int group_of(int card) { return (card - 1) / kCardsPerGroup; }
constexpr int place_in_group(int card) { return (card - 1) % kCardsPerGroup; }
using GroupValues = std::array<std::int16_t, kCardsPerGroup>;

/// The counter of the report behind one with `counter`.
constexpr std::uint8_t next_counter(std::uint8_t counter) {
  return static_cast<std::uint8_t>(counter == 255 ? 1 : counter + 1);
}
/// How many reports later one with counter `now` was made: 0 the same, 1 the next.
/// @param now  not 0
constexpr int reports_since(std::uint8_t last, std::uint8_t now) {
  return last == 0 ? now : (now - last + 255) % 255;
}

// To frames.
can::Frame emergency_frame(int card, const Emergency& emergency);
can::Frame sync_frame(std::uint8_t counter);
can::Frame command_frame(int card, AicCommand command);
can::Frame watchdog_frame(int card, std::uint16_t milliseconds);
can::Frame sensor_frame(int card, const SensorReport& report);
can::Frame motor_frame(int card, std::int16_t value);
can::Frame motor_group_frame(int group, const GroupValues& values);
can::Frame request_frame(int card);
can::Frame heartbeat_frame(int card, const Heartbeat& heartbeat);

// From frames, by their data alone; none if the length is wrong, or a code is unknown.
std::optional<Emergency> parse_emergency(const can::Frame& frame);
std::optional<SensorReport> parse_sensor(const can::Frame& frame);
std::optional<Heartbeat> parse_heartbeat(const can::Frame& frame);
std::optional<AicCommand> parse_command(const can::Frame& frame);
std::optional<std::int16_t> parse_motor(const can::Frame& frame);
std::optional<GroupValues> parse_motor_group(const can::Frame& frame);
/// The time of kWatchdog; none also for 0.
std::optional<std::uint16_t> parse_watchdog(const can::Frame& frame);

}  // namespace armature::janus
