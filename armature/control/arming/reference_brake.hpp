// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::control {

/// What N joints follow when nobody says any more where they are to go: their reference brakes to
/// rest, each joint by itself, and holds there. A new one takes over only where the joints are
/// measured, and at rest: an old motion is not gone on with, and nothing jumps.
///
/// References are [q1..qN, qd1..qdN, qdd1..qddN], in the unit of the joint and seconds. One thread
/// uses it.
class ReferenceBrake {
 public:
  /// How hard the references may brake.
  struct Config {
    std::size_t joints = 0;                ///< >= 1
    std::vector<double> max_acceleration;  ///< > 0, one for each joint or one for all
    base::Duration period{};               ///< between two steps; > 0
    double tolerance = 0.01;               ///< of where the joints are measured; > 0
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<ReferenceBrake> make(const Config& config);

  /// From `last` on, which was followed in the period before.
  /// @rt nonblocking, no allocation, O(joints)
  void begin(const std::vector<double>& last);

  /// Whether each joint would come to rest within `most` of where a motion would that brakes as
  /// hard.
  /// @param motion  positions and velocities of the joints first, as of a reference
  /// @rt nonblocking, no allocation, O(joints)
  bool rests_near(const std::vector<double>& motion, double most) const;

  /// The reference of the next period.
  /// @rt nonblocking, no allocation, O(joints)
  const std::vector<double>& step();

  /// Whether all joints have come to rest and `wanted` has them rest where they are.
  /// @param measured  positions of the joints first
  /// @rt nonblocking, no allocation, O(joints)
  bool may_give_way_to(const std::vector<double>& wanted,
                       const std::vector<double>& measured) const;

 private:
  double rest_of(std::size_t joint, const std::vector<double>& motion) const;
  explicit ReferenceBrake(const Config& config, std::vector<double> max_acceleration);

  std::size_t joints_;
  std::vector<double> max_acceleration_;
  double period_s_;
  double tolerance_;
  std::vector<double> reference_;
};

}  // namespace armature::control
