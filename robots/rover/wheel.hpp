// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/controllers/base/joint_hardware.hpp"
#include "robots/rover/wheel_sample.hpp"

namespace armature::rover {

/// The model `RoverWheel`: the hardware of a joint that turns without end, with motor, encoder and
/// drive. Its peer has the drives: SimulatedRover, or a driver with the same four operations.
/// DisplacementSensor is of the motor's axis, so its Joint has the gear, and needs `Continuous`. It
/// has no brake: the motor brakes itself while the drive is off.
///
/// It faults, and so stops its joint, when the drive stopped by itself, as it does 100 ms after the
/// last effort.
/// @rt nonblocking, no allocation
class Wheel final : public controllers::JointHardware {
 public:
  using JointHardware::JointHardware;

 private:
  component::Outcome on_start() override;

  bool actuator_on() override;
  bool actuator_off() override;
  bool actuator_set(control::LimitedEffort effort) override;
  bool sensor_read() override;
  bool brake_apply() override { return true; }
  bool brake_release() override { return true; }

  component::Property<int> number_{
      this,
      "Number",
      1,
      "of the wheel: odd ones are on the left, the front ones come first",
      "",
      component::mandatory,
      component::range(1, 4)};
  component::Property<double> counts_per_turn_{
      this, "CountsPerTurn", 2000.0, "of the motor", "", component::range(1.0, 1e9)};
  component::OperationCaller<WheelSample(int)> read_{this, "readWheel", "has the drive say"};
  component::OperationCaller<bool(int, control::LimitedEffort)> set_{this, "setWheel",
                                                                     "drives the motor"};
  component::OperationCaller<bool(int, control::DrivePermit)> switch_on_{this, "wheelOn",
                                                                         "switches the drive on"};
  component::OperationCaller<bool(int)> switch_off_{this, "wheelOff", "switches the drive off"};

  bool on_ = false;  ///< switched on, as far as this side knows
};

}  // namespace armature::rover
