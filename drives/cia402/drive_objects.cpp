// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/internal/drive_objects.hpp"

#include "drives/cia402/homing.hpp"
#include "drives/cia402/mode.hpp"
#include "drives/cia402/objects.hpp"

namespace armature::cia402::internal {
namespace {

using canopen::AbortCode;
using canopen::Access;
using canopen::Address;
using canopen::DataType;

constexpr std::uint32_t kSupported =
    supported_bit(Mode::kProfilePosition) | supported_bit(Mode::kProfileVelocity) |
    supported_bit(Mode::kHoming) | supported_bit(Mode::kCyclicPosition) |
    supported_bit(Mode::kCyclicVelocity) | supported_bit(Mode::kCyclicTorque);

class Objects {
 public:
  explicit Objects(canopen::ObjectDictionary& dictionary) : dictionary_(dictionary) {}

  /// What hosts send in each cycle.
  void command(Address address, const char* name, DataType type) {
    dictionary_.add({.address = address, .name = name, .type = type, .mappable = true});
  }
  /// What drives answer in each cycle.
  void actual(Address address, const char* name, DataType type) {
    dictionary_.add({.address = address,
                     .name = name,
                     .type = type,
                     .access = Access::kReadOnly,
                     .mappable = true});
  }
  void parameter(Address address, const char* name, DataType type, std::int64_t value) {
    dictionary_.add({.address = address, .name = name, .type = type});
    dictionary_.set_number(address, value);
  }
  void constant(Address address, const char* name, std::uint32_t value) {
    dictionary_.add({.address = address, .name = name, .access = Access::kReadOnly}, value);
  }
  void pair(std::uint16_t index, const char* name, std::uint32_t first, std::uint32_t second) {
    dictionary_.add_count(index, name, 2);
    constant({index, 1}, name, first);
    constant({index, 2}, name, second);
  }

 private:
  canopen::ObjectDictionary& dictionary_;
};

void add_cyclic(Objects& objects) {
  objects.actual(object::kErrorCode, "Error code", DataType::kUnsigned16);
  objects.command(object::kControlWord, "Controlword", DataType::kUnsigned16);
  objects.actual(object::kStatusWord, "Statusword", DataType::kUnsigned16);
  objects.command(object::kMode, "Modes of operation", DataType::kInteger8);
  objects.actual(object::kModeDisplay, "Modes of operation display", DataType::kInteger8);
  objects.actual(object::kPositionDemand, "Position demand value", DataType::kInteger32);
  objects.actual(object::kPosition, "Position actual value", DataType::kInteger32);
  objects.actual(object::kVelocity, "Velocity actual value", DataType::kInteger32);
  objects.command(object::kTargetTorque, "Target torque", DataType::kInteger16);
  objects.actual(object::kTorque, "Torque actual value", DataType::kInteger16);
  objects.actual(object::kCurrent, "Current actual value", DataType::kInteger16);
  objects.command(object::kTargetPosition, "Target position", DataType::kInteger32);
  objects.command(object::kTargetVelocity, "Target velocity", DataType::kInteger32);
}

void add_parameters(Objects& objects, const Scaling& scaling) {
  const auto speed = [&](double rad_s) { return scaling.raw_velocity(rad_s); };
  objects.parameter(object::kAbortConnection, "Abort connection option code", DataType::kInteger16,
                    1);
  objects.parameter(object::kQuickStopOption, "Quick stop option code", DataType::kInteger16, 2);
  objects.parameter(object::kFollowingErrorWindow, "Following error window", DataType::kUnsigned32,
                    scaling.raw_position(0.2));
  objects.parameter(object::kMostTorque, "Max torque", DataType::kUnsigned16, 3000);
  objects.parameter(object::kHomeOffset, "Home offset", DataType::kInteger32, 0);
  objects.parameter(object::kProfileVelocity, "Profile velocity", DataType::kUnsigned32,
                    speed(1.0));
  objects.parameter(object::kProfileAcceleration, "Profile acceleration", DataType::kUnsigned32,
                    speed(10.0));
  objects.parameter(object::kProfileDeceleration, "Profile deceleration", DataType::kUnsigned32,
                    speed(10.0));
  objects.parameter(object::kQuickStopDeceleration, "Quick stop deceleration",
                    DataType::kUnsigned32, speed(50.0));
  objects.parameter(object::kHomingMethod, "Homing method", DataType::kInteger8, 37);
  objects.parameter(object::kHomingSpeed, "Speed during search for switch", DataType::kUnsigned32,
                    speed(0.5));
  objects.parameter(object::kHomingSlowSpeed, "Speed during search for zero", DataType::kUnsigned32,
                    speed(0.1));
  objects.parameter(object::kHomingAcceleration, "Homing acceleration", DataType::kUnsigned32,
                    speed(5.0));
  objects.parameter(object::kInterpolationTime, "Interpolation time period value",
                    DataType::kUnsigned8, 2);
  objects.parameter(object::kInterpolationExponent, "Interpolation time index", DataType::kInteger8,
                    -3);
}

/// Modes and homing methods that the emulated drive has.
void add_checks(canopen::ObjectDictionary& dictionary) {
  dictionary.set_check(object::kMode, [](std::uint64_t raw) {
    const auto mode = static_cast<Mode>(static_cast<std::int8_t>(raw));
    const bool known = mode == Mode::kNone || (kSupported & supported_bit(mode)) != 0;
    return known ? AbortCode::kNone : AbortCode::kInvalidValue;
  });
  dictionary.set_check(object::kHomingMethod, [](std::uint64_t raw) {
    const auto method = find_homing_method(static_cast<std::int8_t>(raw));
    const bool has = method && method->mark != HomingMark::kHomeSwitch;
    return has ? AbortCode::kNone : AbortCode::kInvalidValue;
  });
}

}  // namespace

void add_drive_objects(canopen::ObjectDictionary& dictionary, const Factors& factors,
                       const Scaling& scaling) {
  Objects objects(dictionary);
  add_cyclic(objects);
  add_parameters(objects, scaling);
  objects.constant(object::kRatedCurrent, "Motor rated current", factors.rated_current_mA);
  objects.constant(object::kRatedTorque, "Motor rated torque", factors.rated_torque_mNm);
  objects.pair(0x608f, "Position encoder resolution", factors.encoder_increments,
               factors.motor_revolutions);
  objects.pair(0x6091, "Gear ratio", factors.gear_motor, factors.gear_shaft);
  objects.pair(0x6092, "Feed constant", factors.feed, factors.feed_shaft);
  objects.constant(object::kSupportedModes, "Supported drive modes", kSupported);
  dictionary.add_count(0x6099, "Homing speeds", 2);
  dictionary.add_count(0x60c2, "Interpolation time period", 2);
  dictionary.add({.address = object::kPolarity,
                  .name = "Polarity",
                  .type = DataType::kUnsigned8,
                  .access = Access::kReadOnly},
                 factors.polarity);
  dictionary.add_bytes(
      {.address = {0x2000, 0}, .name = "The user's own text", .type = DataType::kVisibleString},
      {});
  objects.actual(object::kEmulatedTemperature, "Temperature of the motor", DataType::kInteger16);
  add_checks(dictionary);
}

}  // namespace armature::cia402::internal
