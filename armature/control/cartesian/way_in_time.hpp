// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace armature::control {

/// What a tool may do at the places of its path, which are evenly spread from begin to end.
struct WayLimits {
  double length = 0.0;               ///< [m] of the path, > 0
  std::vector<double> velocity;      ///< [m/s] at each place, > 0, at least two
  std::vector<double> acceleration;  ///< [m/s^2] along the way at each place, > 0
};

/// How far a tool has come, from rest to rest, as fast as its limits allow, with limited jerk.
///
/// The square of the speed is piecewise linear between the places, found by a pass forth and one
/// back (Bobrow, Dubowsky and Gibson 1985). The way is then averaged over the last 0.1 s: its
/// acceleration changes by at most twice the largest one in that time. The mean keeps the limits
/// since those of each place are first lowered to the least ones of all places that may come into
/// the same mean.
class WayInTime {
 public:
  static constexpr double kSmoothing_s = 0.1;

  explicit WayInTime(const WayLimits& limits);

  double duration() const { return times_.back() + kSmoothing_s; }
  /// [m]
  double at(double time_s) const;

 private:
  double integral(double time_s) const;

  double length_;
  double step_;  ///< between two places
  std::vector<double> speeds_;
  std::vector<double> times_;
  std::vector<double> integrals_;  ///< of the way by the time, up to each place [m s]
};

}  // namespace armature::control
