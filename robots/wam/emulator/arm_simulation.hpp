// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/control/transmission.hpp"
#include "armature/sim/plant.hpp"
#include "robots/wam/arm_numbers.hpp"

namespace armature::wam {

/// The simulated arm behind its motors: torques in, angles out. Links and joint stops are those of
/// the description; rotors, differentials and the brakes of the motors are those of the numbers.
///
/// Time passes in `advance` alone, so two equal runs are equal to the bit. One thread uses it.
class ArmSimulation {
 public:
  struct Config {
    std::string urdf_file{};  ///< robots/wam/wam7.urdf or wam4.urdf
    base::Duration inner_step = std::chrono::microseconds(100);
    std::vector<double> start{};  ///< [rad] of the joints, at rest; empty: home
    bool motor_friction = true;   ///< the viscous one of the motors, by their data sheets
    /// [N m] at the joints, one for each, which holds at rest; empty: none. Nobody published it.
    std::vector<double> coulomb_friction{};
  };

  /// An error names the file, or the number of joints that was expected.
  static base::Result<ArmSimulation> load(const ArmNumbers& arm, const Config& config);
  /// @param urdf  the text of the description, instead of the file
  static base::Result<ArmSimulation> parse(const ArmNumbers& arm, const std::string& urdf,
                                           const Config& config);

  std::size_t motors() const { return motors_.size(); }

  /// Lets time pass, in inner steps; what is left of one is made up for next time.
  /// @param duration  >= 0
  /// @rt nonblocking, no allocation
  sim::PlantStatus advance(base::Duration duration);

  /// Drives a motor from now on, its brake released. At the beginning all are braked.
  /// @param torque  [N m] at the shaft
  /// @rt nonblocking, no allocation
  void set_torque(std::size_t motor, double torque);
  /// Shorts the winding of a motor, as a puck in the mode IDLE does: it brakes with its rate.
  /// @rt nonblocking, no allocation
  void brake(std::size_t motor);

  /// Of a motor, 0 where all joints are at 0 [rad].
  /// @rt nonblocking, no allocation
  double angle(std::size_t motor) const { return motor_angles_[motor]; }
  /// [rad/s]
  /// @rt nonblocking, no allocation
  double rate(std::size_t motor) const { return motor_rates_[motor]; }

  /// Where a joint really is, for tests and pictures [rad].
  double joint_position(std::size_t joint) const { return plant_.position(joint); }
  double joint_velocity(std::size_t joint) const { return plant_.velocity(joint); }
  /// Puts the arm somewhere.
  /// @param positions   of the joints [rad]
  /// @param velocities  [rad/s]
  void set_state(std::span<const double> positions, std::span<const double> velocities);

  /// kDiverged: the arm stands still since then.
  sim::PlantStatus status() const { return plant_.status(); }

 private:
  struct Motor {
    double friction = 0.0;  ///< [N m s/rad]
    double braking = 0.0;   ///< [N m s/rad] of a shorted winding
    double torque = 0.0;
    bool braked = true;
  };

  ArmSimulation(const ArmNumbers& arm, const Config& config, control::Transmission transmission,
                sim::Plant plant);
  void inner();
  void look();

  control::Transmission transmission_;
  sim::Plant plant_;
  std::vector<Motor> motors_;
  base::Duration owed_{};  ///< less than an inner step
  std::vector<double> motor_angles_;
  std::vector<double> motor_rates_;
  std::vector<double> motor_torques_;
  std::vector<double> joints_;  ///< positions, rates or torques, in between
};

}  // namespace armature::wam
