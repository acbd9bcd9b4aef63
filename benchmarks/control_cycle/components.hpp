// SPDX-License-Identifier: Apache-2.0
#pragma once

// The sampled-control cycle as components. `Sample` has every joint read its card; the multiplexer
// gathers what they measured, the controller has one PID for each joint, the demultiplexer hands
// the voltages out and raises `Act`, and every joint drives its card.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "benchmarks/control_cycle/motor.hpp"

namespace armature::benchmarks {

using namespace armature::component;

/// Starts a cycle in each of its periods.
class Sampler final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override { trigger(); }
  void trigger() {
    sample_port_.write(++samples_);
    sample_.raise();
  }

  OutputPort<std::uint64_t> sample_port_{this, "SamplePort", "number of the sample"};
  Event<> sample_{this, "Sample", "a sampling period begins"};
  Operation<void()> trigger_{this, "trigger", serve<&Sampler::trigger>, "begins a cycle now"};

  std::uint64_t samples_ = 0;
};

/// The hardware of a joint: a simulated motor.
class Card final : public Component {
 public:
  using Component::Component;
  const SimulatedMotor& motor() const { return motor_; }

 private:
  void sensor_read() {
    displacement_.write(motor_.read());
    index_.write(motor_.index());
  }
  void actuator_set(double voltage) { motor_.drive(voltage); }

  OutputPort<double> displacement_{this, "DisplacementSensor", "since the last sample", "rad"};
  OutputPort<bool> index_{this, "IndexSensor", "the index mark passed by"};
  InputPort<double> voltage_{
      this, "VoltageActuator", "to apply", "V", on_data<&Card::actuator_set>, leads_to_nothing()};
  Operation<void()> sensor_read_{this, "sensorRead", serve<&Card::sensor_read>,
                                 "reads the sensors and writes what they measured"};
  Operation<void(double)> actuator_set_{this, "actuatorSet", serve<&Card::actuator_set>,
                                        "applies a voltage", args("voltage [V]")};

  SimulatedMotor motor_;
};

/// One joint, independent of its hardware: signs, ratio and offset are here.
class Joint final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override {
    sensor_ratio_ = sensor_sign_ * gear_ratio_;
    joint_position_ = initial_position_;
    return accepted();
  }

  void on_sample() { read_card_(); }
  void on_displacement(double of_motor) {
    const double displacement = sensor_ratio_ * of_motor;
    joint_position_ += displacement;
    displacement_.write(displacement);
    position_.write(joint_position_);
  }
  void on_index(bool passed) { index_.write(passed); }
  void on_act() {
    if (const auto voltage = voltage_.read()) {
      voltage_actuator_.write(actuator_sign_ * voltage.value);
    }
  }

  Property<std::string> peer_name_{this, "PeerName", "", "the card", "", mandatory};
  Property<double> actuator_sign_{this, "ActuatorSign", 1.0, "a positive voltage moves forward"};
  Property<double> sensor_sign_{this, "SensorSign", 1.0, "a forward motion is positive"};
  Property<double> gear_ratio_{this, "GearRatio", 1.0, "joint motion per sensor motion"};
  Property<double> initial_position_{this, "InitialPos", 0.0, "at start", "rad"};

  EventHandler<> sample_handler_{this, "Sample", serve<&Joint::on_sample>, "reads the sensor",
                                 leads_to("Displacement", "Position", "Index")};
  EventHandler<> act_handler_{this, "Act", serve<&Joint::on_act>, "applies Voltage",
                              leads_to("VoltageActuator")};
  OperationCaller<void()> read_card_{this, "sensorRead", "has the card measure", from(peer_name_)};
  InputPort<double> displacement_sensor_{this,
                                         "DisplacementSensor",
                                         "of the motor's axis",
                                         "rad",
                                         on_data<&Joint::on_displacement>,
                                         leads_to("Displacement", "Position")};
  InputPort<bool> index_sensor_{this,
                                "IndexSensor",
                                "the index mark passed by",
                                "",
                                on_data<&Joint::on_index>,
                                leads_to("Index")};
  InputPort<double> voltage_{this, "Voltage", "to apply at Act", "V"};
  OutputPort<double> voltage_actuator_{this, "VoltageActuator", "for the card", "V"};
  OutputPort<double> displacement_{this, "Displacement", "since the last sample", "rad"};
  OutputPort<double> position_{this, "Position", "of the joint", "rad"};
  OutputPort<bool> index_{this, "Index", "the index mark passed by"};

  double sensor_ratio_ = 1.0;
  double joint_position_ = 0.0;
};

