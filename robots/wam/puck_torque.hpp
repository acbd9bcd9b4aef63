// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace armature::wam {

/// A torque in the whole units that a puck takes. What rounding down leaves of it is added to the
/// next one, so that the mean of what is sent is what was wanted: rounded down alone, the torques
/// of all motors would be half a unit too low in the mean, and the arm would creep.
class PuckTorque {
 public:
  /// @param units  finite, and so few that a puck takes them
  /// @rt nonblocking, no allocation
  void set(double units) { wanted_ = units; }
  bool is_zero() const { return wanted_ == 0.0; }
  /// For the next frame: what is wanted rounded down, or one unit more. Of a whole number of units
  /// never more than that; 0 stays 0.
  /// @rt nonblocking, no allocation
  std::int16_t next();

 private:
  double wanted_ = 0.0;
  double rest_ = 0.0;  ///< of the torques until now, in [0, 1)
};

}  // namespace armature::wam
