// SPDX-License-Identifier: Apache-2.0
#include "armature/control/online/phased_motion.hpp"

#include <algorithm>
#include <cmath>

namespace armature::control {

void PhasedMotion::append(double duration_s, double jerk) {
  if (!(duration_s > 0.0) || size_ == kMost) return;
  phases_[size_++] = {duration_s_, jerk, end_};
  duration_s_ += duration_s;
  end_ = after(end_, duration_s, jerk);
}

MotionSample PhasedMotion::at(double time_s) const {
  if (size_ == 0 || time_s >= duration_s_) return end_;
  std::size_t phase = size_ - 1;
  while (phase > 0 && phases_[phase].start_s > time_s) --phase;
  const Phase& now = phases_[phase];
  return after(now.start, std::max(0.0, time_s - now.start_s), now.jerk);
}

PhasedMotion::Extent PhasedMotion::extent() const {
  Extent extent{end_.position, end_.position};
  const auto include = [&extent](double position) {
    extent.lowest = std::min(extent.lowest, position);
    extent.highest = std::max(extent.highest, position);
  };
  for (std::size_t i = 0; i < size_; ++i) {
    const Phase& phase = phases_[i];
    include(phase.start.position);
    const double length_s = (i + 1 < size_ ? phases_[i + 1].start_s : duration_s_) - phase.start_s;
    // Where the velocity v + a t + j t^2 / 2 passes 0, in the form that cancels nothing.
    const double v = phase.start.velocity;
    const double a = phase.start.acceleration;
    const double inside = a * a - 2.0 * phase.jerk * v;
    if (inside < 0.0) continue;
    const double sum = -(a + std::copysign(std::sqrt(inside), a));
    for (const double turn_s : {sum / phase.jerk, 2.0 * v / sum}) {
      if (turn_s > 0.0 && turn_s < length_s) {
        include(after(phase.start, turn_s, phase.jerk).position);
      }
    }
  }
  return extent;
}

}  // namespace armature::control
