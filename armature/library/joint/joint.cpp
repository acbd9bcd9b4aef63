// SPDX-License-Identifier: Apache-2.0
#include "armature/library/joint/joint.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "armature/base/seconds.hpp"
#include "armature/library/base/of_this_run.hpp"
#include "armature/library/base/reason_text.hpp"

namespace armature::library {

using component::Outcome;
using control::JointLimiter;

namespace {

/// How long a motor that is to be switched off may brake itself first.
constexpr base::Duration kLongestBraking = std::chrono::seconds(1);

/// Faster than noise [rad/s].
bool moves(double velocity) { return std::abs(velocity) > 0.02; }

bool is_sign(double number) { return number == 1.0 || number == -1.0; }

}  // namespace

Outcome Joint::on_start() {
  if (changes_.take()) {
    if (Outcome outcome = set_up(); !outcome) return outcome;
  }
  if (sampler_ && !voltage_.connected()) {
    return component::refused("nobody writes the input Voltage (connect it, or Sampler: false)");
  }
  arming_ = arm_handler_.bound() ? &arm_handler_.source()->owner() : nullptr;
  started_ = time();
  measured_since_start_ = false;
  switch_off();
  return component::accepted();
}

Outcome Joint::set_up() {
  if (!is_sign(actuator_sign_) || !is_sign(sensor_sign_)) {
    return component::refused("ActuatorSign and SensorSign are 1 or -1");
  }
  if (!std::isfinite(gear_ratio_) || gear_ratio_ <= 0.0) {
    return component::refused("GearRatio is a number above 0; directions are SensorSign's");
  }
  auto limiter = JointLimiter::make(limits());
  if (!limiter) return component::refused(limiter.error());
  limiter_ = limiter.value();
  sensor_ratio_ = sensor_sign_ * gear_ratio_;
  measured_ = {.position = initial_position_, .velocity = 0.0};
  clipped_.assign(0);
  changes_.take();
  return component::accepted();
}

JointLimiter::Config Joint::limits() const {
  return {.lower = lower_,
          .upper = upper_,
          .max_velocity = max_velocity_,
          .max_acceleration = max_acceleration_,
          .max_effort = max_effort_,
          .period = base::from_seconds(period_),
          .arming_time = base::from_seconds(arming_time_),
          .effort_rate = arming_time_ > 0.0 ? max_effort_ / arming_time_ : 0.0};
}

// --- measuring -------------------------------------------------------------------------------

void Joint::on_sample() { sensor_read(); }

bool Joint::sensor_read() { return succeeds(read_hardware_); }

void Joint::on_displacement(double of_motor) {
  const double displacement = sensor_ratio_ * of_motor;
  const double since = base::to_seconds(time() - measured_at_);
  const bool known = measured_since_start_ && since > 0.0;
  measured_.velocity = known ? displacement / since : 0.0;
  measured_.position += displacement;
  measured_at_ = time();
  measured_since_start_ = true;
  displacement_.write(displacement);
  position_.write(measured_.position);
  if (off_at_rest_) cut_power_at_rest();
}

/// In this sampling period or the one before.
bool Joint::measured_lately() const {
  return measured_since_start_ && base::to_seconds(time() - measured_at_) < 1.5 * period_;
}

// --- driving ---------------------------------------------------------------------------------

void Joint::on_act() {
  if (limiter_->armed() && arming_ != nullptr && arming_->state() == component::State::kException) {
    log_error("{} is out of service, so it disarms", arming_->name());
    disarm();
  }
  const auto voltage = voltage_.read();
  if (is_of_this_run(voltage, started_)) apply(voltage.value);
}

/// True if it was passed unchanged.
bool Joint::apply(double voltage) {
  const JointLimiter::LimitedStep step = limiter_->step_effort(measured_, voltage);
  voltage_actuator_.write(actuator_sign_ > 0.0 ? step.value : -step.value);
  if (step.status == JointLimiter::Status::kPassed) return true;
  if (step.status == JointLimiter::Status::kClipped) clipped_.assign(clipped_ + 1);
  if (step.status != JointLimiter::Status::kNotFinite) return false;
  switch_off();
  component::Reason why("Voltage is ");
  append_number(why, voltage).append(" at the position ");
  fault(append_number(why, measured_.position).append(", expected finite numbers"));
  return false;
}

// --- arming ----------------------------------------------------------------------------------

void Joint::on_arm() {
  if (limiter_->armed()) return;
  if (!measured_lately()) return refuse_to_arm("it was not measured in this sampling period");
  if (!limiter_->arm(measured_)) return refuse_to_arm("its position is no finite number");
  off_at_rest_ = false;
  const bool ready = succeeds(actuator_on_) && (!brake_ || succeeds(release_brake_));
  if (!ready) {
    switch_off();
    return refuse_to_arm("its hardware does not switch on");
  }
  armed_.write(true);
  log_info("armed");
}

void Joint::refuse_to_arm(std::string_view why) {
  log_error("not armed: {}", why);
  armed_.write(false);
}

/// @return the brake is applied
bool Joint::disarm() {
  off_at_rest_ = limiter_->armed() && measured_lately() && moves(measured_.velocity);
  disarmed_at_ = time();
  const bool braked = let_go();
  if (!off_at_rest_) cut_power();
  return braked;
}

/// Effort 0 and brake, at once.
bool Joint::let_go() {
  const bool was_armed = limiter_->armed();
  limiter_->disarm();
  voltage_actuator_.write({});
  const bool braked = !brake_ || succeeds(apply_brake_);
  armed_.write(false);
  if (was_armed) log_info("disarmed");
  if (was_armed && !braked) log_error("the hardware did not confirm that it brakes");
  return braked;
}

/// The brake first, so that nothing falls between the two.
bool Joint::switch_off() {
  let_go();
  return cut_power();
}

bool Joint::cut_power() {
  off_at_rest_ = false;
  return succeeds(actuator_off_);
}

void Joint::cut_power_at_rest() {
  const bool waited = time() - disarmed_at_ > kLongestBraking;
  if (waited || !moves(measured_.velocity)) cut_power();
}

bool Joint::brake_release() { return limiter_->armed() && brake_ && succeeds(release_brake_); }

bool Joint::succeeds(component::OperationCaller<bool()>& call) {
  const component::CallResult<bool> answer = call();
  return answer.status == component::CallStatus::kDone && answer.value;
}

}  // namespace armature::library
