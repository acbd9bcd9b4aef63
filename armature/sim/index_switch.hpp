// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace armature::sim {

/// An inductive switch that is closed where the joint is near one position.
struct IndexSwitch {
  double centre = 0.0;      ///< [rad] of the joint
  double half_width = 0.0;  ///< [rad]

  /// @param position  [rad] of the joint
  /// @rt nonblocking, no allocation
  bool closed(double position) const { return std::abs(position - centre) <= half_width; }
};

}  // namespace armature::sim
