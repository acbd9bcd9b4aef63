// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/joint_velocities.hpp"

#include <utility>

namespace armature::wam {

JointVelocities::JointVelocities(std::size_t joints)
    : filters_(joints, control::LowPass::make({.omega = kCorner, .period_s = kPeriod}).value()),
      last_(joints, 0.0) {}

void JointVelocities::step(std::span<const double> positions, double elapsed_s,
                           std::span<double> velocities) {
  const bool begun = std::exchange(begun_, true);
  for (std::size_t i = 0; i < filters_.size(); ++i) {
    const double moved = positions[i] - std::exchange(last_[i], positions[i]);
    velocities[i] = begun ? filters_[i].step(moved / elapsed_s) : filters_[i].value();
  }
}

}  // namespace armature::wam
