// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "drives/canopen/device.hpp"
#include "drives/cia402/axis.hpp"
#include "drives/cia402/mode.hpp"
#include "drives/cia402/power.hpp"
#include "drives/cia402/scaling.hpp"

namespace armature::cia402 {

/// A drive by CiA 402 as it is seen on the bus, with its axis: dictionary, power, all modes of
/// `Mode`, and faults on demand. Its polarity is 0.
class EmulatedDrive {
 public:
  struct Config {
    canopen::NodeId node = 1;
    canopen::Identity identity{.vendor = 0x0000'0402, .product = 1, .revision = 1, .serial = 1};
    Factors factors{.encoder_increments = 4096,
                    .motor_revolutions = 1,
                    .gear_motor = 100,
                    .gear_shaft = 1,
                    .feed = 1,
                    .feed_shaft = 1,
                    .rated_torque_mNm = 500,
                    .rated_current_mA = 2000,
                    .polarity = 0};
    Axis::Config axis{};
    bool brake = true;  ///< holds the axis while the drive does not
  };
  static constexpr base::Duration kStep = std::chrono::microseconds(100);
  /// Of a motor that was never driven [°C].
  static constexpr double kAmbient = 25.0;

  /// @param config  its factors above 0
  /// @param bus     open, and lives as long
  EmulatedDrive(const Config& config, can::Bus& bus, base::Time begin);
  EmulatedDrive(const EmulatedDrive&) = delete;
  EmulatedDrive& operator=(const EmulatedDrive&) = delete;

  /// Takes what came on the bus, and moves the axis to `now`.
  void advance_to(base::Time now);

  canopen::Device& device() { return device_; }
  const canopen::Device& device() const { return device_; }
  const Axis& axis() const { return axis_; }
  PowerState power() const { return machine_.state(); }
  Mode mode() const { return mode_; }
  const Scaling& scaling() const { return scaling_; }

  /// Fails as an error of its own makes it fail: EMCY, fault reaction, fault.
  void fail(std::uint16_t code);
  /// It hears no SYNC any more.
  void set_deaf_to_sync(bool deaf) { deaf_to_sync_ = deaf; }
  /// It tells for ever how it was and what it measured when this began.
  void set_frozen(bool frozen) { frozen_ = frozen; }
  /// Its motor gets no current, and it does not notice.
  void set_powerless(bool powerless) { powerless_ = powerless; }
  /// What its motor is fed by has no voltage: it is never switched on.
  void set_without_mains(bool without) { without_mains_ = without; }
  /// Its encoder loses its place: from now on it tells a position that is `by` [rad] beyond.
  void shift_encoder(double by) { offset_ += by; }
  /// It says that it is somebody else.
  void set_identity(const canopen::Identity& identity);
  /// Loses its power for a moment: the axis runs out, the drive boots.
  void reboot(base::Time now);

 private:
  void move_to(base::Time now);
  void step(base::Time now);
  void read_commands();
  void watch(base::Time now);
  void lose_host(std::uint16_t code);
  void change_mode(Mode mode);
  double torque_in_operation();
  double torque_of_mode();
  void home();
  void find_index(double sign);
  void finish_homing(double position);
  double stop_torque();
  void write_actual();
  std::uint16_t mode_bits() const;
  void take_set_point(std::uint16_t control);
  void warm();
  void on_sync(base::Time now);
  void at_power_on();
  std::int64_t number(canopen::Address address) const {
    return device_.dictionary().number(address);
  }
  double speed(canopen::Address address) const;
  void set(canopen::Address address, std::int64_t value) {
    device_.dictionary().set_number(address, value);
  }

  const Config config_;
  const Scaling scaling_;
  can::Bus& bus_;
  canopen::Device device_;
  PowerMachine machine_;
  Axis axis_;
  AxisLoops loops_;
  base::Time now_;
  Mode mode_ = Mode::kNone;
  Demand demand_;
  double set_point_ = 0.0;     ///< [rad], of PP
  double offset_ = 0.0;        ///< [rad], what its position has beyond the axis's
  double cycle_target_ = 0.0;  ///< [rad], of CSP, to be reached at the next SYNC
  base::Duration sync_period_{};
  base::Time last_sync_{};
  std::uint16_t control_ = 0;
  bool acknowledged_ = false;
  bool homing_ = false;
  bool homed_ = false;
  bool homing_failed_ = false;
  bool found_mark_ = false;     ///< the switch, and goes back to an index
  std::optional<double> turn_;  ///< of the motor, at the step before
  bool stopping_ = false;       ///< a quick stop or fault reaction brakes
  base::Time stopping_since_{};
  bool deaf_to_sync_ = false;
  bool frozen_ = false;
  bool powerless_ = false;
  bool without_mains_ = false;
  double temperature_ = kAmbient;  ///< [°C], of the motor
};

}  // namespace armature::cia402
