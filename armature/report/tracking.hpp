// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/control/error_metrics.hpp"
#include "armature/report/signals.hpp"

namespace armature::report {

/// One joint: what was wanted and what was measured, at the times of the measurements.
struct Joint {
  std::string name;  ///< `1`, or the component's if that has no number
  std::vector<double> time_s;
  std::vector<double> desired;   ///< [rad]
  std::vector<double> measured;  ///< [rad]
  std::string desired_from;      ///< the signals' names
  std::string measured_from;

  double period_s = 0.0;                ///< between two samples, the median
  std::uint64_t missing = 0;            ///< samples that should be between the others
  std::optional<double> rad_per_count;  ///< of its encoder, if the recording says so

  /// Of the time in which all joints were armed, if the recording says when; else of all of it.
  control::ErrorMetrics::Figures figures;
  double rms = 0.0;  ///< of the error [rad]
  double measured_since_s = 0.0;
  /// How far it was at most from where it was ten seconds before the end of that time [rad]; none:
  /// the time is shorter.
  std::optional<double> moved_lately;
  /// How far it moved in the two seconds before all joints were armed, in which they are held and
  /// let go, or in all of the time if they never were [rad]; none: the recording does not say when.
  std::optional<double> moved_arming;
  /// The largest |error| from two seconds after the reference stopped until it moved again [rad];
  /// none: it never rested so long.
  std::optional<double> at_rest;
};

/// What the report looks for in a recording, as the robot architecture names it:
///
/// - for each joint a component with the ports `Ref` and `Sen`: PID1.Ref, PID1.Sen; its trailing
///   number is the joint's;
/// - else a port `reference` [q, qd, qdd] and a port `sensor` [q, d] of whatever components;
/// - `Joint{i}.Armed`, or `Armed{i}` of another component, for the time that counts;
/// - the properties `Joint{i}.GearRatio`, `Joint{i}.PeerName` and, of the component of that name,
///   `GearRatio` and `CountsPerTurn`, for what a count of the encoder is.
///
/// Signals of another number of samples are brought together by their times: of components with
/// `Ref` and `Sen` a measurement has the reference that was written with it; of the vectors the one
/// that was there when it came, since a reference of the same cycle is the answer to it. Empty if
/// there are no such signals.
std::vector<Joint> joints_of(const Signals& signals);

/// The signals that were looked for, for a message.
const char* what_is_looked_for();

}  // namespace armature::report
