// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/plateau.hpp"

#include <algorithm>
#include <cmath>

namespace armature::control {
namespace {

/// Where the velocity goes if the acceleration is taken to 0 at once.
double natural_velocity(const JerkLimits& limits, double velocity, double acceleration) {
  return velocity + acceleration * std::abs(acceleration) / (2.0 * limits.jerk);
}

/// All plateaus of one problem, by their velocity.
struct Plateaus {
  const JerkLimits& limits;
  const MotionEnds& ends;
  double duration_s;

  Plateau at(double velocity) const {
    Plateau plateau;
    plateau.first =
        VelocityRamp::make(limits, ends.start_velocity, ends.start_acceleration, velocity);
    plateau.last = VelocityRamp::make(limits, ends.end_velocity, -ends.end_acceleration, velocity);
    plateau.keep_s = duration_s - plateau.first.duration_s() - plateau.last.duration_s();
    return plateau;
  }
  double distance(const Plateau& plateau, double velocity) const {
    return velocity * duration_s - plateau.first.lag - plateau.last.lag;
  }
  double slope(const Plateau& plateau) const {
    return duration_s - plateau.first.lag_slope - plateau.last.lag_slope;
  }
};

}  // namespace

/// With w = v - a^2 / 2J and the peak p, p^2 = J (u - w): lag = p^2 (p - a) / J^2 + a^3 / 6J^2.
VelocityRamp VelocityRamp::make(const JerkLimits& limits, double velocity, double acceleration,
                                double next) {
  const double most = limits.acceleration;
  const double j = limits.jerk;
  const double sign = next >= natural_velocity(limits, velocity, acceleration) ? 1.0 : -1.0;
  const double a = sign * acceleration;
  const double rise = std::max(0.0, sign * (next - velocity) + a * a / (2.0 * j));  // u - w
  const double cube = a * a * a / (6.0 * j * j);
  const double peak = std::sqrt(j * rise);
  if (peak <= most) {
    return {sign * j, std::max(0.0, (peak - a) / j),         0.0,
            peak / j, sign * (rise * (peak - a) / j + cube), (1.5 * peak - a) / j};
  }
  const double hold_s = rise / most - most / j;
  return {sign * j,
          (most - a) / j,
          hold_s,
          most / j,
          sign * (rise * ((most - a) / j + 0.5 * hold_s) + cube),
          (most - a) / j + rise / most - most / (2.0 * j)};
}

void VelocityRamp::append_to(PhasedMotion& motion) const {
  motion.append(up_s, jerk);
  motion.append(hold_s, 0.0);
  motion.append(down_s, -jerk);
}

void VelocityRamp::append_backward_to(PhasedMotion& motion) const {
  motion.append(down_s, -jerk);
  motion.append(hold_s, 0.0);
  motion.append(up_s, jerk);
}

std::optional<Plateau> find_plateau(const JerkLimits& limits, const MotionEnds& ends,
                                    double distance, double duration_s) {
  const Plateaus plateaus{limits, ends, duration_s};
  const double one = natural_velocity(limits, ends.start_velocity, ends.start_acceleration);
  const double other = natural_velocity(limits, ends.end_velocity, -ends.end_acceleration);
  double low = std::min(one, other);
  double high = std::max(one, other);
  double velocity = high;
  if (distance >= plateaus.distance(plateaus.at(high), high)) {
    low = high;
    high = limits.velocity;
  } else if (distance <= plateaus.distance(plateaus.at(low), low)) {
    velocity = low;
    high = low;
    low = -limits.velocity;
  } else {
    velocity = 0.5 * (low + high);
  }
  for (int round = 0; round < 60; ++round) {
    const Plateau plateau = plateaus.at(velocity);
    const double error = plateaus.distance(plateau, velocity) - distance;
    const double slope = plateaus.slope(plateau);
    (error > 0.0 ? high : low) = velocity;
    double next = slope > 0.0 ? velocity - error / slope : 0.5 * (low + high);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - velocity) <= 4e-16 * limits.velocity) break;
    velocity = next;
  }
  const Plateau plateau = plateaus.at(velocity);
  const double error = plateaus.distance(plateau, velocity) - distance;
  const double rounding = 1e-12 * (std::abs(distance) + limits.velocity * duration_s);
  if (plateau.keep_s < 0.0 || std::abs(error) > rounding) return std::nullopt;
  return plateau;
}

}  // namespace armature::control
