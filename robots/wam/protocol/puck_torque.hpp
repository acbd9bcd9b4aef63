// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace armature::wam {

/// A torque in the whole units that a puck takes. What rounding leaves of it is added to the next
/// ones, so that the mean of what is sent is what was wanted: rounded down alone, the torques of
/// all motors would be half a unit too low in the mean, and the arm would creep.
///
/// A torque that changes fast steps from frame to frame by no more than a unit beyond what was
/// wanted, as if it were rounded down: who limits its growth has to reckon with one unit.
class PuckTorque {
 public:
  /// @param units  finite, and so few that a puck takes them
  /// @rt nonblocking, no allocation
  void set(double units) { wanted_ = units; }
  bool is_zero() const { return wanted_ == 0.0; }
  /// For the next frame: what is wanted rounded down, or one unit more; of a whole number that
  /// number.
  /// @rt nonblocking, no allocation
  std::int16_t next();

 private:
  struct Sent {
    double wanted = 0.0;
    double part = 0.0;  ///< of a unit, above the whole ones; in [0, 1]
    bool up = false;    ///< one unit more than the whole ones
  };
  bool rounds_up(double part) const;

  double wanted_ = 0.0;
  double rest_ = 0.0;  ///< of the torques until now
  Sent last_;
};

}  // namespace armature::wam
