// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "armature/base/time.hpp"

namespace armature::cia402 {

class EmulatedArm;

/// A motor and what it moves, at the driving shaft: J a = torque - viscous v - friction sign(v), or
/// a joint of an arm.
class Axis {
 public:
  struct Config {
    double inertia = 0.1;        ///< [kg m2], above 0
    double viscous = 0.1;        ///< [N m s/rad]
    double friction = 0.2;       ///< [N m], of Coulomb
    double most_torque = 50;     ///< [N m], that the drive can give
    double low = -3.0;           ///< [rad], where the negative limit switch is
    double high = 3.0;           ///< [rad], where the positive limit switch is
    EmulatedArm* arm = nullptr;  ///< whose joint it moves, with friction of the arm's own
    std::size_t joint = 0;       ///< of the arm
  };

  Axis() = default;
  explicit Axis(const Config& config) : config_(config) {}

  /// The joint of an arm goes on when the arm is stepped.
  /// @param torque_Nm  of the drive, limited to what it can give
  void step(double torque_Nm, base::Duration by);
  /// Holds the axis at once, as a closed brake does.
  void hold();

  const Config& config() const { return config_; }
  double position() const;                   ///< [rad]
  double velocity() const;                   ///< [rad/s]
  double torque() const { return torque_; }  ///< [N m], that was given last
  bool at_low_switch() const { return position() <= config_.low; }
  bool at_high_switch() const { return position() >= config_.high; }

 private:
  Config config_{};
  double position_ = 0.0;
  double velocity_ = 0.0;
  double torque_ = 0.0;
};

/// Where an axis is wanted.
struct Demand {
  double position = 0.0;  ///< [rad]
  double velocity = 0.0;  ///< [rad/s]
};

/// Moves a demand to a target with a trapezoid of velocities, from any state of motion.
struct Profile {
  double velocity = 1.0;      ///< [rad/s], above 0
  double acceleration = 5.0;  ///< [rad/s2], above 0

  /// Toward a position, to stand there.
  void step_to_position(Demand& demand, double target, base::Duration by) const;
  /// Toward a velocity.
  void step_to_velocity(Demand& demand, double target, base::Duration by) const;
};

/// The torque that follows a demand: P of position around PI of velocity.
class AxisLoops {
 public:
  struct Config {
    double position_gain = 60.0;    ///< [1/s]
    double velocity_gain = 400.0;   ///< [1/s], times the inertia
    double integral_gain = 4000.0;  ///< [1/s2], times the inertia
  };

  AxisLoops() = default;
  explicit AxisLoops(const Config& config) : config_(config) {}

  void reset() { integral_ = 0.0; }
  double follow_position(const Demand& demand, const Axis& axis, base::Duration by);
  double follow_velocity(double velocity, const Axis& axis, base::Duration by);

 private:
  Config config_{};
  double integral_ = 0.0;  ///< [N m]
};

}  // namespace armature::cia402
