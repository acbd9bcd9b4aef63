// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/report/signals.hpp"
#include "armature/report/tracking.hpp"

namespace armature::report {

/// How fast one joint was to go and went, against the most that it may.
struct Velocity {
  std::string joint;            ///< its number
  Signal desired;               ///< [rad/s]; without a name: the slope of the desired position
  Signal measured;              ///< [rad/s]; without a name: the slope of the measured position
  double largest = 0.0;         ///< of the measured one, without sign [rad/s]
  std::optional<double> limit;  ///< [rad/s]
};

/// What the report looks for in a recording, for each joint that it has positions of:
///
/// - the desired one in the second third of a port `reference` [q, qd, qdd] of whatever component,
///   the measured one in that of a port `jointsDataPort` [q, qd, tau];
/// - else the slope of the position, over a sample before and one behind;
/// - the limit in `Joint{i}.MaxVelocity`, or in `MaxVelocity` of the component that has the port
///   `jointsDataPort`, for each joint or one for all.
std::vector<Velocity> velocities_of(const Signals& signals, const std::vector<Joint>& joints);

}  // namespace armature::report
