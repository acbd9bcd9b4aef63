// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/stops.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "armature/control/online/bring_within.hpp"
#include "armature/control/online/plateau.hpp"

namespace armature::control {
namespace {

/// Where c0 + c1 t + c2 t^2 is 0, in the form that cancels nothing; NaN or infinite if nowhere.
std::array<double, 2> zeros(double c0, double c1, double c2) {
  const double inside = c1 * c1 - 4.0 * c2 * c0;
  const double sum = -(c1 + std::copysign(std::sqrt(inside), c1));
  return {sum / (2.0 * c2), 2.0 * c0 / sum};
}

/// When g of the state after `begin` passes 0, where the acceleration has the sign `sign`.
std::array<double, 2> turns_of_stops(double jerk_limit, const MotionSample& begin, double jerk,
                                     double sign) {
  const double share = sign * jerk / jerk_limit;
  const double a = begin.acceleration;
  return zeros(begin.velocity + sign * a * a / (2.0 * jerk_limit), a * (1.0 + share),
               0.5 * jerk * (1.0 + share));
}

}  // namespace

PhasedMotion stop_from(const JerkLimits& limits, const MotionSample& state) {
  PhasedMotion motion;
  motion.begin(state);
  bring_within(limits, motion);
  const auto [position, velocity, acceleration] = motion.end();
  VelocityRamp::make(limits, velocity, acceleration, 0.0).append_to(motion);
  motion.end_in({motion.end().position, 0.0, 0.0});
  return motion;
}

PhasedMotion::Extent extent_of_stops(const JerkLimits& limits, const PhasedMotion& motion) {
  PhasedMotion::Extent all = motion.extent();
  const auto include = [&](const MotionSample& state) {
    const auto [lowest, highest] = stop_from(limits, state).extent();
    all.lowest = std::min(all.lowest, lowest);
    all.highest = std::max(all.highest, highest);
  };
  include(motion.at(0.0));
  include(motion.end());
  for (std::size_t i = 0; i < motion.phases(); ++i) {
    const double begin_s = motion.start_of(i);
    const double next_s = i + 1 < motion.phases() ? motion.start_of(i + 1) : motion.duration_s();
    const MotionSample begin = motion.at(begin_s);
    const double jerk = motion.jerk_of(i);
    for (const double sign : {1.0, -1.0}) {
      for (const double turn_s : turns_of_stops(limits.jerk, begin, jerk, sign)) {
        if (!(turn_s >= 0.0 && turn_s <= next_s - begin_s)) continue;
        const MotionSample there = after(begin, turn_s, jerk);
        if (sign * there.acceleration >= 0.0) include(there);
      }
    }
  }
  return all;
}

}  // namespace armature::control
