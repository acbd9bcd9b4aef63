// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/chassis_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/component/face.hpp"
#include "armature/controllers/base/of_this_run.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::rover {

using component::Outcome;
using component::Reason;
using control::Gathering;

namespace {

Reason not_finite(std::string_view name, double value) {
  Reason why(name);
  return controllers::append_number(why.append(" is "), value).append(", expected a number");
}

}  // namespace

void ChassisDrive::on_check(component::Check& check) const {
  if (wheels_ != 2 && wheels_ != 4) check.error("Wheels is 3, expected 2 or 4", "set Wheels");
}

std::vector<controllers::DrivenJoint> ChassisDrive::joints(const component::Check& check) {
  std::vector<controllers::DrivenJoint> all;
  for (std::size_t wheel = 0; wheel < reference_.size(); ++wheel) {
    for (const controllers::DrivenJoint& joint :
         controllers::joints_behind(face(reference_[wheel]), check)) {
      all.push_back(joint);
    }
  }
  return all;
}

/// A speed that a joint's limiter cuts would be a wheel that does not follow.
std::string ChassisDrive::objection(const std::vector<controllers::DrivenJoint>& joints,
                                    double speed, double radius) {
  for (const controllers::DrivenJoint& joint : joints) {
    if (speed / radius <= joint.max_velocity) continue;
    return "MaxSpeed is " + controllers::figure(speed) + " m/s, which " + joint.name +
           " makes with " + controllers::figure(speed / radius) +
           " rad/s, expected at most its MaxVelocity of " +
           controllers::figure(joint.max_velocity) + " rad/s";
  }
  return {};
}

Outcome ChassisDrive::on_start() {
  if (changes_.take()) {
    if (Outcome outcome = set_up(); !outcome) return outcome;
  }
  gathering_->reset();
  missing_.reset();
  has_last_ = false;
  moving_ = false;
  ramp_.rest();
  return component::accepted();
}

Outcome ChassisDrive::set_up() {
  if (Outcome outcome = period_.known(); !outcome) return outcome;
  auto made = Gathering::make(
      {.members = wheels(), .values_each = 1, .max_missing = missing_.max_missing()});
  if (!made) return component::refused(made.error());
  gathering_ = std::move(made).value();
  odometry_.emplace(track_);
  missing_.resize(wheels());
  last_.assign(wheels(), 0.0);
  wheel_speed_.assign(wheels(), 0.0);
  good_at_.assign(wheels(), base::Time{});
  desired_velocity_.assign(wheels(), 0.0);
  changes_.take();
  return component::accepted();
}

// --- a cycle ---------------------------------------------------------------------------------

void ChassisDrive::on_sample() {
  const Gathering::Round round = gathering_->begin();
  if (round.missing > 0) {
    missing_.note(*gathering_, [this](std::size_t wheel) {
      return controllers::writer_of(face(position_[wheel]));
    });
  }
  if (round.overdue != Gathering::kNobody) {
    fail(round.overdue, "its encoder does not answer");
  } else if (round.complete) {
    cycle();
  }
}

void ChassisDrive::on_position(std::size_t wheel, double position) {
  if (!std::isfinite(position)) return fail(wheel, "its position is no finite number");
  if (gathering_->add(wheel, position)) cycle();
}

void ChassisDrive::cycle() {
  measure();
  look_at_ports();
  check_age();
  drive();
  watch_wheels();
  if (state() != component::State::kRunning) return;
  tell();
  act_.raise();
}

/// What each wheel and each side rolled since the sample before.
void ChassisDrive::measure() {
  const std::vector<double>& positions = gathering_->values();
  std::array<double, 2> rolled{};
  for (std::size_t wheel = 0; wheel < wheels(); ++wheel) {
    const double way = has_last_ ? (positions[wheel] - last_[wheel]) * wheel_radius_ : 0.0;
    wheel_speed_[wheel] = way / period_.seconds();
    rolled[side_of(wheel)] += way * 2.0 / static_cast<double>(wheels());
    last_[wheel] = positions[wheel];
  }
  axis_[0] = std::accumulate(last_.begin(), last_.end(), 0.0) / static_cast<double>(wheels());
  if (!has_last_) axis_resting_[0] = axis_[0];
  has_last_ = true;
  odometry_->step(rolled[0], rolled[1]);
  measured_ = {rolled[0] / period_.seconds(), rolled[1] / period_.seconds()};
}

/// The last to speak counts, port or command.
void ChassisDrive::look_at_ports() {
  const auto left = left_.read();
  const auto right = right_.read();
  if (!left.is_new() && !right.is_new()) return;
  if (!left || !right) return;
  want({left.value, right.value}, std::min(left.time, right.time), "VelocityLeft", "VelocityRight");
}

void ChassisDrive::check_age() {
  if (!moving_ || time() - wanted_at_ <= kRenewal) return;
  if (wanted_.fastest() == 0.0) {
    moving_ = false;
  } else {
    stop_smoothly("its speed was not renewed for 200 ms");
  }
}

