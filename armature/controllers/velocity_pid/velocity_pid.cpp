// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/velocity_pid/velocity_pid.hpp"

#include <algorithm>
#include <cmath>

#include "armature/base/seconds.hpp"
#include "armature/component/face.hpp"
#include "armature/controllers/base/of_this_run.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {
namespace {

/// Of the limits, by which a sum of rounded figures may be beyond.
constexpr double kRoundedLimits = 1.001;

/// The same controller seen from the joint's position, whose differences velocities are: its
/// proportional gain is a differential one there, its integral gain a proportional one.
control::Pid::Config seen_from_position(const control::Pid::Config& gains, double period_s) {
  return {.kp = gains.ki / period_s,
          .ki = 0.0,
          .kd = gains.kp / period_s,
          .u_min = gains.u_min,
          .u_max = gains.u_max};
}

}  // namespace

component::Outcome VelocityPid::on_start() {
  if (changes_.take()) {
    if (component::Outcome outcome = set_up(); !outcome) return outcome;
  }
  pid_->reset();
  started_ = time();
  return component::accepted();
}

component::Outcome VelocityPid::set_up() {
  if (component::Outcome outcome = period_.known(); !outcome) return outcome;
  auto made = control::Pid::make(config_.get());
  if (!made) return component::refused(made.error());
  pid_ = made.value();
  changes_.take();
  return component::accepted();
}

void VelocityPid::step(double displacement) {
  const auto reference = reference_.read();
  if (!is_of_this_run(reference, started_)) return;
  const double velocity = displacement / period_.seconds();
  const double output = pid_->step(reference.value - velocity);
  if (std::isfinite(output)) {
    output_.write(output);
    return;
  }
  component::Reason why("Ref is ");
  append_number(why, reference.value).append(" and the measured velocity ");
  fault(append_number(why, velocity).append(", expected finite numbers"));
}

void VelocityPid::reset() {
  if (pid_) pid_->reset();
}

/// It measures what it drives.
void VelocityPid::on_check(component::Check& check) const {
  for (const component::InputPortBase* const driven : check.readers_of(face(output_))) {
    for (const component::OutputPortBase* const writer : check.writers_of(face(measured_))) {
      if (&writer->owner() == &driven->owner()) continue;
      check.error("it drives '" + std::string(driven->owner().name()) + "', and Sen is of '" +
                      std::string(writer->owner().name()) + "'",
                  "connect the displacement of the joint that it drives");
    }
  }
}

std::vector<DrivenJoint> VelocityPid::joints(const component::Check& check) {
  std::vector<DrivenJoint> joints = controllers::joints_behind(face(output_), check);
  answer_later(joints, cycles_late(face(measured_), check), base::to_seconds(period()));
  return joints;
}

std::vector<DrivenJoint> VelocityPid::joints_behind(const component::InputPortBase* input,
                                                    const component::Check& check) {
  return input == &face(reference_) ? joints(check) : std::vector<DrivenJoint>{};
}

std::string VelocityPid::objection(const DrivenJoint& joint, double period_s,
                                   const control::Pid::Config& gains) {
  if (const auto checked = control::Pid::check(gains); !checked) return checked.error();
  if (gains.u_min > 0.0 || gains.u_max < 0.0) {
    return "UMin is " + figure(gains.u_min) + " and UMax " + figure(gains.u_max) +
           ", expected 0 between them: else it drives a joint that is to rest";
  }
  const double most = std::max(std::abs(gains.u_min), std::abs(gains.u_max));
  if (most > kRoundedLimits * joint.most_effort) {
    return "UMin and UMax are up to " + figure(most) + ", " + joint.name + " takes " +
           figure(joint.most_effort);
  }
  if (gains.kp == 0.0 && gains.ki == 0.0) return {};
  return objection_to_gains(
      joint, control::SampledController::of(seen_from_position(gains, period_s)), period_s);
}

}  // namespace armature::controllers
