// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "armature/control/joint_limiter.hpp"

namespace armature::benchmarks {

/// A motor with an encoder, as a card sees them; advances by one sampling period whenever its
/// sensor is read.
class SimulatedMotor {
 public:
  /// The displacement of the axis since the last read [rad].
  double read() {
    speed_ += kResponse * (kSpeedPerVolt * voltage_ - speed_);
    const double displacement = kPeriod * speed_;
    angle_ += displacement;
    index_ = angle_ >= kTurn;
    if (index_) angle_ -= kTurn;
    return displacement;
  }
  /// The encoder's index mark passed by in the last period.
  bool index() const { return index_; }
  void drive(double voltage) { voltage_ = voltage; }
  double voltage() const { return voltage_; }
  friend bool operator==(const SimulatedMotor&, const SimulatedMotor&) = default;

 private:
  static constexpr double kPeriod = 0.001;       // s
  static constexpr double kSpeedPerVolt = 20.0;  // rad/s/V
  static constexpr double kResponse = 0.1;       // of the speed, in one period
  static constexpr double kTurn = 6.283185307179586;

  double speed_ = 0.0;
  double angle_ = 0.0;
  double voltage_ = 0.0;
  bool index_ = false;
};

/// What both programs control with; joint `i` counts from 0.
inline double gear_ratio_of(int i) { return i % 2 == 0 ? 0.01 : 0.02; }
inline double reference_of(int i) { return 1.0 + 0.001 * i; }
inline constexpr double kKp = 20.0;
inline constexpr double kKi = 0.02;
inline constexpr double kKd = 4.0;
inline constexpr double kMaxVoltage = 12.0;

/// Of all joints, so wide that nothing is clipped: both would do the same, but flat out in threads
/// a measured velocity is a matter of the machine.
inline control::JointLimiter::Config limits_of_joints() {
  return {.lower = -100.0,
          .upper = 100.0,
          .max_velocity = 1e6,
          .max_acceleration = 1e12,
          .max_effort = kMaxVoltage,
          .period = std::chrono::milliseconds(1)};
}

}  // namespace armature::benchmarks
