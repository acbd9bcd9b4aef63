// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::control {

/// How the motors of a robot turn with its joints, and what their rotors add to its dynamics. A
/// gear for each joint is a diagonal matrix; in a differential, two motors drive two joints
/// together.
///
///     motor angles = turns joint angles
///     joint torques = turns' motor torques
///     rotor inertia at the joints = turns' diag(rotor_inertia) turns, and so their friction
///
/// Rotors count as turning about axes that stand still: what a turning link does to them is small
/// where motors turn many times for one turn of a joint.
class Transmission {
 public:
  /// How the motors drive the joints.
  struct Config {
    /// Turns of each motor for one of each joint: a row for each motor; or the diagonal alone.
    std::vector<double> turns;
    /// [kg m^2] at the motor's shaft, one for each motor; >= 0
    std::vector<double> rotor_inertia;
    /// [N m s/rad] at the motor's shaft, one for each motor, >= 0; empty: none
    std::vector<double> viscous_friction{};
  };

  /// An error says how many numbers were expected, or that the motors do not determine the joints.
  static base::Result<Transmission> make(const Config& config);

  std::size_t joints() const { return joints_; }

  /// All vectors below have one number for each joint or motor, and are not the same.
  /// @param joints  [rad], or their rates
  /// @rt nonblocking, no allocation, O(joints^2)
  void motor_angles(std::span<const double> joints, std::span<double> motors) const;
  /// @rt nonblocking, no allocation, O(joints^2)
  void joint_angles(std::span<const double> motors, std::span<double> joints) const;
  /// @param joints  [N m]
  /// @rt nonblocking, no allocation, O(joints^2)
  void motor_torques(std::span<const double> joints, std::span<double> motors) const;
  /// @rt nonblocking, no allocation, O(joints^2)
  void joint_torques(std::span<const double> motors, std::span<double> joints) const;

  /// Adds what moves the rotors against inertia and friction to `torques` [N m] at the joints.
  /// @param velocities     of the joints [rad/s]
  /// @param accelerations  of the joints [rad/s^2]
  /// @rt nonblocking, no allocation, O(joints^2)
  void add_rotor_torques(std::span<const double> velocities, std::span<const double> accelerations,
                         std::span<double> torques) const;
  /// Of the rotors, between two joints [kg m^2].
  double rotor_inertia(std::size_t row, std::size_t column) const {
    return rotors_[row * joints_ + column];
  }

 private:
  explicit Transmission(std::size_t joints) : joints_(joints) {}

  std::size_t joints_;
  std::vector<double> turns_;    ///< like the two below: row by row
  std::vector<double> inverse_;  ///< of turns
  std::vector<double> rotors_;   ///< their inertia at the joints
  std::vector<double> friction_;
};

}  // namespace armature::control
