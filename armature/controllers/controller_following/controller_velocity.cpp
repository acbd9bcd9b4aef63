// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/controller_following/controller_velocity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "armature/base/seconds.hpp"
#include "armature/control/per_joint.hpp"

namespace armature::controllers {

namespace {

/// Of a gain and the time until its answer acts [rad]: what it takes of the phase margin.
constexpr double kMostLag = 0.5;

}  // namespace

component::Outcome ControllerNVelocity::on_configure() {
  velocities_.assign(static_cast<std::size_t>(joints_.get()), 0.0);
  if (component::Outcome outcome = take_gains(); !outcome) return outcome;
  return Controller::on_configure();
}

component::Outcome ControllerNVelocity::on_start() {
  if (component::Outcome outcome = take_gains(); !outcome) return outcome;
  return Controller::on_start();
}

component::Outcome ControllerNVelocity::take_gains() {
  auto gains = control::per_joint(kp_.name(), kp_.get(), velocities_.size());
  if (!gains) return component::refused(gains.error());
  for (const double gain : gains.value()) {
    if (std::isfinite(gain) && gain >= 0.0) continue;
    return component::refused("Kp must be numbers of at least 0, found " + figure(gain));
  }
  gains_ = std::move(gains).value();
  return component::accepted();
}

/// Drives that follow velocities are no plants of a gain: what counts is how late they answer.
std::vector<DrivenJoint> ControllerNVelocity::followers(const component::Check& check) const {
  std::vector<DrivenJoint> joints(static_cast<std::size_t>(joints_.get()));
  for (const component::Component* const each : check.components()) {
    const auto* const robot = dynamic_cast<const DescribesRobot*>(each);
    if (robot == nullptr) continue;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const auto told = robot->joint(i + 1, JointCommand::kVelocity);
      if (!told) break;
      double& delay_s = joints[i].lightest.delay_s;
      delay_s = std::max(delay_s, told.value().lightest.delay_s);
    }
  }
  answer_later(joints, samples_late(check), base::to_seconds(period()));
  return joints;
}

std::string ControllerNVelocity::objection_to_kp(const std::vector<DrivenJoint>& joints,
                                                 double period_s,
                                                 const std::vector<double>& kp) const {
  const auto gains = control::per_joint(kp_.name(), kp, joints.size());
  if (!gains) return gains.error();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const double gain = gains.value()[i];
    const double late_s = period_s + joints[i].lightest.delay_s;
    if (gain * late_s <= kMostLag) continue;
    return "Kp of joint " + std::to_string(i + 1) + " is " + figure(gain) + " 1/s, expected " +
           figure(kMostLag / late_s) + " at most: it is answered " + figure(1e3 * late_s) +
           " ms late (sampling period and effort_delay of the Robot), and the joint would swing";
  }
  return {};
}

void ControllerNVelocity::controller_now(const std::vector<double>& measured) {
  const std::vector<double>* const reference = reference_now(measured);
  if (reference == nullptr) return;
  const std::size_t joints = velocities_.size();
  for (std::size_t i = 0; i < joints; ++i) {
    velocities_[i] = (*reference)[joints + i] + gains_[i] * ((*reference)[i] - measured[i]);
  }
  drive(velocities_);
}

}  // namespace armature::controllers
