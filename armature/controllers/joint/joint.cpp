// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/joint/joint.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

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
/// For which a drive may be slower or faster than it was told.
constexpr base::Duration kVelocityPatience = 100ms;
/// Of the error that is allowed: the way that a joint may be told to go while its position is the
/// same to the bit.
constexpr double kStillShare = 1.0 / 3.0;
/// Of velocities: slower ones than what is allowed in this time may be rounded away by a drive.
constexpr double kStillMemory = 1.0;  // s
/// Over which signs of the effort are counted.
constexpr base::Duration kAlternationTime = 500ms;
/// A joint that was not measured for so long, and for two periods, may have moved when it stops.
constexpr base::Duration kMeasuredLastly = 100ms;
/// How long a joint may take to come to rest once it is to stand.
constexpr base::Duration kComingToRest = 2s;
/// What is slower rests, or is noise.
constexpr double kSlowestAngle = 0.02;    // rad/s
constexpr double kSlowestLength = 0.001;  // m/s

bool is_sign(double number) { return number == 1.0 || number == -1.0; }

}  // namespace

Outcome Joint::on_configure() {
  zero_ = settings_->zero();
  measured_ = {.position = kept_.initial(), .velocity = 0.0};
  return set_up();
}

Outcome Joint::on_start() {
  if (changes_.take()) {
    if (Outcome outcome = set_up(); !outcome) {
      changes_.follow();  // the next start asks again
      return outcome;
    }
  }
  if (sampler_ && !command_.connected()) {
    return component::refused("input " + std::string(names_.command) +
                              " has no writer (connect it, or set Sampler: false)");
  }
  if (way_ == JointCommand::kPosition && !position_sensor_.connected()) {
    return component::refused("input PositionSensor has no writer: its drive is told where to go");
  }
  arming_ = arm_handler_.bound() ? &face(arm_handler_).source()->owner() : nullptr;
  if (dynamic_cast<const component::StandIn*>(arming_) != nullptr) {
    return component::refused("the event Arm comes from '" + arming_->name() +
                              "' in another process: let an Arming in its own process arm it");
  }
  if (settings_->homing_required && homes_by_hardware() && !hardware_.tells_of_home()) {
    return component::refused("HomingRequired is set, and '" + peer_name_.get() +
                              "' does not home by itself: set HomingMethod, or leave it out");
  }
  started_ = time();
  intervals_.begin(period_.duration());
  measured_since_start_ = false;
  homed_now_ = false;
  homed_.assign(false);
  if (absolute_) absolute_->reset();
  switch_off();
  kept_.note_start();
  if (kept_.is_doubtful() && !hardware_.doubt_position()) {
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
  const bool at_rest = measured && std::abs(measured_.velocity) <= rest_;
  const bool braked = brake_at_once();
  cut_power();
  kept_.note_stop({.position = measured_.position,
                   .at_rest = at_rest,
                   .braked = braked,
                   .exact = hardware_.is_exact(),
                   .known = unknown_ == Unknown::kNothing});
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
  if (!is_effort(way_) && settings_->actuator_sign != 1.0) {
    return component::refused(
        "ActuatorSign must be 1: the drive follows its own sensor, whose direction SensorSign "
        "says");
  }
  if (!is_effort(way_) && !(settings_->max_error > 0.0)) {
    return component::refused(std::string(names_.limit) + " must be a number above 0");
  }
  rest_ = units_.position().get() == "m" ? kSlowestLength : kSlowestAngle;
  auto limiter = JointLimiter::make(limits());
  if (!limiter) return component::refused(limiter.error());
  auto sequence = control::ArmingSequence::make(arming_steps());
  if (!sequence) return component::refused(sequence.error());
  auto watch = control::HoldingWatch::make(holding());
  if (!watch) return component::refused(watch.error());
  auto absolute = control::AbsolutePosition::make(absolute_sensor());
  if (!absolute) return component::refused(absolute.error());
  if (Outcome outcome = own_.set_up(period_.duration()); !outcome) return outcome;
  if (Outcome outcome = count_from_zero(); !outcome) return outcome;
  limiter_ = limiter.value();
  absolute_ = absolute.value();
  following_ = control::FollowingWatch(
      {.max_error = settings_->max_error,
       .patience = way_ == JointCommand::kVelocity ? kVelocityPatience : base::Duration{}});
  still_ = control::StillWatch(still());
  sequence_ = sequence.value();
  watch_ = watch.value();
  sensor_ratio_ = settings_->sensor_sign * settings_->gear_ratio;
  effort_ratio_ =
      settings_->actuator_sign * (way_ == JointCommand::kTorque ? settings_->gear_ratio : 1.0);
  clipped_.assign(0);
  changes_.take();
  return component::accepted();
}

/// What homing has found is of the zero that it was found with.
Outcome Joint::count_from_zero() {
  const JointZero before = zero_;
  const JointZero now = settings_->zero();
  if (now == before) return component::accepted();
  if (is_found_ && !hardware_.doubt_position()) {
    return component::refused(
        "InitialPos, SensorSign, GearRatio or SensorRange was changed since it was homed, and '" +
        peer_name_.get() + "' asks nobody for position_confirmed: set it back");
  }
  if (is_found_) unknown_ = Unknown::kOtherZero;
  is_found_ = false;
  zero_ = now;
  if (now.position != before.position) measured_ = {.position = now.position, .velocity = 0.0};
  return component::accepted();
}

control::StillWatch::Config Joint::still() const {
  if (way_ == JointCommand::kPosition) return {.most = kStillShare * settings_->max_error};
  return {.most = settings_->max_error * base::to_seconds(kVelocityPatience),
          .memory = kStillMemory};
}

/// Of a joint whose drive controls it: the drive has its own.
double Joint::max_effort() const { return is_effort(way_) ? settings_->max_effort : 1.0; }

/// What homing has found outlasts a change of other settings.
control::AbsolutePosition::Config Joint::absolute_sensor() const {
  const bool is_found = is_found_ && settings_->zero() == zero_;
  return {.ratio = settings_->sensor_sign * settings_->gear_ratio,
          .offset = is_found ? absolute_->offset() : settings_->initial_position,
          .range = settings_->sensor_range,
          .max_velocity = settings_->max_velocity};
}

JointLimiter::Config Joint::limits() const {
  return {
      .lower = settings_->lowest(),
      .upper = settings_->highest(),
      .max_velocity = settings_->max_velocity,
      .max_acceleration = settings_->max_acceleration,
      .max_effort = max_effort(),
      .period = period_.duration(),
      .arming_time = base::from_seconds(settings_->arming_time),
      .effort_rate = settings_->arming_time > 0.0 ? max_effort() / settings_->arming_time : 0.0};
}

control::ArmingSequence::Config Joint::arming_steps() const {
  return {.max_motion = settings_->arming_motion,
          .effort_tolerance = 0.02 * max_effort(),
          .settling_time = kSettling,
          .patience = base::from_seconds(settings_->arming_time) + kSettlingPatience,
          .watch_time = kWatchTime};
}

control::HoldingWatch::Config Joint::holding() const {
  return {.period = base::from_seconds(period_),
          .max_motion = settings_->holding_motion,
          .max_velocity = settings_->holding_velocity,
          .sinking_velocity = 0.0,
          .least_effort = 0.02 * max_effort(),
          .max_alternation =
              settings_->holding_alternation < 1.0 ? settings_->holding_alternation : 2.0,
          .alternation_time = kAlternationTime,
          .rest_velocity = rest_,
          .settling_time = kComingToRest};
}

std::vector<DrivenJoint> Joint::joints_behind(const component::InputPortBase* /*input*/,
                                              const component::Check& check) {
  const auto joint = model_.driven(check);
  if (!joint) return {};
  std::vector<DrivenJoint> joints{*joint};
  for (const component::InputPortBase* const hardware : check.readers_of(command_output_.port())) {
    if (!check.delayed(command_output_.port(), *hardware)) continue;
    answer_later(joints, 1, base::to_seconds(period()));
    break;
  }
  return joints;
}

// --- measuring -------------------------------------------------------------------------------

void Joint::on_sample() {
  if (is_in_time() && is_homing_watched()) hardware_.read();
}

/// Without Sampler, whoever calls this samples it.
double Joint::sensor_read() {
  displacement_read_ = std::numeric_limits<double>::quiet_NaN();
  if (sampler_ || (is_in_time() && is_homing_watched())) hardware_.read();
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
  moved(displacement, measured_.position + displacement);
}

void Joint::on_position(double of_motor) {
  if (!std::isfinite(of_motor)) {
    switch_off();
    component::Reason why("PositionSensor is ");
    return fault(append_number(why, of_motor).append(", expected a finite number"));
  }
  const auto reading = absolute_->step(of_motor, base::to_seconds(time() - measured_at_));
  if (!reading.jumped) return moved(reading.displacement, reading.position);
  const bool may_jump = phase_ == Phase::kHoming && homes_by_hardware() && !homing_jumped_;
  if (may_jump) return homing_jumped(reading.position);
  switch_off();
  component::Reason why("PositionSensor says that it moved by ");
  append_number(why, reading.displacement)
      .append(" ")
      .append(units_.position().get())
      .append(" since the sample before, expected at most ");
  fault(append_number(why, reading.possible)
            .append(" ")
            .append(units_.position().get())
            .append(" by MaxVelocity; look at the sensor"));
}

void Joint::moved(double displacement, double to) {
  const double since = base::to_seconds(time() - measured_at_);
  const bool known = measured_since_start_ && since > 0.0;
  measured_.velocity = known ? displacement / since : 0.0;
  measured_.position = to;
  measured_at_ = time();
  measured_since_start_ = true;
  displacement_read_ = displacement;
  const bool homes_by_itself = phase_ == Phase::kHoming && !homes_by_hardware();
  if (homes_by_itself) follow_own_homing(displacement);  // which may say where it is
  displacement_.write(displacement);
  position_.write(measured_.position);
  if (homed_now_) tell_homed();
  if (homes_by_itself) return;
  if (off_at_rest_) cut_power_at_rest();
  if (phase_ == Phase::kDisarmed) {
    note_sinking(displacement);
  } else if (phase_ == Phase::kArmed) {
    watch();
  } else if (phase_ == Phase::kHoming) {
    follow_homing(displacement);
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
  const auto command = command_.read();
  if (is_of_this_run(command, started_)) apply(command.value);
}

/// True if it was passed unchanged.
bool Joint::apply(double command) {
  if (phase_ == Phase::kHoming) return false;
  commanded_ = command;
  const double before = sent_;
  const JointLimiter::Status status = limit_and_write(command);
  way_told_ += way_ == JointCommand::kVelocity ? sent_ * period_.seconds() : sent_ - before;
  passed_ = status == JointLimiter::Status::kPassed;
  if (passed_) return true;
  if (status == JointLimiter::Status::kClipped) clipped_.assign(clipped_ + 1);
  if (status != JointLimiter::Status::kNotFinite) return false;
  switch_off();
  component::Reason why(names_.command);
  append_number(why.append(" is "), command).append(" at the position ");
  fault(append_number(why, measured_.position).append(", expected finite numbers"));
  return false;
}

JointLimiter::Status Joint::limit_and_write(double command) {
  if (is_effort(way_)) [[likely]] {
    const auto step = limiter_->step_effort(measured_, command);
    sent_ = step.value;
    command_output_.write(step.value.scaled(effort_ratio_));
    return step.status;
  }
  if (way_ == JointCommand::kVelocity) {
    const auto step = limiter_->step_velocity(measured_, command);
    sent_ = step.value;
    command_output_.write(step.value.scaled(1.0 / sensor_ratio_));
    return step.status;
  }
  const auto step = limiter_->step_position(measured_, command);
  sent_ = step.value;
  command_output_.write(step.value.counted(1.0 / sensor_ratio_, absolute_->at(0.0)));
  return step.status;
}

/// Nothing drives the joint; a drive that follows positions is told that it is where it says.
void Joint::stand_still() {
  sent_ = 0.0;
  if (is_effort(way_)) return command_output_.write(control::LimitedEffort());
  if (way_ == JointCommand::kVelocity) return command_output_.write(control::LimitedVelocity());
  if (!absolute_->known()) return;
  const JointLimiter::Measured here{.position = absolute_->position(), .velocity = 0.0};
  command_output_.write(limiter_->step_position(here, here.position)
                            .value.counted(1.0 / sensor_ratio_, absolute_->at(0.0)));
}

}  // namespace armature::controllers
