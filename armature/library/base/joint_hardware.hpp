// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/author.hpp"
#include "armature/library/base/limited_effort.hpp"

namespace armature::library {

/// The hardware of one joint, as Joint uses it (paper 1, section 3.1): to be extended by a driver.
///
/// It takes only a LimitedEffort, which is what a joint's limiter has let through: nothing else can
/// be connected to it. The functions answer false if the hardware did not take or do it, and each
/// runs in real time: nonblocking but for the wait that the hardware's answer is worth, no
/// allocation. Whenever it stops, also because the joint faulted: effort 0, brake applied, actuator
/// off.
class JointHardware : public component::Component {
 public:
  using Component::Component;

 protected:
  void on_stop() override {
    actuator_set({});
    brake_apply();
    actuator_off();
  }

  virtual bool actuator_on() = 0;
  virtual bool actuator_off() = 0;
  /// @param effort  to apply from now on [V]
  virtual bool actuator_set(control::LimitedEffort effort) = 0;
  /// Reads the sensors and writes `displacement_` and `index_`.
  virtual bool sensor_read() = 0;
  virtual bool brake_apply() = 0;
  virtual bool brake_release() = 0;

  component::OutputPort<double> displacement_{
      this, "DisplacementSensor", "of the motor's axis since the reading before", "rad"};
  component::OutputPort<bool> index_{this, "IndexSensor", "the index switch is closed"};

 private:
  void effort_arrived(control::LimitedEffort effort) { actuator_set(effort); }

  component::InputPort<control::LimitedEffort> effort_{
      this,
      "VoltageActuator",
      "to apply from now on",
      "V",
      component::on_data<&JointHardware::effort_arrived>,
      component::leads_to_nothing()};
  component::Operation<bool()> actuator_on_{this, "actuatorOn",
                                            component::serve<&JointHardware::actuator_on>,
                                            "switches the actuator on", component::in_own_thread};
  component::Operation<bool()> actuator_off_{this, "actuatorOff",
                                             component::serve<&JointHardware::actuator_off>,
                                             "switches the actuator off", component::in_own_thread};
  component::Operation<bool(control::LimitedEffort)> actuator_set_{
      this,
      "actuatorSet",
      component::serve<&JointHardware::actuator_set>,
      "applies an effort that a limiter let through",
      component::args("effort [V]"),
      component::in_own_thread};
  component::Operation<bool()> sensor_read_{
      this, "sensorRead", component::serve<&JointHardware::sensor_read>,
      "reads the sensors and writes what they measured", component::in_own_thread};
  component::Operation<bool()> brake_apply_{this, "brakeApply",
                                            component::serve<&JointHardware::brake_apply>,
                                            "applies the brake", component::in_own_thread};
  component::Operation<bool()> brake_release_{this, "brakeRelease",
                                              component::serve<&JointHardware::brake_release>,
                                              "releases the brake", component::in_own_thread};
};

}  // namespace armature::library