/// Gathers values that arrive one by one and says when all are there.
class Gathering {
 public:
  void resize(std::size_t count) {
    values_.assign(count, 0.0);
    arrived_in_.assign(count, 0);
    missing_ = 0;
  }
  /// False if the round before was not complete.
  bool begin() {
    ++round_;
    const bool complete = missing_ == 0;
    missing_ = values_.size();
    return complete;
  }
  /// True if this was the last value of the round.
  bool add(std::size_t index, double value) {
    values_[index] = value;
    if (arrived_in_[index] == round_) return false;
    arrived_in_[index] = round_;
    return --missing_ == 0;
  }
  const std::vector<double>& values() const { return values_; }

 private:
  std::vector<double> values_;
  std::vector<std::uint32_t> arrived_in_;
  std::uint32_t round_ = 0;
  std::size_t missing_ = 0;
};

/// Makes one vector of what the joints measured: [q1..qN, d1..dN].
class SensorNMux final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_configure() override {
    measured_.resize(2 * position_.size());
    return accepted();
  }
  void sample_now() {
    if (!measured_.begin()) incomplete_.assign(incomplete_() + 1);
  }
  void on_position(std::size_t joint, double position) { store(joint, position); }
  void on_displacement(std::size_t joint, double displacement) {
    store(position_.size() + joint, displacement);
  }
  void store(std::size_t index, double value) {
    if (measured_.add(index, value)) sensor_.write(measured_.values());
  }

  Property<int> joints_{this, "joints", 2, "how many", "", range(1, 100000)};
  EventHandler<> sample_handler_{this, "Sample", serve<&SensorNMux::sample_now>,
                                 "waits for all joints", leads_to_nothing()};
  InputPorts<double> position_{
      this, "Position", joints_, "of each joint", "rad", on_data<&SensorNMux::on_position>};
  InputPorts<double> displacement_{this,    "Displacement",
                                   joints_, "of each joint since the last sample",
                                   "rad",   on_data<&SensorNMux::on_displacement>};
  OutputPort<std::vector<double>> sensor_{this, "sensor", "positions, then displacements", "rad",
                                          size_of(joints_, 2)};
  Attribute<int> incomplete_{this, "incomplete", 0, "cycles in which a value was missing"};

  Gathering measured_;
};

/// Says where the joints are to be: [q, qd, qdd] of all.
class Reference final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override {
    std::vector<double> wanted(3 * static_cast<std::size_t>(joints_()), 0.0);
    for (int i = 0; i < joints_; ++i) wanted[static_cast<std::size_t>(i)] = reference_of(i);
    reference_.write(wanted);
    return accepted();
  }
  Property<int> joints_{this, "joints", 2, "how many", "", range(1, 100000)};
  OutputPort<std::vector<double>> reference_{this, "reference", "for the controller", "rad",
                                             size_of(joints_, 3)};
};

