// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/joint/own_homing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "armature/base/seconds.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::Outcome;
using component::Reason;
using control::HomeSign;
using control::HomingMotion;
using control::JointLimiter;

namespace {

/// Of HomingVelocity: up to there a joint is driven on by an effort.
constexpr double kFasterThanTold = 2.0;
/// Of MaxPositionError: a drive that follows positions is told to be ahead of it at most so far.
constexpr double kShareOfError = 0.5;
/// In which a drive that follows by itself takes back what its integral has pushed with.
constexpr double kUnwinding = 0.3;  // s

HomeSign sign_of(HomingMethod method) {
  switch (method) {
    case HomingMethod::kSwitch:
      return HomeSign::kSwitch;
    case HomingMethod::kSwitchThenIndex:
      return HomeSign::kSwitchThenIndex;
    case HomingMethod::kHardStop:
      return HomeSign::kHardStop;
    default:
      return HomeSign::kIndex;
  }
}

}  // namespace

Outcome OwnHoming::set_up(base::Duration period) {
  limiter_.reset();
  if (std::string wrong = settings_.objection(); !wrong.empty()) {
    return component::refused(std::move(wrong));
  }
  if (settings_.method() == HomingMethod::kDrive) return component::accepted();
  period_s_ = base::to_seconds(period);
  auto limiter = JointLimiter::make(limits(period));
  if (!limiter) return component::refused(limiter.error());
  if (settings_.moves()) {
    auto motion = HomingMotion::make(motion_config());
    if (!motion) return component::refused(motion.error());
    motion_ = motion.value();
  }
  limiter_ = limiter.value();
  return component::accepted();
}

/// How far a joint is behind what pushes it with all that it may.
double OwnHoming::lead() const {
  if (is_effort(way_)) return settings_->effort / settings_->stiffness;
  if (way_ == JointCommand::kVelocity) return joint_->arming_motion;
  return std::min(kShareOfError * joint_->max_error, joint_->arming_motion);
}

HomingMotion::Config OwnHoming::motion_config() const {
  return {.sign = sign_of(settings_.method()),
          .velocity = settings_->velocity,
          .acceleration = joint_->max_acceleration,
          .travel = settings_->travel,
          .back_off = settings_.method() == HomingMethod::kHardStop ? settings_->back_off
                                                                    : 0.75 * settings_->travel,
          .tolerance = joint_->arming_motion,
          .lead = lead(),
          .patience_s = is_effort(way_) ? 0.0 : kUnwinding,
          .period_s = period_s_};
}

/// Of one that does not move: it drives nothing.
JointLimiter::Config OwnHoming::limits(base::Duration period) const {
  const bool moves = settings_.moves();
  return {.lower = moves ? -settings_->travel : -1.0,
          .upper = moves ? settings_->travel : 1.0,
          .max_velocity = moves ? kFasterThanTold * std::abs(settings_->velocity) : 1.0,
          .max_acceleration = joint_->max_acceleration,
          .max_effort = moves && is_effort(way_) ? settings_->effort : 1.0,
          .period = period};
}

double OwnHoming::most_effort() const {
  const bool is_bounded = settings_->effort > 0.0 && !is_effort(way_);
  return is_bounded ? settings_->effort : std::numeric_limits<double>::infinity();
}

bool OwnHoming::hold() {
  searches_ = false;
  return limiter_ && limiter_->arm({});
}

void OwnHoming::search(bool switch_closed) {
  searches_ = true;
  motion_.begin(switch_closed);
}

OwnHoming::Status OwnHoming::step(const HomingMotion::Measured& measured) {
  return motion_.step(measured);
}

void OwnHoming::disarm() {
  if (limiter_) limiter_->disarm();
  searches_ = false;
}

control::LimitedEffort OwnHoming::effort(const Measured& measured) {
  const double behind = (searches_ ? motion_.desired_way() : 0.0) - measured.position;
  const double slower = (searches_ ? motion_.velocity() : 0.0) - measured.velocity;
  return limiter_
      ->step_effort(measured, settings_->stiffness * behind + settings_->damping * slower)
      .value;
}

control::LimitedVelocity OwnHoming::velocity(const Measured& measured) {
  return limiter_->step_velocity(measured, searches_ ? motion_.velocity() : 0.0).value;
}

control::LimitedPosition OwnHoming::position(const Measured& measured) {
  return limiter_->step_position(measured, searches_ ? motion_.desired_way() : 0.0).value;
}

// --- what went wrong -------------------------------------------------------------------------

Reason& OwnHoming::append_length(Reason& why, double length) const {
  append_number(why, std::round(length * 1e4) / 1e4).append(" ");
  return why.append(joint_.units().position().get());
}

Reason& OwnHoming::append_missing(Reason& why) const {
  if (motion_.stage() == HomingMotion::Stage::kToEdge) {
    return why.append("its switch did not open: look at the switch");
  }
  if (motion_.stage() == HomingMotion::Stage::kToIndex) {
    return why.append("no index came behind its switch: look at its encoder");
  }
  switch (settings_.method()) {
    case HomingMethod::kSwitch:
    case HomingMethod::kSwitchThenIndex:
      return why.append("its switch did not close: look at the switch");
    case HomingMethod::kHardStop:
      return why.append("nothing stopped it: look for what gives way");
    default:
      return why.append("no index came: look at its encoder");
  }
}

Reason OwnHoming::why(Status status, double way) const {
  Reason why("it ");
  switch (status) {
    case Status::kNothingFound:
      append_length(why.append("has moved by "), way).append(" (HomingTravel: ");
      append_number(why, settings_->travel).append("), and ");
      return append_missing(why);
    case Status::kBeyond:
      append_length(why.append("has moved by "), way).append(", out of its HomingTravel of ");
      return append_length(why, settings_->travel).append(": look for what drives it");
    case Status::kBlocked:
      append_length(why.append("was told to move by "), motion_.told()).append(" and moved by ");
      return append_length(why, motion_.moved())
          .append(": look for what blocks it, at its brake and at its sensor");
    case Status::kAstray:
      append_length(why.append("was told to move by "), motion_.told()).append(" and moved by ");
      return append_length(why, motion_.moved())
          .append(
              ": look for what drives it; HomingEffort and HomingStiffness have to hold its "
              "weight, and to overcome its friction");
    default:
      append_length(why.append("was stopped at "), motion_.found_at());
      return append_length(why.append(" of its way, and the second time at "), way)
          .append(": what stops it gives way, or is friction or its weight, and no hard stop");
  }
}

}  // namespace armature::controllers
