// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace armature::sim {

/// An incremental encoder on the motor's shaft, after quadrature.
class Encoder {
 public:
  /// @param counts_per_turn  of the motor, > 0
  /// @param gear_ratio       turns of the motor for one of the joint
  Encoder(double counts_per_turn, double gear_ratio);

  /// The count where the joint is. Position 0 is in the middle of count 0, so that a joint at rest
  /// there does not flicker.
  /// @param position  [rad] of the joint
  /// @rt nonblocking, no allocation
  std::int64_t count(double position) const;

  /// Counts since the last call, or since `restart`. The sum of all is the difference of the
  /// counts, however long it lasts: nothing is rounded on the way.
  /// @param position  [rad] of the joint
  /// @rt nonblocking, no allocation
  std::int64_t displacement(double position);

  /// Displacements count from here on.
  /// @param position  [rad] of the joint
  /// @rt nonblocking, no allocation
  void restart(double position) { last_ = count(position); }

 private:
  double counts_per_rad_;
  std::int64_t last_ = 0;
};

}  // namespace armature::sim
