// SPDX-License-Identifier: Apache-2.0
#include "armature/library/pid/pid.hpp"

#include <cmath>

#include "armature/library/base/of_this_run.hpp"
#include "armature/library/base/reason_text.hpp"

namespace armature::library {

component::Outcome Pid::on_start() {
  auto made = control::Pid::make(config());
  if (!made) return component::refused(made.error());
  pid_ = made.value();
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
  const control::Pid::Config& present = pid_->config();
  const bool same = present.kp == kp_ && present.ki == ki_ && present.kd == kd_;
  if (!same) static_cast<void>(pid_->reconfigure(config()));
}

void Pid::reset() {
  if (pid_) pid_->reset();
}

}  // namespace armature::library
