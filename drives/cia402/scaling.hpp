// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/base/result.hpp"

namespace armature::cia402 {

/// What a drive says of its units in its factor group (CiA 402-2, chapter 8), as raw numbers.
struct Factors {
  std::uint32_t encoder_increments = 1;  ///< 0x608F:01
  std::uint32_t motor_revolutions = 1;   ///< 0x608F:02, for these increments
  std::uint32_t gear_motor = 1;          ///< 0x6091:01, revolutions of the motor
  std::uint32_t gear_shaft = 1;          ///< 0x6091:02, for these of the driving shaft
  std::uint32_t feed = 1;                ///< 0x6092:01, position units
  std::uint32_t feed_shaft = 1;          ///< 0x6092:02, for these revolutions of the shaft
  std::uint32_t rated_torque_mNm = 1;    ///< 0x6076 [mN m], of the motor
  std::uint32_t rated_current_mA = 1;    ///< 0x6075 [mA]
  std::uint8_t polarity = 0;             ///< 0x607E: bit 7 inverts positions, bit 6 velocities

  friend bool operator==(const Factors&, const Factors&) = default;
};

/// What the position unit of a drive is.
enum class PositionUnit : std::uint8_t {
  kIncrements,  ///< of the encoder at the motor; the feed constant does not count
  kFeed,        ///< `feed` of them for `feed_shaft` revolutions of the driving shaft
};

/// From a drive's numbers to SI and back. Velocities are position units a second, torques and
/// currents thousandths of the rated ones. Torques are at the driving shaft, behind the gear,
/// without its losses. Polarity is the drive's own business: with 0x607E the drive inverts, so that
/// its numbers already have the sign of the joint; `polarity` is for showing and comparing.
class Scaling {
 public:
  Scaling() = default;
  /// An error names the object of the drive that is 0 and may not be.
  static base::Result<Scaling> make(const Factors& factors, PositionUnit unit);

  /// @param raw  0x6064, 0x607A
  /// @return [rad] of the driving shaft
  /// @rt nonblocking, no allocation
  double position(std::int64_t raw) const noexcept {
    return static_cast<double>(raw) * radians_per_unit_;
  }
  /// @return the nearest number, within 32 bits
  /// @rt nonblocking, no allocation
  std::int32_t raw_position(double position_rad) const noexcept;
  /// @param raw  0x606C, 0x60FF
  /// @return [rad/s]
  /// @rt nonblocking, no allocation
  double velocity(std::int64_t raw) const noexcept { return position(raw); }
  /// @rt nonblocking, no allocation
  std::int32_t raw_velocity(double velocity_rad_s) const noexcept {
    return raw_position(velocity_rad_s);
  }
  /// @param raw  0x6077, 0x6071
  /// @return [N m] at the driving shaft
  /// @rt nonblocking, no allocation
  double torque(std::int64_t raw) const noexcept {
    return static_cast<double>(raw) * torque_per_thousandth_;
  }
  /// @return the nearest number, within 16 bits
  /// @rt nonblocking, no allocation
  std::int16_t raw_torque(double torque_Nm) const noexcept;
  /// @param raw  0x6078
  /// @return [A]
  /// @rt nonblocking, no allocation
  double current(std::int64_t raw) const noexcept {
    return static_cast<double>(raw) * current_per_thousandth_;
  }

 private:
  double radians_per_unit_ = 1.0;
  double torque_per_thousandth_ = 1.0;
  double current_per_thousandth_ = 1.0;
};

}  // namespace armature::cia402
