// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/joint/joint.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "armature/base/seconds.hpp"
#include "armature/component/face.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/controllers/base/of_this_run.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::Outcome;
using control::JointLimiter;

namespace {

using namespace std::chrono_literals;

/// For which the effort has to be the same before the joint is let go.
constexpr base::Duration kSettling = 100ms;
/// How long that may take besides the effort's growth.
constexpr base::Duration kSettlingPatience = 2s;
/// For which a joint is watched that was let go.
constexpr base::Duration kWatchTime = 200ms;
/// Over which signs of the effort are counted.
constexpr base::Duration kAlternationTime = 500ms;
/// A joint that was not measured for so long, and for two periods, may have moved when it stops.
constexpr base::Duration kMeasuredLastly = 100ms;
/// How long a joint may take to come to rest once it is to stand.
constexpr base::Duration kComingToRest = 2s;

bool is_sign(double number) { return number == 1.0 || number == -1.0; }

}  // namespace

Outcome Joint::on_configure() {
  initial_position_ = settings_->initial_position;
  measured_ = {.position = kept_.initial(), .velocity = 0.0};
  return set_up();
}

Outcome Joint::on_start() {
  if (changes_.take()) {
    if (Outcome outcome = set_up(); !outcome) return outcome;
  }
  if (sampler_ && !voltage_.connected()) {
    return component::refused("input Voltage has no writer (connect it, or set Sampler: false)");
  }
  arming_ = arm_handler_.bound() ? &face(arm_handler_).source()->owner() : nullptr;
  if (dynamic_cast<const component::StandIn*>(arming_) != nullptr) {
    return component::refused("the event Arm comes from '" + arming_->name() +
                              "' in another process: let an Arming in its own process arm it");
  }
  started_ = time();
  intervals_.begin(period_.duration());
  measured_since_start_ = false;
  switch_off();
  kept_.note_start();
  if (kept_.is_doubtful() && !succeeds(doubt_position_)) {
    return component::refused(
        "autosave needs hardware that asks the operator for position_confirmed, and '" +
        peer_name_.get() + "' does not: leave out autosave");
  }
  return component::accepted();
}

void Joint::on_stop() {
  const base::Duration unseen = time() - measured_at_;
  const bool measured =
      measured_since_start_ && unseen <= std::max(kMeasuredLastly, 2 * period_.duration());
  const bool at_rest = measured && std::abs(measured_.velocity) <= kRest;
  const bool braked = brake_at_once();
  cut_power();
  kept_.note_stop({.position = measured_.position,
                   .at_rest = at_rest,
                   .braked = braked,
                   .exact = succeeds(position_exact_)});
}

Outcome Joint::set_up() {
  if (Outcome outcome = period_.known(); !outcome) return outcome;
  if (!is_sign(settings_->actuator_sign) || !is_sign(settings_->sensor_sign)) {
    return component::refused("ActuatorSign and SensorSign must be 1 or -1");
  }
  if (!std::isfinite(settings_->gear_ratio) || settings_->gear_ratio <= 0.0) {
    return component::refused(
        "GearRatio must be a number above 0; set the direction with SensorSign");
  }
  auto limiter = JointLimiter::make(limits());
  if (!limiter) return component::refused(limiter.error());
  auto sequence = control::ArmingSequence::make(arming_steps());
  if (!sequence) return component::refused(sequence.error());
  auto watch = control::HoldingWatch::make(holding());
  if (!watch) return component::refused(watch.error());
  limiter_ = limiter.value();
  sequence_ = sequence.value();
  watch_ = watch.value();
  sensor_ratio_ = settings_->sensor_sign * settings_->gear_ratio;
  if (settings_->initial_position != initial_position_) {
    initial_position_ = settings_->initial_position;
    measured_ = {.position = initial_position_, .velocity = 0.0};
  }
  clipped_.assign(0);
  changes_.take();
  return component::accepted();
}

JointLimiter::Config Joint::limits() const {
  return {.lower = settings_->lower,
          .upper = settings_->upper,
          .max_velocity = settings_->max_velocity,
          .max_acceleration = settings_->max_acceleration,
          .max_effort = settings_->max_effort,
          .period = period_.duration(),
          .arming_time = base::from_seconds(settings_->arming_time),
          .effort_rate =
              settings_->arming_time > 0.0 ? settings_->max_effort / settings_->arming_time : 0.0};
}

