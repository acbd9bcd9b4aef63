// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/reference_brake.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/control/internal/mistakes.hpp"
#include "armature/control/per_joint.hpp"

namespace armature::control {

base::Result<ReferenceBrake> ReferenceBrake::make(const Config& config) {
  internal::Mistakes mistakes("ReferenceBrake");
  mistakes.expect(config.joints >= 1, "joints", 0.0, "at least 1");
  for (const double limit : config.max_acceleration) {
    mistakes.expect_positive("max_acceleration", limit);
  }
  mistakes.expect_positive("period [s]", base::to_seconds(config.period));
  mistakes.expect_positive("tolerance", config.tolerance);
  if (const auto checked = mistakes.result(); !checked) return base::Error{checked.error()};
  auto limits = per_joint("max_acceleration", config.max_acceleration, config.joints);
  if (!limits) return base::Error{limits.error()};
  return ReferenceBrake(config, std::move(limits.value()));
}

ReferenceBrake::ReferenceBrake(const Config& config, std::vector<double> max_acceleration)
    : joints_(config.joints),
      max_acceleration_(std::move(max_acceleration)),
      period_s_(base::to_seconds(config.period)),
      tolerance_(config.tolerance),
      reference_(3 * config.joints, 0.0) {}

void ReferenceBrake::begin(const std::vector<double>& last) {
  std::copy_n(last.begin(), reference_.size(), reference_.begin());
}

double ReferenceBrake::rest_of(std::size_t joint, const std::vector<double>& motion) const {
  const double velocity = motion[joints_ + joint];
  return motion[joint] + velocity * std::abs(velocity) / (2.0 * max_acceleration_[joint]);
}

bool ReferenceBrake::rests_near(const std::vector<double>& motion, double most) const {
  for (std::size_t i = 0; i < joints_; ++i) {
    if (!(std::abs(rest_of(i, reference_) - rest_of(i, motion)) <= most)) return false;
  }
  return true;
}

const std::vector<double>& ReferenceBrake::step() {
  double* const positions = reference_.data();
  double* const velocities = positions + joints_;
  double* const accelerations = velocities + joints_;
  for (std::size_t i = 0; i < joints_; ++i) {
    const double before = velocities[i];
    const double most = max_acceleration_[i] * period_s_;
    const double change = std::clamp(-before, -most, most);
    positions[i] += (before + 0.5 * change) * period_s_;
    velocities[i] = before + change;
    accelerations[i] = change / period_s_;
  }
  return reference_;
}

bool ReferenceBrake::may_give_way_to(const std::vector<double>& wanted,
                                     const std::vector<double>& measured) const {
  for (std::size_t i = 0; i < joints_; ++i) {
    const bool rests = reference_[joints_ + i] == 0.0 && wanted[joints_ + i] == 0.0;
    if (!rests || !(std::abs(wanted[i] - measured[i]) <= tolerance_)) return false;
  }
  return true;
}

}  // namespace armature::control
