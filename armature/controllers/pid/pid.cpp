// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/pid/pid.hpp"

#include <algorithm>
#include <cmath>

#include "armature/base/seconds.hpp"
#include "armature/component/face.hpp"
#include "armature/controllers/base/of_this_run.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {
namespace {

constexpr double kRoundedUp = 1.001;
/// Of the effort one way, the other way: with less a joint is not held.
constexpr double kLeastShare = 0.1;

/// One that cannot drive nothing drives a joint that is to stand.
std::string objection_to_range(double u_min, double u_max) {
  if (u_min <= 0.0 && u_max >= 0.0) return {};
  return "UMin is " + figure(u_min) + " and UMax " + figure(u_max) +
         ", expected 0 between them: else it drives a joint that is where it should be";
}

}  // namespace

component::Outcome Pid::on_start() {
  auto made = control::Pid::make(config_.get());
  if (!made) return component::refused(made.error());
  pid_ = made.value();
  fade_.be(config_.get());
  started_ = time();
  if (const double* const present = output_.taken_over()) take_over(*present);
  return component::accepted();
}

/// What was desired before counts.
void Pid::take_over(double output) {
  pid_->reset_to(output);
  if (const auto reference = reference_.read()) started_ = reference.time;
}

void Pid::on_update() {
  if (read_sensor_.bound()) expect_done(read_sensor_().status, "sensorRead");
}

void Pid::expect_done(component::CallStatus status, std::string_view operation) {
  if (status == component::CallStatus::kDone) return;
  component::Reason why(peer_name_.get());
  fault(why.append(".").append(operation).append(": ").append(component::name_of(status)));
}

void Pid::step(double measured) {
  const auto reference = reference_.read();
  if (!is_of_this_run(reference, started_)) return;
  take_gains();
  const double output = pid_->step(reference.value - measured);
  if (std::isfinite(output)) {
    output_.write(output);
    if (motor_set_.bound()) expect_done(motor_set_(output).status, "motorSet");
    return;
  }
  component::Reason why("Ref - Sen is ");
  append_number(why, reference.value).append(" - ");
  fault(append_number(why, measured).append(", expected finite numbers"));
}

/// Within their ranges, so that they are never refused.
void Pid::take_gains() {
  if (pid_->config() == config_.get()) return;
  static_cast<void>(
      pid_->reconfigure(fade_.step(config_.get(), time(), base::from_seconds(gain_fade_time_))));
}

std::vector<DrivenJoint> Pid::joints(const component::Check& check) {
  const component::OperationBase* const target = check.target_of(motor_set_);
  std::vector<DrivenJoint> joints;
  if (target == nullptr) {
    joints = controllers::joints_behind(face(output_), check);
  } else if (auto* const joint = dynamic_cast<DrivesJoints*>(&target->owner())) {
    joints = joint->joints_behind(nullptr, check);
  }
  answer_later(joints, cycles_late(face(measured_), check), base::to_seconds(period()));
  return joints;
}

std::vector<DrivenJoint> Pid::joints_behind(const component::InputPortBase* input,
                                            const component::Check& check) {
  return input == &face(reference_) ? joints(check) : std::vector<DrivenJoint>{};
}

/// With a joint of its own it is to measure that one, and to follow something else.
void Pid::on_check(component::Check& check) const {
  if (const std::string wrong = objection_to_range(config_->u_min, config_->u_max);
      !wrong.empty()) {
    check.error(wrong);
  }
  const component::OperationBase* const target = check.target_of(motor_set_);
  if (target == nullptr) {
    const std::string& peer = peer_name_.get();
    if (!peer.empty()) {
      check.error("PeerName is '" + peer + "', and nothing of that peer serves motorSet",
                  "name a Joint, or bind what a composite exports: bind: {sensorRead: " + peer +
                      ".EncoderRead, motorSet: " + peer + ".MotorSet}");
    }
    return;
  }
  const component::Component& joint = target->owner();
  for (const component::OutputPortBase* const writer : check.writers_of(measured_)) {
    if (&writer->owner() == &joint) continue;
    check.error("it drives '" + std::string(joint.name()) + "', and Sen is of '" +
                    std::string(writer->owner().name()) + "'",
                "connect the position of the joint that it drives");
  }
  for (const component::OutputPortBase* const writer : check.writers_of(reference_)) {
    if (&writer->owner() != &joint) continue;
    check.error("it would follow what it drives: Ref is of '" + std::string(joint.name()) + "'",
                "connect the desired position");
  }
}

std::string Pid::objection(const DrivenJoint& joint, double period_s,
                           const CheckedGains::Wanted& wanted) const {
  if (joint.unit != unit_.get()) {
    return "its Unit is " + unit_.get() + ", but that of " + joint.name + " is " + joint.unit +
           ": set Unit to " + joint.unit;
  }
  const Config gains = wanted.value_of(config_);
  if (const auto checked = control::Pid::check(gains); !checked) return checked.error();
  if (std::string wrong = objection_to_range(gains.u_min, gains.u_max); !wrong.empty())
    return wrong;
  const double most = std::max(std::abs(gains.u_min), std::abs(gains.u_max));
  if (most > kRoundedUp * joint.most_effort) {
    return "UMin and UMax are up to " + figure(most) + ", " + joint.name + " takes " +
           figure(joint.most_effort);
  }
  const double least = std::min(std::abs(gains.u_min), std::abs(gains.u_max));
  if (least < kLeastShare * most) {
    return "UMin is " + figure(gains.u_min) + " and UMax " + figure(gains.u_max) + ": " +
           joint.name + " would be driven one way only, expected at least " +
           figure(kLeastShare * most) + " both ways";
  }
  const bool drives = gains.kp > 0.0 || gains.ki > 0.0 || gains.kd > 0.0;
  if (!drives) return {};
  return objection_to_gains(joint, control::SampledController::of(gains), period_s);
}

void Pid::reset() {
  if (pid_) pid_->reset();
}

}  // namespace armature::controllers
