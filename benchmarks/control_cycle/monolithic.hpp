// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "benchmarks/control_cycle/motor.hpp"

namespace armature::benchmarks {

/// What a controller without a framework knows of its hardware.
class HardwareCard {
 public:
  virtual ~HardwareCard() = default;
  /// The displacement of the motor's axis since the last read [rad].
  virtual double read(bool& index) = 0;
  virtual void drive(double voltage) = 0;
};

/// Cards with simulated motors; behind a function, so that a controller's calls stay virtual.
class SimulatedCard;
std::vector<std::unique_ptr<HardwareCard>> make_simulated_cards(int count);
const SimulatedMotor& motor_of(const HardwareCard& card);

/// The same cycle as `make_cycle`, as a hand-written controller: all joints are sampled, then the
/// control signals are computed, then all joints are actuated, each behind its limiter. It begins
/// with the step of the reference: until then the joints were held at 0, so past errors are 0.
class MonolithicController {
 public:
  explicit MonolithicController(int joints);
  void cycle();
  std::int64_t cycles() const { return cycles_; }
  const SimulatedMotor& motor(int joint) const;

 private:
  struct Joint {
    double ratio;
    double position = 0.0;
    bool index = false;
    control::JointLimiter limiter;
  };
  struct Pid {
    double kp = kKp;
    double ki = kKi;
    double kd = kKd;
    double u_min = -kMaxVoltage;
    double u_max = kMaxVoltage;
    double control = 0.0;
    double last_error = 0.0;
    double error_before_last = 0.0;
  };
  void sample();
  void control();
  void actuate();

  std::vector<std::unique_ptr<HardwareCard>> cards_;
  std::vector<Joint> joints_;
  std::vector<Pid> pids_;
  std::vector<double> reference_;  ///< desired positions
  std::vector<double> sensor_;     ///< positions, then displacements
  std::vector<double> act_;        ///< control signals
  std::int64_t cycles_ = 0;
};

}  // namespace armature::benchmarks
