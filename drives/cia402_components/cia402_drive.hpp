// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/controllers/base/joint_hardware.hpp"
#include "drives/cia402_components/cia402_host.hpp"

namespace armature::cia402 {

/// How one drive is commanded: as its bus says, or otherwise.
enum class DriveMode : std::uint8_t { kBus, kTorque, kVelocity, kPosition };
ARMATURE_ENUM(DriveMode, kBus, kTorque, kVelocity, kPosition);

/// What a drive's encoder tells when the drive gets power.
enum class DriveEncoder : std::uint8_t {
  kAbsolute,  ///< where it is
  kCounting,  ///< anything: it counts from there
};
ARMATURE_ENUM(DriveEncoder, kAbsolute, kCounting);

/// One drive by CiA 402: the hardware of a joint. Its peer is the host of the bus that the drive is
/// on. Its mode, its own or that of the bus, has to be that of the input which is connected.
///
/// PositionSensor is of the driving shaft, behind the drive's own gear and feed; so the joint's
/// GearRatio is 1 unless there is another gear behind. Switched on, the drive is powered and its
/// brake closed; `brakeRelease` has it follow its targets, and open its brake by itself. Of a joint
/// without Brake both happen at once. Disarmed, it stops quickly, by its own deceleration.
///
/// It faults, and so stops its joint, when the bus is gone, when the drive failed, rebooted, went
/// silent or lost its heartbeat, when it switched off by itself or does not switch on, and when its
/// torque is not what it was told. A drive
/// that failed is reset by the operator alone, by `resetDrive` of the host, which also prepares one
/// that rebooted; where that one is, the operator confirms (`position_confirmed`).
///
/// With `homing_method` it can home by itself, in mode HM, when its joint is told to.
/// @rt nonblocking, no allocation
class Cia402Drive final : public controllers::JointHardware {
 public:
  explicit Cia402Drive(const std::string& name)
      : JointHardware(name,
                      {controllers::JointCommand::kTorque, controllers::JointCommand::kVelocity,
                       controllers::JointCommand::kPosition},
                      Sensor::kAbsolute) {}

  /// @thread configuration only, as for the next ones
  int node() const { return node_; }
  /// Whether that host serves it.
  bool is_on(const Cia402Host& host, const component::Check& check) const;
  /// Puts what it says of itself in place of what the bus says of all.
  void refine(DrivePlan& plan) const;
  bool tells_of_shaft() const override { return true; }
  Sensor sensor() const override {
    return encoder_ == DriveEncoder::kCounting ? Sensor::kCounting : Sensor::kAbsolute;
  }

 private:
  void on_check(component::Check& check) const override;
  component::Outcome on_start() override;

  bool actuator_on() override;
  bool actuator_off() override;
  bool actuator_set(control::LimitedEffort effort) override;
  bool velocity_set(control::LimitedVelocity velocity) override;
  bool position_set(control::LimitedPosition position) override;
  bool sensor_read() override;
  bool brake_apply() override;
  bool brake_release() override;
  bool home(control::DrivePermit permit);
  int homing() const { return homing_; }
  bool is_homed() { return homed_; }
  bool is_as_told() const override { return wanted_ == Wanted::kOff || was_enabled_; }

  CyclicMode mode_on(const Cia402Host& host) const;
  bool energize(bool enable);
  bool make_safe(bool quick_stop);
  bool usable(const DriveSample& sample);
  bool does_what_it_was_told(const DriveSample& sample);
  void show(const DriveSample& sample);
  void check_homing(const Cia402Host& host, component::Check& check) const;

  /// What it was told last, and since when.
  enum class Wanted { kOff, kSwitchedOn, kEnabled, kHome };
  void want(Wanted wanted);

