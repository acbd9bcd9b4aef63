// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::control {

/// Between two knots of a taught motion, in its own time [s]: a hand does little in less.
inline constexpr double kKnotSpacing_s = 0.04;

/// What the four control points around a place on a uniform cubic B-spline count there.
struct SplineWeights {
  std::array<double, 4> position{};
  std::array<double, 4> slope{};      ///< d/ds [1/s]
  std::array<double, 4> curvature{};  ///< d2/ds2 [1/s^2]

  /// @param share  0..1, between two knots
  /// @rt nonblocking, no allocation
  static SplineWeights at(double share);
};

/// Where joints were, one row of all joints for each time.
struct TaughtSamples {
  std::size_t axes = 0;
  std::vector<double> times_s;    ///< rising
  std::vector<double> positions;  ///< times x axes [rad]
};

/// A path of several joints as a hand taught it: a uniform cubic B-spline of time. Its positions,
/// velocities and accelerations are continuous, and lie within its control points' hull.
struct TaughtMotion {
  std::size_t axes = 0;
  std::vector<double> points;      ///< control points x axes [rad], at least 4
  double largest_deviation = 0.0;  ///< of a sample from the path [rad]

  double duration_s() const;
  /// @param time_s  of the teaching, from its begin; outside: the nearest end
  std::vector<double> positions_at(double time_s) const;
};

/// The four points (Bezier's) within whose hull an axis stays from a knot to the next one.
/// @param points  control points x axes, more than knot + 3 of them
/// @rt nonblocking, no allocation
std::array<double, 4> taught_hull(std::span<const double> points, std::size_t axes,
                                  std::size_t knot, std::size_t axis);

/// The smooth path nearest to `samples`: least squares, with a small penalty on the second
/// differences of the control points, which bridges gaps and forgets a sensor's noise (Eilers and
/// Marx 1996, "Flexible Smoothing with B-splines and Penalties", equation 6).
/// @return the error names the sample, from 1, that is not finite, not later than the one before,
///         or says that there are too few
base::Result<TaughtMotion> fit_taught_motion(const TaughtSamples& samples);

}  // namespace armature::control
