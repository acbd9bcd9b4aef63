// SPDX-License-Identifier: Apache-2.0
#pragma once

// What stands around the sampled-control cycle of the library's components: the hardware of the
// joints, and what tells the cycle where they are to be.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/base/joint_hardware.hpp"
#include "benchmarks/control_cycle/motor.hpp"

namespace armature::benchmarks {

/// The hardware of a joint: a simulated motor.
class Card final : public controllers::JointHardware {
 public:
  using JointHardware::JointHardware;
  const SimulatedMotor& motor() const { return motor_; }
  /// Cycles since it was driven first.
  std::int64_t driven() const { return driven_; }

 private:
  bool sensor_read() override {
    sensor_.write(motor_.read());
    index_.write(motor_.index());
    return true;
  }
  bool actuator_set(control::LimitedEffort effort) override {
    motor_.drive(effort);
    if (driven_ > 0 || effort != 0.0) ++driven_;
    return true;
  }
  bool actuator_on() override {
    driven_ = 0;
    return true;
  }
  bool actuator_off() override { return true; }
  bool brake_apply() override { return true; }
  bool brake_release() override { return true; }

  SimulatedMotor motor_;
  std::int64_t driven_ = 0;
};

/// Says where the joints are to be, [q, qd, qdd] of all: where they are until they are armed and
/// stand, then at one place. In the stead of a generator and of what is between it and the
/// controller.
class Reference final : public component::Component {
 public:
  using Component::Component;

 private:
  using Vector = std::vector<double>;

  component::Outcome on_configure() override {
    measured_positions_.assign(joints(), 0.0);
    desired_positions_.assign(joints(), 0.0);
    at_rest_.assign(joints(), 0.0);
    composed_.assign(3 * joints(), 0.0);
    return component::accepted();
  }
  void on_update() override {
    if (const auto measured = sensor_.read()) {
      for (std::size_t i = 0; i < joints(); ++i) measured_positions_[i] = measured.value[i];
      sensor_position_.write(measured_positions_);
    }
    write();
  }
  void settle() { desired_positions_ = measured_positions_; }
  /// Once: what it desires then rests, too.
  void begin() {
    for (std::size_t i = 0; i < joints(); ++i) {
      desired_positions_[i] = reference_of(static_cast<int>(i));
    }
    write();
  }
  void write() {
    for (std::size_t i = 0; i < joints(); ++i) composed_[i] = desired_positions_[i];
    reference_.write(composed_);
    position_.write(desired_positions_);
    velocity_.write(at_rest_);
  }
  std::size_t joints() const { return static_cast<std::size_t>(joints_.get()); }

  component::Property<int> joints_{this, "joints", 2, "how many", "", component::range(1, 100000)};
  component::InputPort<Vector> sensor_{this, "sensor", "positions, then displacements", "rad",
                                       component::size_of(joints_, 2)};
  component::OutputPort<Vector> sensor_position_{this, "nAxesSensorPosition", "measured", "rad",
                                                 component::size_of(joints_)};
  component::OutputPort<Vector> position_{this, "nAxesDesiredPosition", "desired", "rad",
                                          component::size_of(joints_)};
  component::OutputPort<Vector> velocity_{this, "nAxesDesiredVelocity", "desired", "rad/s",
                                          component::size_of(joints_)};
  component::OutputPort<Vector> reference_{this, "reference", "for the controller", "",
                                           component::size_of(joints_, 3)};
  component::EventHandler<> settle_{this, "Settle", component::serve<&Reference::settle>,
                                    "desired := measured", component::leads_to_nothing()};
  component::EventHandler<> rest_{this, "Rest", component::serve<&Reference::begin>,
                                  "desired := the place to go to"};

  Vector measured_positions_;
  Vector desired_positions_;
  Vector at_rest_;
  Vector composed_;
};

}  // namespace armature::benchmarks