/// An independent PID for each joint.
class ControllerNPid final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_configure() override {
    control_.resize(out_.size());
    return accepted();
  }
  void controller_now(const std::vector<double>& measured) {
    const auto wanted = reference_.read();
    if (!wanted) return;
    if (!control_.begin()) incomplete_.assign(incomplete_() + 1);
    for (std::size_t i = 0; i < out_.size(); ++i) {
      ref_[i].write(wanted.value[i]);
      sen_[i].write(measured[i]);
    }
  }
  void on_out(std::size_t joint, double control) {
    if (control_.add(joint, control)) act_.write(control_.values());
  }

  Property<int> joints_{this, "joints", 2, "how many", "", range(1, 100000)};
  InputPort<std::vector<double>> reference_{this, "reference", "desired position", "rad",
                                            size_of(joints_, 3)};
  InputPort<std::vector<double>> sensor_{this,
                                         "sensor",
                                         "measured",
                                         "rad",
                                         on_data<&ControllerNPid::controller_now>,
                                         size_of(joints_, 2),
                                         leads_to("Ref", "Sen")};
  InputPorts<double> out_{
      this, "Out", joints_, "of each PID", "V", on_data<&ControllerNPid::on_out>, leads_to("act")};
  OutputPorts<double> ref_{this, "Ref", joints_, "for each PID", "rad"};
  OutputPorts<double> sen_{this, "Sen", joints_, "for each PID", "rad"};
  OutputPort<std::vector<double>> act_{this, "act", "control signal of each joint", "V",
                                       size_of(joints_)};

  Attribute<int> incomplete_{this, "incomplete", 0, "cycles in which a value was missing"};

  Gathering control_;
};

/// One-joint PID with output saturation, velocity form (paper 1, equation 6).
class Pid final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override {
    control_ = 0.0;
    first_ = true;
    return accepted();
  }
  void step(double measured) {
    const double error = reference_.read().value - measured;
    if (first_) last_ = before_last_ = error;
    first_ = false;
    control_ += kp_ * (error - last_) + ki_ * error + kd_ * (error - 2.0 * last_ + before_last_);
    control_ = std::clamp(control_, u_min_(), u_max_());
    before_last_ = last_;
    last_ = error;
    output_.write(control_);
  }

  Property<double> kp_{this, "Kp", kKp, "proportional gain", "V/rad"};
  Property<double> ki_{this, "Ki", kKi, "integral gain", "V/rad"};
  Property<double> kd_{this, "Kd", kKd, "differential gain", "V/rad"};
  Property<double> u_min_{this, "UMin", -kMaxVoltage, "lower limit of the output", "V"};
  Property<double> u_max_{this, "UMax", kMaxVoltage, "upper limit of the output", "V"};
  InputPort<double> reference_{this, "Ref", "desired position", "rad"};
  InputPort<double> measured_{this, "Sen", "measured position", "rad", on_data<&Pid::step>};
  OutputPort<double> output_{this, "Out", "control signal", "V"};

  double control_ = 0.0;
  double last_ = 0.0;
  double before_last_ = 0.0;
  bool first_ = true;
};

/// Hands out the control signals; all joints apply theirs at `Act`.
class ActuatorNDemux final : public Component {
 public:
  using Component::Component;

 private:
  void sample_now() { sampled_ = true; }
  void actuate(const std::vector<double>& control) {
    for (std::size_t i = 0; i < control.size(); ++i) voltage_[i].write(control[i]);
    if (std::exchange(sampled_, false)) act_.raise();
  }

  Property<int> joints_{this, "joints", 2, "how many", "", range(1, 100000)};
  EventHandler<> sample_handler_{this, "Sample", serve<&ActuatorNDemux::sample_now>,
                                 "one Act for each Sample", leads_to_nothing()};
  InputPort<std::vector<double>> control_{this,
                                          "act",
                                          "control signal of each joint",
                                          "V",
                                          on_data<&ActuatorNDemux::actuate>,
                                          size_of(joints_)};
  OutputPorts<double> voltage_{this, "Voltage", joints_, "for each joint", "V"};
  Event<> act_{this, "Act", "all joints apply their voltages"};

  bool sampled_ = false;
};

}  // namespace armature::benchmarks
