// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "robots/wam/emulator/arm_simulation.hpp"
#include "robots/wam/emulator/motors.hpp"

namespace armature::wam {

/// The simulated arm as what the emulated pucks are screwed to, and the hands of its operator.
///
/// Every function but the constructor is nonblocking and allocates nothing.
class ArmMotors final : public Motors {
 public:
  /// [rad/s] of the fastest joint while the arm is carried: the tip stays below the 0.5 m/s at
  /// which the safety board warns.
  static constexpr double kCarryingRate = 0.25;

  /// @param begin  the time that it is; the arm is at rest, all motors braked
  ArmMotors(ArmSimulation arm, base::Time begin);

  std::size_t count() const override { return arm_.motors(); }
  void advance_to(base::Time now) override;
  double angle(std::size_t motor) const override { return arm_.angle(motor); }
  void drive(std::size_t motor, double torque) override;
  void brake(std::size_t motor) override { arm_.brake(motor); }

  /// An operator carries the arm to a posture, in a straight line of its joints, and holds it there
  /// until a motor drives.
  /// @param joints  [rad], as many as the arm has
  void carry_to(const std::vector<double>& joints);
  /// Somebody pushes the arm, which goes on as fast as this from where it is.
  /// @param velocities  of the joints [rad/s], as many as the arm has
  void push(std::span<const double> velocities);
  bool carried() const { return carried_; }
  /// Carried, it has come to where it is held.
  bool arrived() const { return arrived_; }

  /// Where it really is, for tests and pictures.
  const ArmSimulation& arm() const { return arm_; }

 private:
  void carry();

  ArmSimulation arm_;
  base::Time now_;
  bool carried_ = false;
  bool arrived_ = false;
  base::Time carried_since_{};
  base::Duration carried_for_{};
  std::vector<double> from_;  ///< [rad] of the joints
  std::vector<double> to_;
  std::vector<double> positions_;  ///< while it is carried
  std::vector<double> velocities_;
};

}  // namespace armature::wam
