// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/report/signals.hpp"

namespace armature::report {

/// What drove one joint, against the most that it may.
struct Effort {
  std::string joint;  ///< its number
  Signal signal;      ///< in its unit, of torque or voltage
  double largest = 0.0;
  std::optional<double> limit;
};

/// What the report looks for in a recording:
///
/// - the port `jointsDataPort` [q, qd, tau] of whatever component, and the property `MaxTorque` of
///   the same component, for each joint or one for all;
/// - else for each joint `Joint{i}.VoltageActuator` and the property `Joint{i}.MaxVoltage`.
std::vector<Effort> efforts_of(const Signals& signals);

}  // namespace armature::report