  component::Property<int> node_{
      this, "node", 1, "of the drive", "", component::mandatory, component::range(1, 127)};
  component::Property<bool> brake_{this, "Brake", false,
                                   "the drive has a brake, which it opens when it is enabled"};
  component::Property<DriveMode> mode_{
      this, "mode", DriveMode::kBus,
      "torque (CST), velocity (CSV), position (CSP), or as its bus says of all drives"};
  component::Property<DriveEncoder> encoder_{
      this, "encoder", DriveEncoder::kAbsolute,
      "absolute, or counting: its position begins anywhere when it gets power"};
  component::Property<int> vendor_{this, "vendor", 0,
                                   "that the drive says it is of (0x1018:01); 0: as its bus says"};
  component::Property<int> product_{this, "product", 0, "likewise (0x1018:02)"};
  component::Property<std::string> eds_{
      this, "eds", "", "the file in which its maker describes it; empty: as its bus says"};
  component::Property<std::string> temperature_object_{
      this, "temperature", "", "the object that has it, such as 0x2110:01; empty: none"};
  component::Property<double> temperature_scale_{this, "temperature_scale", 1.0,
                                                 "what one in that object is", "K"};
  component::Property<double> temperature_offset_{
      this, "temperature_offset", 273.15, "what 0 in that object is; as it is for degrees Celsius",
      "K"};
  component::Property<int> homing_method_{
      this, "homing_method",
      0,    "by which it homes by itself, as 0x6098 has it; below 0: its maker's; 0: it does not",
      "",   component::range(-128, 37)};
  component::Property<double> homing_speed_{
      this,    "homing_speed",
      0.1,     "of its shaft, until it finds the mark (0x6099:01)",
      "rad/s", component::range(1e-6, 1e3)};
  component::Property<double> homing_slow_speed_{
      this,    "homing_slow_speed",        0.02, "until it finds the mark's edge (0x6099:02)",
      "rad/s", component::range(1e-6, 1e3)};
  component::Property<double> homing_acceleration_{
      this,      "homing_acceleration",      1.0, "with which it begins and ends (0x609A)",
      "rad/s^2", component::range(1e-6, 1e4)};
  component::Property<double> home_offset_{this,  "home_offset",
                                           0.0,   "that it says where it finds home (0x607C)",
                                           "rad", component::range(-1e6, 1e6)};
  component::OperationCaller<DriveSample(int)> read_drive_{this, "readDrive", "has the drive read"};
  component::OperationCaller<bool(int, control::LimitedEffort)> set_effort_{this, "setEffort",
                                                                            "sets its torque"};
  component::OperationCaller<bool(int, control::LimitedVelocity)> set_velocity_{
      this, "setVelocity", "sets its velocity"};
  component::OperationCaller<bool(int, control::LimitedPosition)> set_position_{
      this, "setPosition", "sets where it is to be"};
  component::OperationCaller<bool(int, bool, control::DrivePermit)> energize_drive_{
      this, "energizeDrive", "switches it on, has it follow"};
  component::OperationCaller<bool(int, control::DrivePermit)> home_drive_{this, "homeDrive",
                                                                          "has it home"};
  component::Operation<bool(control::DrivePermit)> home_{
      this,
      "homeByItself",
      component::serve<&Cia402Drive::home>,
      "switches on and homes, until the brake is applied; false without homing_method",
      component::args("permit"),
      component::in_own_thread};
  component::Operation<int()> homing_stage_{
      this, "homingStage", component::serve<&Cia402Drive::homing>,
      "0 it does not home, 1 under way, 2 it is at home, 3 it failed, 4 it is told to stop",
      component::in_own_thread};
  component::Operation<bool()> is_homed_{
      this, "isHomed", component::serve<&Cia402Drive::is_homed>,
      "it has homed since it had power, and lost no position since then", component::in_own_thread};
  component::OperationCaller<bool(int, bool)> make_drive_safe_{this, "makeDriveSafe",
                                                               "stops it, switches it off"};
  component::OutputPort<double> velocity_{this, "Velocity", "of the driving shaft", "rad/s"};
  component::OutputPort<double> effort_{this, "Effort", "that the drive gives, at its shaft", "Nm"};
  component::OutputPort<double> current_{this, "Current", "of the motor, asked now and then", "A"};
  component::OutputPort<double> temperature_{
      this, "Temperature", "of the property temperature, asked now and then", "K"};
  component::OutputPort<DriveStatus> status_{this, "Status", "its status word, bit by bit"};
  component::Attribute<int> power_{this, "power", -1,
                                   "state of CiA 402: 0 not ready, 1 switch-on disabled, 2 ready, "
                                   "3 switched on, 4 enabled, 5 quick stop, 6 fault reaction, 7 "
                                   "fault; -1: unknown"};
  component::Attribute<int> error_code_{this, "error_code", 0,
                                        "that the drive told last; 0: no error"};
  component::Attribute<bool> warns_{this, "warns", false, "the drive tells a warning"};
  component::Attribute<bool> limited_{this, "limited", false, "an internal limit is active"};
  int homing_ = 0;      ///< HomingStage
  bool homed_ = false;  ///< not an attribute, which tools may set
  Wanted wanted_ = Wanted::kOff;
  base::Time wanted_since_{};
  bool was_enabled_ = false;  ///< since that was wanted
};

}  // namespace armature::cia402