control::ArmingSequence::Config Joint::arming_steps() const {
  return {.max_motion = settings_->arming_motion,
          .effort_tolerance = 0.02 * settings_->max_effort,
          .settling_time = kSettling,
          .patience = base::from_seconds(settings_->arming_time) + kSettlingPatience,
          .watch_time = kWatchTime};
}

control::HoldingWatch::Config Joint::holding() const {
  return {.period = base::from_seconds(period_),
          .max_motion = settings_->holding_motion,
          .max_velocity = settings_->holding_velocity,
          .sinking_velocity = 0.0,
          .least_effort = 0.02 * settings_->max_effort,
          .max_alternation =
              settings_->holding_alternation < 1.0 ? settings_->holding_alternation : 2.0,
          .alternation_time = kAlternationTime,
          .rest_velocity = kRest,
          .settling_time = kComingToRest};
}

std::vector<DrivenJoint> Joint::joints_behind(const component::InputPortBase* /*input*/,
                                              const component::Check& check) {
  const auto joint = model_.driven(check);
  if (!joint) return {};
  std::vector<DrivenJoint> joints{*joint};
  for (const component::InputPortBase* const hardware : check.readers_of(voltage_actuator_)) {
    if (!check.delayed(face(voltage_actuator_), *hardware)) continue;
    answer_later(joints, 1, base::to_seconds(period()));
    break;
  }
  return joints;
}

// --- measuring -------------------------------------------------------------------------------

void Joint::on_sample() {
  if (is_in_time()) succeeds(read_hardware_);
}

/// Without Sampler, whoever calls this samples it.
double Joint::sensor_read() {
  displacement_read_ = std::numeric_limits<double>::quiet_NaN();
  if (sampler_ || is_in_time()) succeeds(read_hardware_);
  return displacement_read_;
}

/// Out of service if it is sampled otherwise than everything is computed for.
bool Joint::is_in_time() {
  if (state() != component::State::kRunning) return true;
  const std::optional<component::Reason> wrong = intervals_.sample(*this);
  if (!wrong) return true;
  switch_off();
  fault(*wrong);
  return false;
}

void Joint::on_displacement(double of_motor) {
  const double displacement = sensor_ratio_ * of_motor;
  const double since = base::to_seconds(time() - measured_at_);
  const bool known = measured_since_start_ && since > 0.0;
  measured_.velocity = known ? displacement / since : 0.0;
  measured_.position += displacement;
  measured_at_ = time();
  measured_since_start_ = true;
  displacement_read_ = displacement;
  displacement_.write(displacement);
  position_.write(measured_.position);
  if (off_at_rest_) cut_power_at_rest();
  if (phase_ == Phase::kDisarmed) {
    note_sinking(displacement);
  } else if (phase_ == Phase::kArmed) {
    watch();
  } else {
    go_on_arming();
  }
}

/// In this sampling period or the one before.
bool Joint::measured_lately() const {
  return measured_since_start_ && base::to_seconds(time() - measured_at_) < 1.5 * period_.seconds();
}

// --- driving ---------------------------------------------------------------------------------

void Joint::on_act() {
  if (phase_ != Phase::kDisarmed && arming_ != nullptr &&
      arming_->state() == component::State::kException) {
    log_error("{} is out of service, so it disarms", arming_->name());
    disarm();
  }
  const auto voltage = voltage_.read();
  if (is_of_this_run(voltage, started_)) apply(voltage.value);
}

/// True if it was passed unchanged.
bool Joint::apply(double voltage) {
  const JointLimiter::LimitedStep step = limiter_->step_effort(measured_, voltage);
  commanded_ = voltage;
  effort_ = step.value;
  passed_ = step.status == JointLimiter::Status::kPassed;
  voltage_actuator_.write(settings_->actuator_sign > 0.0 ? step.value : -step.value);
  if (step.status == JointLimiter::Status::kPassed) return true;
  if (step.status == JointLimiter::Status::kClipped) clipped_.assign(clipped_ + 1);
  if (step.status != JointLimiter::Status::kNotFinite) return false;
  switch_off();
  component::Reason why("Voltage is ");
  append_number(why, voltage).append(" at the position ");
  fault(append_number(why, measured_.position).append(", expected finite numbers"));
  return false;
}

}  // namespace armature::controllers