void ChassisDrive::drive() {
  if (const std::size_t disarmed = first_disarmed(); disarmed < wheels()) {
    Reason why(controllers::writer_of(face(joint_armed_[disarmed])));
    stop_at_once(why.append(" is disarmed").view());
  }
  const Speeds target = moving_ ? within(wanted_, max_speed_) : Speeds{};
  const double most = (moving_ ? max_acceleration_ : stop_deceleration_) * period_.seconds();
  const Speeds& now = ramp_.step(target, most);
  for (std::size_t wheel = 0; wheel < wheels(); ++wheel) {
    desired_velocity_[wheel] = (side_of(wheel) == 0 ? now.left : now.right) / wheel_radius_;
    reference_[wheel].write(desired_velocity_[wheel]);
  }
}

/// A motor that fails, or an encoder that stands still.
void ChassisDrive::watch_wheels() {
  const bool armed = first_disarmed() == wheels();
  for (std::size_t wheel = 0; wheel < wheels(); ++wheel) {
    const double wanted = desired_velocity_[wheel] * wheel_radius_;
    const bool follows = std::abs(wanted - wheel_speed_[wheel]) <= max_error_;
    if (!armed || follows) {
      good_at_[wheel] = time();
    } else if (base::to_seconds(time() - good_at_[wheel]) > error_time_) {
      Reason what("it is to roll with ");
      controllers::append_number(what, std::round(wanted * 1e3) / 1e3)
          .append(" m/s and rolls with ");
      controllers::append_number(what, std::round(wheel_speed_[wheel] * 1e3) / 1e3);
      return fail(wheel, what.append(" m/s").view());
    }
  }
}

void ChassisDrive::tell() {
  speed_left_.write(measured_.left);
  speed_right_.write(measured_.right);
  x_.write(odometry_->x());
  y_.write(odometry_->y());
  heading_.write(odometry_->heading());
  if (!ramp_.at_rest()) axis_resting_[0] = axis_[0];
  axis_wanted_[0] = ramp_.now().fastest() / wheel_radius_;
  axis_position_.write(axis_);
  axis_desired_.write(axis_resting_);
  axis_velocity_.write(axis_wanted_);
}

/// At once: Arming disarms all if one is.
void ChassisDrive::tell_armed(std::size_t /*wheel*/, bool /*armed*/) {
  armed_.write(first_disarmed() == wheels());
}

// --- what is wanted --------------------------------------------------------------------------

Outcome ChassisDrive::set_velocity(float left, float right) {
  const Speeds speeds{left, right};
  if (!want(speeds, time(), "left", "right")) {
    if (!std::isfinite(left)) return component::refused(not_finite("left", left).view());
    if (!std::isfinite(right)) return component::refused(not_finite("right", right).view());
    return component::refused("the chassis is not armed: call Arming.arm first");
  }
  set_velocity_.complete();
  return component::accepted();
}

bool ChassisDrive::want(const Speeds& speeds, base::Time at, std::string_view left,
                        std::string_view right) {
  if (!speeds.are_finite()) {
    const bool is_left = !std::isfinite(speeds.left);
    stop_smoothly(not_finite(is_left ? left : right, is_left ? speeds.left : speeds.right).view());
    return false;
  }
  if (first_disarmed() < wheels()) return false;
  wanted_ = speeds;
  wanted_at_ = at;
  moving_ = true;
  return true;
}

void ChassisDrive::stop_smoothly(std::string_view why) {
  if (moving_) tell_stop(why);
  moving_ = false;
}

void ChassisDrive::stop_at_once(std::string_view why) {
  if (moving_ || !ramp_.at_rest()) tell_stop(why);
  moving_ = false;
  ramp_.rest();
}

void ChassisDrive::tell_stop(std::string_view why) {
  const StopReason reason(why);
  stop_reason_.assign(reason);
  log_info("stops: {}", why);
  stopped_.raise(reason);
}

void ChassisDrive::settle() {
  stop_at_once("it is being armed");
  axis_resting_[0] = axis_[0];
}

/// The first joint that does not say `Armed`; wheels() if all do.
std::size_t ChassisDrive::first_disarmed() {
  std::size_t wheel = 0;
  while (wheel < wheels()) {
    const auto armed = joint_armed_[wheel].read();
    if (armed.status < component::ReadStatus::kOld || !armed.value) break;
    ++wheel;
  }
  return wheel;
}

/// All wheels come to rest together.
void ChassisDrive::fail(std::size_t wheel, std::string_view what) {
  Reason why("wheel ");
  controllers::append_number(why, static_cast<double>(wheel + 1)).append(" (");
  why.append(controllers::writer_of(face(position_[wheel]))).append(") has failed: ").append(what);
  moving_ = false;
  ramp_.rest();
  tell_stop(why.view());
  static_cast<void>(disarm_.send());
  fault(why);
}

}  // namespace armature::rover
